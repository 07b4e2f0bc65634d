"""The canonical layout of a scene: the same tokens and comments, in the white space of docs/formatting.md.

Only white space is ever changed, and none is put within a token, so that a scene means what it meant. Text with syntax
errors has no layout: `FormatError` says where the first one is.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from .diagnostics import Findings
from .format_atoms import FormatError, read
from .format_layout import Layout
from .format_rows import Change
from .ir import Span
from .source import BYTE_ORDER_MARK, Source
from .syntax import parse

__all__ = ["Edit", "FormatError", "edits", "format", "format_range"]

# A long name, an empty scene and a number that can not be read have their tokens in place all the same.
_NOT_FORM = {"M3D0104", "M3D0110", "M3D0112", "M3D0114"}


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
    are in order and apart from one another, and making any of them leaves the scene's meaning. Raises FormatError."""
    start, end = _lines(source, start_line, end_line)
    changes = _layout(source).changes(within=(start, end))
    edits = (_smallest(source, change) for change in changes if change.start <= end and change.end >= start)
    return [edit for edit in edits if edit.span[0] <= end and (edit.span[1] > start or edit.span[0] == start)]


def edits(source: bytes) -> Iterator[Edit]:
    """All edits that `format` makes, as small as can be, in order. Raises FormatError."""
    return (_smallest(source, change) for change in _layout(source).changes())


def _layout(data: bytes) -> Layout:
    findings = Findings()
    source = Source(data)
    tree = parse(source, findings).tree
    faults = [found for found in findings.found if found.severity == "error" and found.code not in _NOT_FORM]
    if faults:
        first = min(faults, key=lambda fault: fault.span)
        raise FormatError(first.message, first.span)
    if tree.root_node.has_error:
        raise FormatError("Syntax error", (0, 0))
    start = len(BYTE_ORDER_MARK) if data.startswith(BYTE_ORDER_MARK) else 0
    newline = data.find(b"\n")
    eol = b"\r\n" if newline > 0 and data[newline - 1 : newline] == b"\r" else b"\n"
    return Layout(data, read(source.data, tree.root_node), start, eol)


def _smallest(data: bytes, change: Change) -> Edit:
    start, end, text = change
    old = data[start:end]
    same = _alike(old, text)
    alike = _alike(old[same:][::-1], text[same:][::-1])
    return Edit((start + same, end - alike), text[same : len(text) - alike].decode("ascii"))


def _alike(one: bytes, other: bytes) -> int:
    """How many bytes two texts have in common at their beginnings."""
    if one.startswith(other) or other.startswith(one):
        return min(len(one), len(other))
    return next(number for number, (a, b) in enumerate(zip(one, other, strict=False)) if a != b)


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
