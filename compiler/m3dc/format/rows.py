"""The rows of a table: they keep their lines and their spacing, and only move as a whole.

A table may hold millions of rows, so it is looked at in chunks of a megabyte, and a chunk whose rows all begin alike is
moved by one replacement.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from ..text.span import Span

# Differences of indentation below this line up numbers of unlike length; larger ones are no alignment.
RAGGED = 6
CHUNK = 1 << 20
TAB = 8
BLANK = b" \t\r\f\v"

_BREAK = re.compile(rb"\n[ \t\r\f\v\n]*")
_BLANKS = re.compile(rb"[ \t\r\f\v]*")
_LEAD = re.compile(rb"\n([ \t\r\f\v]*)(?![ \t\r\f\v\n])")
_DELIMITER = re.compile(rb"/\*|\*/")


class Change(NamedTuple):
    """White space `text` in place of the white space `data[start:end]`."""

    start: int
    end: int
    text: bytes


class Rows:
    """The rows `data[start:end]`, which begin and end with something visible. `first` is the white space before the
    first row on its line, or None where it shares the line with the brace."""

    def __init__(self, data: bytes, start: int, end: int, first: bytes | None) -> None:
        self._data = data
        self._start = start
        self._first = first
        self._comments = list(_comments_of_lines(data, start, end))
        self._pieces = list(_between(start, end, self._comments))
        self._leads = {lead for piece in self._pieces for lead in _leads(data, *piece)}
        widths = {_width(lead) for lead in self._leads}
        if first is not None:
            widths.add(_width(first))
        self._least = min(widths, default=0)
        self._ragged = max(widths, default=0) - self._least >= RAGGED
        self.offset = 0 if first is None else self._offset(first)

    def _offset(self, lead: bytes) -> int:
        """How much further in than the leftmost row a row stays."""
        return 0 if self._ragged else _width(lead) - self._least

    def changes(self, indent: int, eol: bytes, within: Span | None = None) -> Iterator[Change]:
        """All that moves the rows, but the first, to `indent` columns; with `within`, what may touch that range."""
        low, high = within or (self._start, len(self._data))
        table = self._table(indent)
        commented = self._start
        for piece, comment in zip(self._pieces, [*self._comments, None], strict=True):
            for start, end in _chunks(self._data, *piece):
                if start <= high and end >= low:
                    yield from self._chunk(start, end, table, eol)
            if comment is not None:
                old = self._lead_of_line(comment[0], commented)
                new = b"" if old is None else b" " * (indent + self._offset(old))
                yield from moved_comment(self._data, comment, old, new, eol)
                commented = comment[1]

    def moved(self, indent: int, eol: bytes) -> Iterator[Change]:
        """The same as `changes`, but large, where that is faster: each may hold rows too."""
        table = self._table(indent)
        if self._comments or len(table) != 1:
            yield from self.changes(indent, eol)
            return
        ((old, new),) = table.items()
        for start, end in _chunks(self._data, *self._pieces[0]):
            chunk = self._data[start:end]
            line_end = b"\r\n" if b"\r" in chunk else b"\n"
            if _is_even(chunk, line_end):
                yield Change(start, end, chunk.replace(line_end + old, eol + new))
            else:
                yield from self._chunk(start, end, table, eol)

    def _table(self, indent: int) -> dict[bytes, bytes]:
        """The new indentation for each there is."""
        return {lead: b" " * (indent + self._offset(lead)) for lead in self._leads}

    def _lead_of_line(self, offset: int, commented: int) -> bytes | None:
        """The white space that begins an offset's line, unless a comment that ends at `commented` does."""
        newline = self._data.rfind(b"\n", self._start, offset)
        if newline < 0:
            return self._first if commented == self._start else None
        return None if newline < commented else lead_at(self._data, newline + 1)

    def _chunk(self, start: int, end: int, table: dict[bytes, bytes], eol: bytes) -> Iterator[Change]:
        data = self._data
        for match in _BREAK.finditer(data, start, end):
            at, stop = match.span()
            while at > start and data[at - 1] in BLANK:
                at -= 1
            old = data[at:stop]
            lead = old[old.rfind(b"\n") + 1 :]
            new = eol * min(old.count(b"\n"), 2) + table[lead]
            if new != old:
                yield Change(at, stop, new)


def _is_even(chunk: bytes, line_end: bytes) -> bool:
    """Whether all lines of a chunk end alike, with no blanks before, and none is empty."""
    return (
        chunk.count(b"\n") == chunk.count(line_end)
        and chunk.count(b"\r") == (chunk.count(line_end) if b"\r" in line_end else 0)
        and not any(blank + line_end in chunk for blank in (b"\n", b" ", b"\t"))
        and b"\f" not in chunk
        and b"\v" not in chunk
    )


def _leads(data: bytes, start: int, end: int) -> Iterator[bytes]:
    """The indentations of the lines that begin in a range."""
    for first, last in _chunks(data, start, end):
        yield from set(_LEAD.findall(data, first, last))


def lead_at(data: bytes, start: int) -> bytes:
    """The white space at the beginning of a line."""
    match = _BLANKS.match(data, start)
    return match.group() if match else b""


def _chunks(data: bytes, start: int, end: int) -> Iterator[Span]:
    """A range in pieces that each begin before a line's end, with all white space there."""
    while end - start > CHUNK:
        newline = data.rfind(b"\n", start, start + CHUNK)
        cut = start + len(data[start:newline].rstrip()) if newline > start else start
        if cut == start:
            break
        yield start, cut
        start = cut
    yield start, end


def _width(lead: bytes) -> int:
    return len(lead.translate(None, b"\r\f\v").expandtabs(TAB))


def _comments_of_lines(data: bytes, start: int, end: int) -> Iterator[Span]:
    """The comments in a range that go over several lines."""
    if data.find(b"/*", start, end) < 0:
        return
    depth = opened = 0
    for match in _DELIMITER.finditer(data, start, end):
        if match.group() == b"/*":
            if depth == 0:
                opened = match.start()
            depth += 1
        else:
            depth -= 1
            if depth == 0 and b"\n" in data[opened : match.end()]:
                yield opened, match.end()


def _between(start: int, end: int, holes: list[Span]) -> Iterator[Span]:
    for hole in holes:
        yield start, hole[0]
        start = hole[1]
    yield start, end


_LINE_END = re.compile(rb"\r*\n")


def moved_comment(data: bytes, comment: Span, old: bytes | None, new: bytes, eol: bytes) -> Iterator[Change]:
    """The changes that move a comment of several lines with the line it begins on, whose indentation goes from `old`
    to `new`. It stays as it is where `old` is None, or where one of its lines stands further left: then its lines are
    not lined up with the scene's."""
    ends = list(_LINE_END.finditer(data, comment[0], comment[1]))
    stops = [*(match.start() for match in ends[1:]), comment[1]]
    filled = [bool(data[match.end() : stop].strip()) for match, stop in zip(ends, stops, strict=True)]
    moves = old is not None and all(
        data.startswith(old, match.end()) for match, full in zip(ends, filled, strict=True) if full
    )
    for match, full in zip(ends, filled, strict=True):
        start, end = match.span()
        text = eol
        if old is not None and moves and full:
            end += len(old)
            text += new
        if data[start:end] != text:
            yield Change(start, end, text)
