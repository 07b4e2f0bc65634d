"""A scene's text: bytes, and where they stand in lines and columns."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .span import MAIN, FileId

BYTE_ORDER_MARK = b"\xef\xbb\xbf"


class Position(NamedTuple):
    """A place as people count it: line and column from 1, the column in characters."""

    line: int
    column: int


class Source:
    """The text of one file of a scene, `file`. Offsets everywhere in the compiler are byte offsets into `data`.

    A UTF-8 byte order mark is read as white space, so that offsets stay those of the file; it is no character of the
    first line.
    """

    def __init__(self, data: bytes, name: str = "", file: FileId = MAIN) -> None:
        self._begin = len(BYTE_ORDER_MARK) if data.startswith(BYTE_ORDER_MARK) else 0
        if self._begin:
            data = b" " * self._begin + data[self._begin :]
        self.data = data
        self.name = name
        self.file = file

    @cached_property
    def _line_starts(self) -> NDArray[np.int64]:
        newlines = np.flatnonzero(np.frombuffer(self.data, np.uint8) == 0x0A)
        return np.concatenate([np.zeros(1, np.int64), newlines + 1])

    @property
    def line_count(self) -> int:
        """How many lines there are; what follows the last line's end is one only if it is not empty."""
        return len(self._line_starts) - int(self._line_starts[-1] == len(self.data))

    def position(self, offset: int) -> Position:
        """Line and column of the character at a byte offset, which may be the end of the text."""
        line = int(np.searchsorted(self._line_starts, offset, side="right"))
        start = max(int(self._line_starts[line - 1]), self._begin)
        return Position(line, len(self.data[start:offset].decode("utf-8", "replace")) + 1)

    def line(self, number: int) -> str:
        """The text of a line, counted from 1, without its end."""
        start = max(int(self._line_starts[number - 1]), self._begin)
        end = int(self._line_starts[number]) if number < len(self._line_starts) else len(self.data)
        return self.data[start:end].decode("utf-8", "replace").rstrip("\r\n")

    def text(self, start: int, end: int) -> str:
        """The characters of a range of bytes."""
        return self.data[start:end].decode("utf-8", "replace")
