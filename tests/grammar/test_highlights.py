"""The editor queries: what the highlight query captures, by assertions in grammar/test/highlight; and all compile."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tree_sitter import Language, Node, Parser, Query, QueryCursor

import m3d_language

HIGHLIGHT = Path(__file__).parents[2] / "grammar/test/highlight"
LANGUAGE = Language(m3d_language.language())
ASSERTION = re.compile(r"^/\*\s*(?P<mark>\^|<-)\s*(?P<capture>[\w.]+)")


def captures(query: str, text: str) -> dict[str, list[Node]]:
    return QueryCursor(Query(LANGUAGE, query)).captures(Parser(LANGUAGE).parse(text.encode()).root_node)


def assertions(text: str) -> Iterator[tuple[int, int, str]]:
    """Row, column and capture name: a comment with `^` speaks of what stands above it, `<-` of what begins above it."""
    above = 0
    for row, line in enumerate(text.splitlines()):
        if match := ASSERTION.match(line):
            yield above, match.start("mark") if match["mark"] == "^" else 0, match["capture"]
        else:
            above = row


@pytest.mark.parametrize("file", sorted(HIGHLIGHT.glob("*.m3d")), ids=lambda file: file.name)
def test_highlights_are_as_the_file_says(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    found = captures(m3d_language.HIGHLIGHTS_QUERY, text)
    checked = 0
    for row, column, capture in assertions(text):
        at = (row, column)
        there = [name for name, nodes in found.items() for node in nodes if node.start_point <= at < node.end_point]
        assert there == [capture], f"line {row + 1}, column {column + 1} of {file.name}"
        checked += 1
    assert checked > 20


@pytest.mark.parametrize("name", ["HIGHLIGHTS", "FOLDS", "INDENTS", "LOCALS", "TAGS"])
def test_every_query_captures_something(name: str) -> None:
    text = (HIGHLIGHT / "scene.m3d").read_text(encoding="utf-8")
    assert captures(getattr(m3d_language, f"{name}_QUERY"), text)


def test_no_node_is_highlighted_twice() -> None:
    text = (HIGHLIGHT / "scene.m3d").read_text(encoding="utf-8")
    nodes = [node.id for nodes in captures(m3d_language.HIGHLIGHTS_QUERY, text).values() for node in nodes]
    assert len(nodes) == len(set(nodes))


def test_definitions_and_references_of_a_variable() -> None:
    found = captures(m3d_language.TAGS_QUERY, "VARIABLES { SPHERE ball; }\nball = other\nSOLID { SPHERE ball }")
    names = {name: [node.start_point.row for node in nodes] for name, nodes in found.items()}
    assert names["definition.constant"] == [0]
    assert sorted(names["name"]) == [0, 1, 1, 2]
