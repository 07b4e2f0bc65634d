"""Selection range: growing a selection, from a number to its vector, its row or statement, the inside of its block, the
block, and so on to the whole text."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types
from tree_sitter import Node

from m3dc.syntax import numerals

from ..comments import comments
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span
from ..tree import ancestors, leaf_at

_BRACED = {"body", "variables", "table"}


@request(types.TEXT_DOCUMENT_SELECTION_RANGE)
def selection(snapshot: Snapshot, params: types.SelectionRangeParams) -> list[types.SelectionRange]:
    """For each position what can be selected about it, the narrowest first."""
    return [_nested(snapshot, snapshot.offset(position)) for position in params.positions]


def _nested(snapshot: Snapshot, offset: int) -> types.SelectionRange:
    spans: list[Span] = []
    for start, end in _about(snapshot, offset):
        if not spans or (start <= spans[-1][0] and spans[-1][1] <= end and (start, end) != spans[-1]):
            spans.append((start, end))
    outer: types.SelectionRange | None = None
    for range_ in reversed(snapshot.text.ranges(spans)):
        outer = types.SelectionRange(range_, outer)
    assert outer is not None
    return outer


def _about(snapshot: Snapshot, offset: int) -> Iterator[Span]:
    """What is about a byte, from narrow to wide; not each is wider than the one before."""
    data = snapshot.text.data
    comment = comments(snapshot.analysis).at(offset)
    leaf = leaf_at(snapshot.analysis.tree, offset)
    if comment is not None:
        inside = _trimmed(data, (comment[0] + 2, comment[1] - 2))
        yield from _word(data, offset, inside)
        yield from _line(snapshot, offset, inside)
        yield inside
        yield comment
    elif leaf is not None and leaf.type == "numeric_table":
        yield from _row(snapshot, offset, leaf)
    node = leaf or snapshot.analysis.tree.root_node.descendant_for_byte_range(offset, offset)
    for outer in ancestors(node):
        if outer.type in _BRACED:
            inside = _inside(data, outer)
            if inside[0] <= offset <= inside[1]:
                yield inside
        yield outer.start_byte, outer.end_byte
    yield 0, len(data)


def _inside(data: bytes, node: Node) -> Span:
    """What stands between the braces of a node."""
    braces = [child for child in node.children if child.type in "{}"]
    if len(braces) < 2:
        return node.start_byte, node.end_byte
    return _trimmed(data, (braces[0].end_byte, braces[-1].start_byte))


def _trimmed(data: bytes, span: Span) -> Span:
    """A range without white space at its ends."""
    part = data[span[0] : span[1]]
    start = span[0] + len(part) - len(part.lstrip())
    return start, max(start, span[1] - (len(part) - len(part.rstrip())))


def _row(snapshot: Snapshot, offset: int, table: Node) -> Iterator[Span]:
    """In a table of numbers: the number, the vector and the line."""
    data, whole = snapshot.text.data, (table.start_byte, table.end_byte)
    yield from _word(data, offset, whole)
    opened = data.rfind(b"<", whole[0], offset + 1)
    closed = data.find(b">", max(offset - 1, opened), whole[1]) if opened >= 0 else -1
    if closed >= 0 and data.find(b">", opened, closed) < 0:
        yield opened, closed + 1
    yield from _line(snapshot, offset, whole)


def _word(data: bytes, offset: int, within: Span) -> Iterator[Span]:
    span = numerals.around(data, offset, within)
    if span[0] < span[1]:
        yield span


def _line(snapshot: Snapshot, offset: int, within: Span) -> Iterator[Span]:
    """The part of a line that is within something."""
    line = snapshot.text.line_of(offset)
    start, end = snapshot.text.line_start(line), snapshot.text.line_end(line)
    yield _trimmed(snapshot.text.data, (max(start, within[0]), min(end, within[1])))
