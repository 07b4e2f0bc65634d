"""Reading a broken stretch item by item, until one that the tree has whole."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ...diagnostics import TextFindings, catalogue
from ...text.span import Span
from .. import ast
from .cursor import Cursor
from .faults import Faults
from .items import read_item
from .nesting import AgainError
from .stray import ElsewhereError


class Read(NamedTuple):
    """An item and where it begins and ends; None where nothing of it can be used. `unclosed`: a block of it is."""

    start: int
    end: int
    item: ast.Item | None
    doubtful: bool
    unclosed: bool


class Reader:
    """Reads items one after the other: `read` are those read up to now, `stretches` where they stand."""

    def __init__(
        self, data: bytes, end: int, findings: TextFindings, whole: set[int], most: int, types: dict[str, str]
    ) -> None:
        self.read: list[Read] = []
        self.stretches: list[Span] = []
        self._faults = Faults(data, findings, most)
        self._cursor = Cursor(data, end, self._faults, whole, types)

    @property
    def names(self) -> set[str]:
        """The names that may be declared or assigned to in what was read."""
        return self._cursor.names

    @property
    def place(self) -> Span:
        """Where reading has come to."""
        return self._cursor.before, self._cursor.before

    def run(self, start: int, past: int) -> int:
        """Read items from a byte on, at least up to `past`, until one that the tree has whole; returns its start."""
        cursor = self._cursor
        cursor.begin(start)
        first = start
        while True:
            token = cursor.peek()
            if token.kind == "end" or (token.start >= past and token.start in cursor.whole):
                break
            try:
                self._item(token.start)
            except ElsewhereError as elsewhere:
                self.read = [read for read in self.read if read.start < elsewhere.start]
                first = min(first, elsewhere.start)
                past = max(past, token.end)
                cursor.begin(elsewhere.start)
        end = cursor.peek().start
        self._faults.settle()
        self.stretches = [span for span in self.stretches if span[1] <= first]
        self.stretches.append((first, end))
        return end

    def _item(self, start: int) -> None:
        """Read the item that begins at a byte."""
        cursor, faults = self._cursor, self._faults
        mark = faults.marks.setdefault(start, len(faults.findings.found))
        ignored = set(cursor.lexer.ignored)
        closed: Sequence[int] = ()
        strict = False
        while True:
            cursor.begin(start)
            cursor.strict = strict
            cursor.lexer.ignored = set(ignored)
            cursor.lexer.closed = sorted(closed)
            cursor.closed = bool(closed)
            try:
                item = read_item(cursor)
                break
            except AgainError as again:
                faults.forget_from(mark)
                closed, strict = again.closed, True
        if cursor.peek().start == start and cursor.before <= start:
            faults.add(catalogue.INVALID_AT_TOP, cursor.next().span, "this can not be read here")
        if item is not None:
            faults.settle()
        if cursor.doubtful and isinstance(item, ast.Assignment):
            cursor.names.add(item.target.text)
        self.read.append(Read(start, cursor.before, item, cursor.doubtful, cursor.unclosed_block))
