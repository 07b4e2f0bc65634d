"""What formatting changes, as a unified diff: made of the edits, so that no time goes into finding what differs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from .edits import Edit

CONTEXT = 3


def unified_diff(data: bytes, edits: Iterable[Edit], name: str) -> Iterator[bytes]:
    """The diff between a file's text and the same with its edits made, piece by piece; nothing without edits."""
    writer = _Writer(data)
    hunk: list[_Region] = []
    for region in _regions(data, edits):
        if not writer.begun:
            yield f"--- {name}\n+++ {name}\n".encode("utf-8", "surrogateescape")
            writer.begun = True
        if hunk and data.count(b"\n", hunk[-1].end, region.start) > 2 * CONTEXT:
            yield from writer.hunk(hunk)
            hunk = []
        hunk.append(region)
    if hunk:
        yield from writer.hunk(hunk)


class _Region(NamedTuple):
    """Whole lines, `data[start:end]`, and the lines that take their place."""

    start: int
    end: int
    text: bytes


def _regions(data: bytes, edits: Iterable[Edit]) -> Iterator[_Region]:
    """The runs of lines with edits in them."""
    start = done = end = 0
    text = bytearray()
    for edit in edits:
        if edit.span[0] > end or not done:
            if done:
                yield _trimmed(data, start, end, bytes(text + data[done:end]))
            start = done = data.rfind(b"\n", 0, edit.span[0]) + 1
            text.clear()
        text += data[done : edit.span[0]]
        text += edit.text.encode()
        done = edit.span[1]
        end = _line_end(data, done)
    if text or end > start:
        yield _trimmed(data, start, end, bytes(text + data[done:end]))


def _line_end(data: bytes, offset: int) -> int:
    """The beginning of the line after an offset's."""
    return data.find(b"\n", offset) + 1 or len(data)


def _trimmed(data: bytes, start: int, end: int, text: bytes) -> _Region:
    """A region without the lines that are alike at its beginning and its end."""
    first, last = 0, len(text)
    while start < end:
        line = data[start : _line_end(data, start)]
        if not line.endswith(b"\n") or not text.startswith(line, first, last):
            break
        start, first = start + len(line), first + len(line)
    while start < end and first < last:
        line = data[max(data.rfind(b"\n", start, end - 1) + 1, start) : end]
        at = last - len(line)
        if not text.endswith(line, first, last) or (at > first and text[at - 1 : at] != b"\n"):
            break
        end, last = end - len(line), at
    return _Region(start, end, text[first:last])


class _Writer:
    """Writes hunks in their order, and keeps count of the lines."""

    def __init__(self, data: bytes) -> None:
        self.begun = False
        self._data = data
        self._at = 0
        self._line = 0  # of the old text, from 0
        self._ahead = 0  # how many lines the new text has more until here

    def hunk(self, regions: list[_Region]) -> Iterator[bytes]:
        """Regions near one another, with the lines between and about them."""
        data = self._data
        begin = regions[0].start
        for _ in range(CONTEXT):
            begin = data.rfind(b"\n", 0, max(begin - 1, 0)) + 1
        end = regions[-1].end
        for _ in range(CONTEXT):
            end = _line_end(data, end)
        gone = _count(data[begin:end])
        come = gone + sum(_count(region.text) - _count(data[region.start : region.end]) for region in regions)
        self._line += data.count(b"\n", self._at, begin)
        self._at = begin
        yield f"@@ -{_range(self._line, gone)} +{_range(self._line + self._ahead, come)} @@\n".encode()
        self._ahead += come - gone
        for region in regions:
            yield _marked(b" ", data[begin : region.start])
            yield _marked(b"-", data[region.start : region.end])
            yield _marked(b"+", region.text)
            begin = region.end
        yield _marked(b" ", data[begin:end])


def _count(text: bytes) -> int:
    """How many lines a text has; the last need not end."""
    return text.count(b"\n") + (text[-1:] not in (b"", b"\n"))


def _range(line: int, count: int) -> str:
    """Lines as a hunk's header gives them."""
    start = line + 1 if count else line
    return f"{start}" if count == 1 else f"{start},{count}"


def _marked(mark: bytes, text: bytes) -> bytes:
    """Lines with a mark before each."""
    if not text:
        return b""
    if not text.endswith(b"\n"):
        return mark + text.replace(b"\n", b"\n" + mark) + b"\n\\ No newline at end of file\n"
    return mark + text[:-1].replace(b"\n", b"\n" + mark) + b"\n"
