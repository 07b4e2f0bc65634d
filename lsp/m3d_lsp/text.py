"""The text of an open document: bytes, and LSP's lines and characters."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from weakref import ref

import numpy as np
from lsprotocol import types
from numpy.typing import NDArray

from m3dc import Source
from m3dc.text.differences import Differences
from m3dc.text.span import Span

__all__ = ["Span", "Text"]


class Text:
    """One version of a document. Immutable; offsets are bytes of its UTF-8 form.

    `encoding` is `"utf-8"`, `"utf-16"` or `"utf-32"`: what a position's `character` counts. Lines end with a line feed,
    a carriage return, or both, as LSP says.
    """

    def __init__(
        self, data: bytes, name: str = "", encoding: str = "utf-16", starts: NDArray[np.int64] | None = None
    ) -> None:
        self.data = data
        self.name = name
        self.encoding = encoding
        self._starts = _line_starts(data) if starts is None else starts
        # What lies between older versions, as long as somebody has them, and this one.
        self._since: dict[ref[Text], Differences] = {}

    @classmethod
    def of(cls, text: str, name: str = "", encoding: str = "utf-16") -> Text:
        """A document with the text that a client sent."""
        return cls(text.encode("utf-8", "surrogatepass"), name, encoding)

    @cached_property
    def source(self) -> Source:
        """The text as the compiler takes it."""
        return Source(self.data, self.name)

    @property
    def line_count(self) -> int:
        return len(self._starts)

    def line_start(self, line: int) -> int:
        """Where a line begins; the end of the text for one after the last."""
        return int(self._starts[line]) if line < len(self._starts) else len(self.data)

    def line_of(self, offset: int) -> int:
        """The line that holds a byte."""
        return int(np.searchsorted(self._starts, offset, side="right")) - 1

    def line_end(self, line: int) -> int:
        """Where a line ends, its line break left out."""
        start, end = self.line_start(line), self.line_start(line + 1)
        while end > start and self.data[end - 1] in b"\r\n":
            end -= 1
        return end

    def line(self, line: int) -> str:
        """The characters of a line, without its line break."""
        return _decode(self.data[self.line_start(line) : self.line_end(line)])

    def part(self, span: Span) -> str:
        """The characters of a range of bytes."""
        return _decode(self.data[span[0] : span[1]])

    def offset(self, position: types.Position) -> int:
        """The byte at a position; one beyond the end of its line is the end of the line."""
        if position.line >= self.line_count:
            return len(self.data)
        start, end = self.line_start(position.line), self.line_end(position.line)
        line = self.data[start:end]
        if line.isascii() or self.encoding == "utf-8":
            return start + min(position.character, len(line))
        units, offset = 0, start
        for character in _decode(line):
            if units >= position.character:
                break
            units += _units(character, self.encoding)
            offset += len(character.encode("utf-8", "surrogatepass"))
        return offset

    def position(self, offset: int) -> types.Position:
        """The position of a byte."""
        line = self.line_of(offset)
        before = self.data[self.line_start(line) : offset]
        units = len(before) if before.isascii() else _units(_decode(before), self.encoding)
        return types.Position(line, units)

    def range(self, span: Span) -> types.Range:
        """A range of bytes as LSP's."""
        return types.Range(self.position(span[0]), self.position(span[1]))

    def positions(self, offsets: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The lines and characters of many bytes at once."""
        lines = np.searchsorted(self._starts, offsets, side="right") - 1
        starts = self._starts[lines]
        return lines, offsets - starts + self._surplus(offsets) - self._surplus(starts)

    def ranges(self, spans: Sequence[Span]) -> list[types.Range]:
        """Many ranges of bytes as LSP's."""
        lines, characters = self.positions(np.array(spans, np.int64).reshape(-1))
        places = list(map(types.Position, lines.tolist(), characters.tolist()))
        return list(map(types.Range, places[::2], places[1::2]))

    def _surplus(self, offsets: NDArray[np.int64]) -> NDArray[np.int64]:
        """How many units more than bytes there are before each byte of the text."""
        wide, surplus = self._wide
        return surplus[np.searchsorted(wide, offsets)]

    @cached_property
    def _wide(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Where the bytes are that are no unit of their own, and how many units more than bytes there are before each
        of them, and after the last."""
        if self.encoding == "utf-8" or self.data.isascii():
            return np.zeros(0, np.int64), np.zeros(1, np.int64)
        data = np.frombuffer(self.data, np.uint8)
        within = (data & 0xC0) == 0x80
        pairs = data >= 0xF0 if self.encoding == "utf-16" else np.zeros(len(data), np.bool_)
        wide = np.flatnonzero(within | pairs)
        return wide, np.concatenate([np.zeros(1, np.int64), np.cumsum(pairs[wide].astype(np.int64) - within[wide])])

    def span(self, range_: types.Range) -> Span:
        """LSP's range as one of bytes."""
        return self.offset(range_.start), self.offset(range_.end)

    def changed(self, range_: types.Range, new: str) -> Text:
        """The text with another in place of a range."""
        start, end = self.span(range_)
        end = max(start, end)
        inserted = new.encode("utf-8", "surrogatepass")
        data = self.data[:start] + inserted + self.data[end:]
        starts = None
        if b"\r" not in inserted and b"\r" not in self.data[max(start - 1, 0) : end + 1]:
            first, last = self.line_of(start), self.line_of(end)
            starts = np.concatenate([
                self._starts[: first + 1],
                _line_starts(inserted)[1:] + start,
                self._starts[last + 1 :] + (len(inserted) - (end - start)),
            ])  # fmt: skip
        text = Text(data, self.name, self.encoding, starts)
        known: dict[ref[Text], Differences] = {**self._since, ref(self): Differences()}
        for older, differences in known.items():
            if older() is not None:
                text._since[older] = differences.then(start, end, len(inserted))
        return text

    def since(self, older: Text) -> Differences:
        """What lies between an older version and this one: the edits, where all are known; otherwise what is found by
        comparing the two, which takes a while for very long texts."""
        known = self._since.get(ref(older))
        if known is None:
            known = Differences() if older is self else Differences.between(older.data, self.data)
            self._since[ref(older)] = known
        return known


def _units(text: str, encoding: str) -> int:
    """How many units of an encoding a text takes."""
    match encoding:
        case "utf-8":
            return len(text.encode("utf-8", "surrogatepass"))
        case "utf-16":
            return len(text.encode("utf-16-le", "surrogatepass")) // 2
        case _:
            return len(text)


def _line_starts(data: bytes) -> NDArray[np.int64]:
    characters = np.frombuffer(data, np.uint8)
    ends = characters == 0x0A
    if b"\r" in data:
        returns = characters == 0x0D
        returns[:-1] &= characters[1:] != 0x0A
        ends |= returns
    return np.concatenate([np.zeros(1, np.int64), np.flatnonzero(ends) + 1])


def _decode(data: bytes) -> str:
    try:
        return data.decode("utf-8", "surrogatepass")
    except UnicodeDecodeError:
        return data.decode("utf-8", "replace")
