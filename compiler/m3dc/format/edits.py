"""The canonical layout of a scene: the same tokens and comments, in the white space of docs/formatting.md.

Only white space is ever changed, and none is put within a token, so that a scene means what it meant. Text with syntax
errors has no layout: `FormatError` says where the first one is. What stands beside them has one, item by item:
`format_range` lays it out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from tree_sitter import Node, Tree

from m3d_language.table import LANGUAGE

from ..diagnostics import Diagnostic, Findings, catalogue
from ..syntax.parse import parse
from ..text.difference import Difference
from ..text.source import BYTE_ORDER_MARK, Source
from ..text.span import Span
from .atoms import FormatError, read
from .layout import Layout
from .rows import Change

__all__ = ["Edit", "FormatError", "edits", "format", "format_range"]

# A long name, an empty scene and a number that can not be read have their tokens in place all the same.
_NOT_FORM = {
    catalogue.EXPECTED_DIGIT.code,
    catalogue.NAME_TOO_LONG.code,
    catalogue.EMPTY_FILE.code,
    catalogue.NUMBER_TOO_LARGE.code,
}


class Edit(NamedTuple):
    """White space `text` in place of the white space at `span`, a half-open range of bytes of the source."""

    span: Span
    text: str


def format(source: bytes) -> bytes:
    """The scene in its canonical layout. Formatting that again changes nothing. Raises FormatError."""
    done = 0
    parts = bytearray()
    for change in _layout(source).changes(large=True):
        parts += source[done : change.start]
        parts += change.text
        done = change.end
    parts += source[done:]
    return bytes(parts)


def format_range(source: bytes, start_line: int, end_line: int) -> list[Edit]:
    """The edits of `format` that touch some lines, counted from 1 and both included. Each is as small as can be, they
    are in order and apart from one another, and making any of them leaves the scene's meaning. In a text with syntax
    errors, those within and between the top-level items that are sound. Raises FormatError where blocks are too
    deep."""
    start, end = _lines(source, start_line, end_line)
    changes = (
        change
        for piece in _pieces(source)
        if piece.start <= end and piece.end >= start
        for change in piece.layout().changes(within=(start, end))
        if change.start < piece.end
    )
    edits = (_smallest(source, change) for change in changes if change.start <= end and change.end >= start)
    return [edit for edit in edits if edit.span[0] <= end and (edit.span[1] > start or edit.span[0] == start)]


def edits(source: bytes) -> Iterator[Edit]:
    """All edits that `format` makes, as small as can be, in order. Raises FormatError."""
    return (_smallest(source, change) for change in _layout(source).changes())


class _Piece(NamedTuple):
    """A part of a text that is laid out by itself, from byte `start` to `end`: the nodes of its items. The white space
    at the end of the text belongs to one that reaches so far."""

    data: bytes
    start: int
    end: int
    nodes: list[Node]
    eol: bytes

    def layout(self) -> Layout:
        return Layout(self.data[: self.end], read(self.data, self.nodes), self.start, self.eol)


def _layout(data: bytes) -> Layout:
    findings = Findings()
    source = Source(data)
    syntax = parse(source, findings)
    first = _first_fault(findings.diagnostics(syntax.places))
    if first is not None:
        raise FormatError(first.message, first.span.bytes)
    if syntax.tree.root_node.has_error:
        raise FormatError("Syntax error", (0, 0))
    return _whole(data, source, syntax.tree).layout()


def _pieces(data: bytes) -> list[_Piece]:
    """What of a text can be laid out: all of it, or, where it has syntax errors, the runs of items without any."""
    findings = Findings()
    source = Source(data)
    syntax = parse(source, findings)
    if _first_fault(findings.diagnostics(syntax.places)) is None and not syntax.tree.root_node.has_error:
        return [_whole(data, source, syntax.tree)]
    runs: list[list[Node]] = [[]]
    for node in syntax.tree.root_node.children:
        if node.type == "comment" or (_is_sound(node) and node.start_byte not in syntax.faulty):
            runs[-1].append(node)
        elif runs[-1]:
            runs.append([])
    return [_run(data, source, items) for run in runs if (items := _between_comments(run))]


def _first_fault(diagnostics: Iterable[Diagnostic]) -> Diagnostic | None:
    faults = [found for found in diagnostics if found.severity == "error" and found.code not in _NOT_FORM]
    return min(faults, key=lambda fault: fault.span, default=None)


def _whole(data: bytes, source: Source, tree: Tree) -> _Piece:
    start = len(BYTE_ORDER_MARK) if data.startswith(BYTE_ORDER_MARK) else 0
    # A change at the very end of the text is part of it too.
    return _Piece(source.data, start, len(data) + 1, tree.root_node.children, _line_end(data))


def _run(data: bytes, source: Source, items: list[Node]) -> _Piece:
    """Some items, from the beginning of the line if nothing stands there before them."""
    start = items[0].start_byte
    line = source.data.rfind(b"\n", 0, start) + 1
    start = start if source.data[line:start].strip() else line
    return _Piece(source.data, start, items[-1].end_byte, items, _line_end(data))


def _is_sound(node: Node) -> bool:
    """Whether a node of the top level is a whole item. A member of a block is none: its block has gone to pieces."""
    if node.has_error or node.is_missing or not node.child_count:
        return False
    return node.type in ("variables", "assignment") or node.children[0].type in LANGUAGE.top


def _between_comments(run: list[Node]) -> list[Node]:
    """Items and comments without the comments before the first and after the last item, which may belong elsewhere."""
    items = [number for number, node in enumerate(run) if node.type != "comment"]
    return run[items[0] : items[-1] + 1] if items else []


def _line_end(data: bytes) -> bytes:
    newline = data.find(b"\n")
    return b"\r\n" if newline > 0 and data[newline - 1 : newline] == b"\r" else b"\n"


def _smallest(data: bytes, change: Change) -> Edit:
    start, end, text = change
    same, old_end, new_end = Difference.between(data[start:end], text)
    return Edit((start + same, start + old_end), text[same:new_end].decode("ascii"))


def _lines(data: bytes, first: int, last: int) -> Span:
    """The range of bytes of some lines, without the end of the last."""
    start = 0
    for _ in range(first - 1):
        start = data.find(b"\n", start) + 1
        if not start:
            return len(data), len(data)
    end = start
    for line in range(first, last + 1):
        end = data.find(b"\n", end + (line > first))
        if end < 0:
            return start, len(data)
    return start, end
