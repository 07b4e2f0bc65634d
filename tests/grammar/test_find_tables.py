"""Long tables are found without a parser, and a parser need not see them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tree_sitter import Language, Node, Parser, Tree

import tree_sitter_m3d
from tree_sitter_m3d import find_tables, ranges_around

LANGUAGE = Language(tree_sitter_m3d.language())
pieces = st.sampled_from(
    [
        *"{}<>,1e/\né",
        *["FACETS", "PROFILE", "SPHERE", "x", "2.5e+3", "1e", "/*", "*/", "/* { 1 */"],
        *["{ 1 2 }", "FACETS {", "FACETS { < 1, 2, 3 > }", "SOLID {", "SOLID { }"],
    ]
)


def nodes(node: Node) -> list[tuple[str, int, int, int, int, int, int]]:
    """Every node with its place, but for the numbers of tables."""
    if node.type == "numeric_table":
        return []
    (row, column), (end_row, end_column) = node.start_point, node.end_point
    found = [(node.type, node.start_byte, node.end_byte, row, column, end_row, end_column)]
    for child in node.children:
        found += nodes(child)
    return found


def tables(tree: Tree) -> list[tuple[int, int]]:
    """The bodies that hold a numeric_table: from brace to brace."""
    found: list[tuple[int, int]] = []
    stack = [tree.root_node]
    while stack:
        node = stack.pop()
        if node.type == "table" and node.child_by_field_name("data") and not node.children[-1].is_missing:
            brace = next(child for child in node.children if child.type == "{")
            found.append((brace.end_byte, node.children[-1].start_byte))
        stack += node.children
    return sorted(found)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("PROFILE { 0 1 }", [" 0 1 "]),
        ("PROFILE/* a table */\n{0 1e-5/* } */}", ["0 1e-5/* } */"]),
        ("VERTICES { 1 < 0, 1, 2 > } FACETS {}", [" 1 < 0, 1, 2 > ", ""]),
        ("/* PROFILE { 0 1 } */", []),
        ("SPHERE { 0 1 }", []),
        ("PROFILE x { 0 1 }", []),
        ("PROFILE { 0 x }", []),
        ("PROFILE { 0 e5 }", []),
        ("PROFILE { 0 1", []),
        ("PROFILE { 0 1 /* }", []),
        ("MY_PROFILE { 0 1 }", []),
        ("5PROFILE { 0 1 }", []),
        ("PROFILE { { 0 1 }", []),
        ("PROFILE { PROFILE { 7 } }", [" 7 "]),
    ],
)
def test_bodies_of_numbers_are_found(text: str, found: list[str]) -> None:
    assert [text[start:end] for start, end in find_tables(text.encode(), 0)] == found


def test_only_long_ones_are_found() -> None:
    text = b"PROFILE { 1 } PROFILE { 1234567 }"
    assert find_tables(text, 9) == [(23, 32)]
    assert find_tables(text) == []


@given(st.lists(pieces, max_size=30).map(" ".join))
def test_a_parser_need_not_see_them(text: str) -> None:
    data = text.encode()
    full = Parser(LANGUAGE).parse(data)
    found = find_tables(data, 0)
    around = Parser(LANGUAGE, included_ranges=ranges_around(data, found)).parse(data)
    if full.root_node.has_error:
        # But for marks without a number, which the reader of the table refuses.
        assert around.root_node.has_error or any(set(data[start:end]) & set(b"<>,+-.") for start, end in found)
        return
    assert not around.root_node.has_error
    assert set(tables(full)) <= set(found)
    inside = [range(start, end) for start, end in found]
    outside = [node for node in nodes(full.root_node) if not any(node[1] in table for table in inside)]
    assert nodes(around.root_node) == outside
