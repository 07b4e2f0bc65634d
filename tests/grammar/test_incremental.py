"""Parsing after an edit gives the tree that parsing from the start gives."""

from __future__ import annotations

from hypothesis import example, given
from hypothesis import strategies as st
from tree_sitter import Language, Node, Parser, Point, Tree

import m3d_language

PARSER = Parser(Language(m3d_language.language()))
SCENE = b"""\
/* A scene /* with */ comments */
VARIABLES { NUMBER a, b; SPHERE ball; }
a = 3 ball = other { RADIUS a CENTER < a, 2, 3 > }
SCENE { SHADOWS AMBIENT { INTENSITY 0.3 } VIEW { REGION 0, 1, 2, 3 } }
SOLID house { POLYGONS { FACETS { 2 /* two */ 0 1 2
 3 4 5 } VERTICES { 1 < 0, 1, x > } } }
"""
PIECES = [
    b"",
    b" ",
    b"\n",
    b"{",
    b"}",
    b"/*",
    b"*/",
    b"<",
    b",",
    b"RADIUS",
    b"SOLID",
    b"x",
    b"1",
    b"=",
    b";",
    b"\xc3\xa9",
]


def point(data: bytes, offset: int) -> Point:
    line = data.rfind(b"\n", 0, offset) + 1
    return Point(data.count(b"\n", 0, offset), offset - line)


def edited(tree: Tree, data: bytes, start: int, end: int, new: bytes) -> bytes:
    """The text after an edit, of which the tree is told."""
    text = data[:start] + new + data[end:]
    after = start + len(new)
    tree.edit(start, end, after, point(data, start), point(data, end), point(text, after))
    return text


def leaves(node: Node) -> list[tuple[str, int, int, bool]]:
    """Every node with its place, the root first."""
    found = [(node.type, node.start_byte, node.end_byte, node.is_missing)]
    for child in node.children:
        found += leaves(child)
    return found


edits = st.lists(
    st.tuples(
        st.integers(0, len(SCENE)), st.integers(0, 12), st.lists(st.sampled_from(PIECES), max_size=3).map(b"".join)
    ),
    min_size=1,
    max_size=3,
)


@given(edits)
@example([(198, 0, b"x")])  # a name comes into a table of numbers
@example([(198, 0, b"x"), (198, 1, b"")])  # and goes
@example([(0, 2, b"")])  # a comment is opened no more
@example([(len(SCENE), 0, b"/*")])
@example([(60, 0, b"/*"), (0, 0, b"*/")])
def test_an_incremental_parse_is_a_full_one(changes: list[tuple[int, int, bytes]]) -> None:
    data = SCENE
    tree = PARSER.parse(data)
    for start, length, new in changes:
        start = min(start, len(data))
        data = edited(tree, data, start, min(start + length, len(data)), new)
        tree = PARSER.parse(data, tree)
    full = PARSER.parse(data)
    # Where the text is broken, the parser may mend it in another way than it would from the start.
    if not full.root_node.has_error:
        assert leaves(tree.root_node) == leaves(full.root_node)
    else:
        assert tree.root_node.has_error
        assert tree.root_node.end_byte == full.root_node.end_byte
