"""The vertices of a mesh: from the corner of a facet to the row of its vertex, and from there to all its facets."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from m3dc.analysis import Analysis
from m3dc.meaning import program
from m3dc.meaning.values import TableValue
from m3dc.syntax import ast, numerals

from .text import Span

VERTICES, FACETS = "VERTICES", ("FACETS", "SFACETS")


class Vertex(NamedTuple):
    """A vertex by its number: where its `row` is, and the `corners` of facets that name it, in order."""

    number: int
    row: Span
    corners: list[Span]


def vertex_at(analysis: Analysis, offset: int) -> Vertex | None:
    """The vertex that the row, or the corner of a facet, at a byte stands for; None elsewhere, and where the mesh is
    wrong."""
    at = ast.locate(analysis.items, (offset, offset))
    here = analysis.enclosing(at) if at is not None and isinstance(at.path[-1], ast.Table) else None
    if here is None or not isinstance(here.path.member, program.Table):
        return None
    tables = here.innermost.tables
    vertices = tables.get(VERTICES)
    facets = next((tables[keyword] for keyword in FACETS if keyword in tables), None)
    keyword = here.path.member.entry.keyword
    if vertices is None or facets is None or keyword not in (VERTICES, *FACETS):
        return None
    rows = _Rows(analysis, vertices), _Rows(analysis, facets)
    number = rows[0].at(offset) if keyword == VERTICES else rows[1].corner(offset)
    if number is None or not 0 <= number < len(vertices.rows):
        return None
    return Vertex(number, rows[0].values(number)[0], rows[1].corners(number))


class _Rows:
    """The rows of a table in the text."""

    def __init__(self, analysis: Analysis, table: TableValue) -> None:
        self._table = table
        self._data = analysis.source.data
        self._start, self._end = analysis.places.absolute(table.span).bytes

    def at(self, offset: int) -> int | None:
        """The row that a byte stands in."""
        row = int(np.searchsorted(self._table.offsets, offset - self._start, side="right")) - 1
        return row if row >= 0 and offset <= self.values(row)[-1][1] else None

    def values(self, row: int) -> list[Span]:
        """Where the values of a row are."""
        offsets = self._table.offsets
        start = self._start + int(offsets[row])
        end = self._start + int(offsets[row + 1]) if row + 1 < len(offsets) else self._end
        return list(numerals.values(self._data, start, end))

    def corner(self, offset: int) -> int | None:
        """The number of the vertex at the corner at a byte, in a table of facets."""
        row = self.at(offset)
        for column, (start, end) in enumerate(self.values(row)[:3] if row is not None else ()):
            if start <= offset <= end:
                return int(self._table.rows[row, column])
        return None

    def corners(self, number: int) -> list[Span]:
        """Where the facets name a vertex."""
        rows, columns = np.nonzero(self._table.rows[:, :3] == number)
        return [self.values(row)[column] for row, column in zip(rows.tolist(), columns.tolist(), strict=True)]
