"""Text that is no scene at all: nothing crashes, and nothing takes long or much memory."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tree_sitter import Language, Parser, Tree

import m3d_language
import m3dc
from m3d_language.formal import first_error
from m3dc.syntax.parse import HEAD

DEEP = 10_000
PARSER = Parser(Language(m3d_language.language()))
TEXTS = {
    "braces": b"SOLID { " * DEEP,
    "closed braces": b"SOLID { " * DEEP + b"} " * DEEP,
    "braces alone": b"{" * DEEP,
    "closing braces": b"}" * DEEP,
    "comments": b"/*" * DEEP,
    "closed comments": b"/*" * DEEP + b"*/" * DEEP,
    "ends of comments": b"*/" * DEEP,
    "vectors": b"<" * DEEP,
    "assignments": b"x = " * DEEP,
    "tables": b"FACETS { " * DEEP,
    "commas": b"REGION 1" + b", 1" * DEEP,
    "one word": b"x" * 1_000_000,
    "one number": b"1" * 1_000_000,
    "zeros": b"\0" * 100_000,
    "binary": random.Random(1).randbytes(100_000),
    "high bytes": bytes(range(128, 256)) * 500,
}


def nodes(tree: Tree) -> int:
    """Walks the whole tree, however deep."""
    cursor = tree.walk()
    count = 1
    while True:
        if cursor.goto_first_child() or cursor.goto_next_sibling():
            count += 1
            continue
        while cursor.goto_parent():
            if cursor.goto_next_sibling():
                count += 1
                break
        else:
            return count


@pytest.mark.parametrize("name", TEXTS)
def test_it_is_parsed(name: str) -> None:
    tree = PARSER.parse(TEXTS[name])
    assert tree.root_node.end_byte <= len(TEXTS[name])
    assert 0 < nodes(tree) < 200_000


@pytest.mark.parametrize("name", TEXTS)
def test_the_formal_grammar_says_where_it_stops(name: str) -> None:
    text = TEXTS[name].decode("latin-1")
    fault = first_error(text)
    assert name == "closed comments" or (fault is not None and 0 <= fault.offset <= len(text))


@given(st.binary(max_size=200))
def test_any_bytes(data: bytes) -> None:
    PARSER.parse(data)
    first_error(data.decode("latin-1"))


@given(
    st.lists(
        st.sampled_from(["SOLID", "FACETS", "{", "}", "<", ">", "1", ",", "x", "=", "/*", "*/", "\n"]), max_size=60
    )
)
def test_any_tokens(tokens: list[str]) -> None:
    text = " ".join(tokens)
    tree = PARSER.parse(text.encode())
    assert tree.root_node.end_byte <= len(text)
    first_error(text)


@pytest.mark.slow
@pytest.mark.parametrize("line", [b"ab $ {} < 3 ; foo\n", b"{", b"word ", b"a#b9!\n?>,;", b"SOLID { SPHER } }\n"])
def test_of_much_junk_only_the_beginning_is_read(line: bytes) -> None:
    """The rest costs nothing: what is found is found in the first half megabyte."""
    much = m3dc.compile(line * (6_000_000 // len(line)))
    assert not much.ok
    assert max(diagnostic.span.end for diagnostic in much.diagnostics) <= HEAD + len(line)


def test_a_long_scene_that_is_not_closed_is_read_to_its_end() -> None:
    text = b"SOLID {\n" + (b"SPHERE { RADIUS 1 }" + b" " * 400 + b"\n") * 10_000 + b"SPHERE { RADIUS x } }"
    (error,) = (d for d in m3dc.compile(text).diagnostics if d.severity == "error")
    assert text[slice(*error.span.bytes)] == b"x"


def test_a_broken_list_of_a_million_numbers() -> None:
    """A letter at its end makes every number of the table a node: slower, but not without end."""
    text = b"POLYGONS { FACETS { " + b"12345 " * 200_000 + b"x } }"
    assert not PARSER.parse(text).root_node.has_error
