"""Inlay hints, `textDocument/inlayHint`: what a text does not say, shown between its words.

- the number of each vertex, as FACETS names it
- the names of arguments, where there are several bare numbers: REGION, the head of a table, the first row of one on a
  single line
- what a NUMBER or VECTOR variable stands for, where it is used, unless that is said on the same line or the one before

Columns that a person has lined up stay lined up: the rows of a table on several lines get no names, and the numbers of
vertices are equally wide.

Each kind can be switched off: `m3d.inlayHints.vertexIds`, `.argumentNames`, `.variableValues`. Only what is in view is
worked out.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from typing import TypeAlias

import numpy as np
from lsprotocol import types
from numpy.typing import NDArray

from m3d_language.table import Argument
from m3dc.meaning import program
from m3dc.meaning.values import Record, Value
from m3dc.syntax import ast, numerals
from m3dc.text.span import Local

from ..explain import argument_name
from ..names import Names, Role, names
from ..registry import request
from ..rows import row_starts
from ..snapshot import Snapshot
from ..summary import value_text
from ..text import Span

# More hints than fit on any screen.
MOST = 3000

# A blank as wide as a digit.
FIGURE_SPACE = "\N{FIGURE SPACE}"

# A hint, and the byte that it stands at.
_Placed: TypeAlias = tuple[int, types.InlayHint]


@request(types.TEXT_DOCUMENT_INLAY_HINT, types.InlayHintOptions(resolve_provider=False), nothing=[])
def inlay_hints(snapshot: Snapshot, params: types.InlayHintParams) -> list[types.InlayHint]:
    """The hints in a range of the text."""
    seen = snapshot.text.span(params.range)
    found: list[types.InlayHint] = []
    for offset, hint in _Hints(snapshot, seen).all():
        if not seen[0] <= offset < seen[1]:
            continue
        found.append(hint)
        if len(found) == MOST:
            break
    return found


class _Hints:
    """Walks what is in view."""

    def __init__(self, snapshot: Snapshot, seen: Span) -> None:
        self._snapshot = snapshot
        self._seen = seen
        self._wanted = snapshot.settings.inlayHints
        self._start = 0  # of the item
        self._names: Names = names(snapshot.analysis)

    def all(self) -> Iterator[_Placed]:
        items = self._snapshot.analysis.program
        first = max(bisect_right(items, self._seen[0], key=lambda item: item.start) - 1, 0)
        for item in items[first:]:
            if item.start > self._seen[1]:
                break
            self._start = item.start
            content = item.content
            if isinstance(content, (program.Block, program.Assignment)):
                if isinstance(content, program.Assignment) and content.value is not None:
                    yield from self._values([content.value])
                yield from self._body(content.body or ())

    def _in_view(self, span: Local) -> bool:
        start, end = span.within(self._start)
        return end >= self._seen[0] and start <= self._seen[1]

    def _body(self, body: tuple[program.Member, ...]) -> Iterator[_Placed]:
        for member in body:
            if not self._in_view(member.span):
                continue
            match member:
                case program.Block():
                    yield from self._body(member.body)
                case program.Statement():
                    yield from self._statement(member)
                case program.Table():
                    yield from self._table(member)

    # --- argument names -----------------------------------------------------------------------------------------

    def _statement(self, statement: program.Statement) -> Iterator[_Placed]:
        arguments = statement.entry.arguments
        if len(arguments) > 1:
            starts = [argument.span.within(self._start)[0] for argument in statement.arguments]
            yield from self._argument_names(arguments, starts)
        yield from self._values(statement.arguments)

    def _argument_names(self, arguments: Sequence[Argument], starts: Sequence[int]) -> Iterator[_Placed]:
        if not self._wanted.argumentNames:
            return
        for argument, start in zip(arguments, starts, strict=False):
            name = argument_name(argument) + (f" {argument.kind}" if argument.components else "")
            yield self._hint(start, f"{name}:", types.InlayHintKind.Parameter, before=True)

    # --- tables -------------------------------------------------------------------------------------------------

    def _table(self, table: program.Table) -> Iterator[_Placed]:
        starts = row_starts(table, self._start)
        first, last = np.searchsorted(starts, self._seen).tolist()
        if table.entry.head:
            yield from self._argument_names(table.entry.head, self._head(table, starts))
        if self._wanted.vertexIds and table.entry.keyword == "VERTICES" and len(table.entry.head) == 1:
            width = len(str(len(starts) - 1))
            for row in range(first, min(last, first + MOST)):
                yield self._hint(int(starts[row]), f"{str(row).rjust(width, FIGURE_SPACE)}:", None, before=True)
        # A row of FACETS is but the numbers of vertices.
        named = {argument.name for argument in table.entry.row if argument.kind != "index"}
        if len(named) > 1 and first == 0 < last and self._on_one_line(table.span):
            yield from self._argument_names(table.entry.row, self._first_row(table, starts))
        for row in table.rows[first:last]:
            yield from self._values(row)

    def _on_one_line(self, span: Local) -> bool:
        return b"\n" not in self._snapshot.text.data[slice(*span.within(self._start))]

    def _head(self, table: program.Table, starts: NDArray[np.int64]) -> Sequence[int]:
        """Where the arguments of a table's head begin."""
        if table.bulk is None:
            return [argument.span.within(self._start)[0] for argument in table.head]
        (_, start), (_, end) = table.keyword.span.within(self._start), table.span.within(self._start)
        return self._written_values(start, int(starts[0]) if len(starts) else end)

    def _first_row(self, table: program.Table, starts: NDArray[np.int64]) -> Sequence[int]:
        if table.bulk is None:
            return [argument.span.within(self._start)[0] for argument in table.rows[0]]
        _, end = table.span.within(self._start)
        return self._written_values(int(starts[0]), int(starts[1]) if len(starts) > 1 else end)

    def _written_values(self, start: int, end: int) -> list[int]:
        """Where the values in a part of a table begin."""
        return [place for place, _ in numerals.values(self._snapshot.text.data, start, end)]

    # --- values -------------------------------------------------------------------------------------------------

    def _values(self, arguments: Sequence[ast.Argument]) -> Iterator[_Placed]:
        """What the variables among arguments stand for."""
        if not self._wanted.variableValues:
            return
        for argument in arguments:
            if not self._in_view(argument.span) or isinstance(argument, ast.Number):
                continue
            for name in argument.components if isinstance(argument, ast.Vector) else (argument,):
                if isinstance(name, ast.Name):
                    start, end = name.span.within(self._start)
                    value = self._snapshot.analysis.variable(name.text, start)
                    if value is None or isinstance(value, Record):
                        continue
                    if not self._is_said(name.text, start, value):
                        yield self._hint(end, f"= {value_text(value)}", None, before=False)

    def _is_said(self, name: str, offset: int, value: Value) -> bool:
        """Whether a variable's value is said on the line of a use or the one before: where it was used before, or where
        it is assigned a number or a vector."""
        last = self._names.before(name, offset)
        if last is None or last.role is Role.DECLARATION:
            return False
        text = self._snapshot.text
        if text.line_of(offset) - text.line_of(last.span[0]) > 1:
            return False
        if last.role is Role.ASSIGNMENT:
            return self._is_written(last.span)
        return self._snapshot.analysis.variable(name, last.span[0]) == value

    def _is_written(self, target: Span) -> bool:
        """Whether a number, or a vector of numbers, is assigned to the target at a place."""
        at = ast.locate(self._snapshot.analysis.items, target)
        item = None if at is None else at.path[-1]
        value = item.value if isinstance(item, ast.Assignment) else None
        if isinstance(value, ast.Vector):
            return all(isinstance(component, ast.Number) for component in value.components)
        return isinstance(value, ast.Number)

    def _hint(self, offset: int, label: str, kind: types.InlayHintKind | None, *, before: bool) -> _Placed:
        position = self._snapshot.text.position(offset)
        return offset, types.InlayHint(position, label, kind=kind, padding_left=not before, padding_right=before)
