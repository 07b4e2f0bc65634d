"""Writing the number of rows that a table has where it says another."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

import m3dc
from m3dc.diagnostics import catalogue
from m3dc.meaning import program
from m3dc.syntax import ast, numerals

from .action import Action, Edit, Site

MISCOUNTED = {catalogue.MORE_ROWS_THAN_SPECIFIED.code, catalogue.FEWER_ROWS_THAN_SPECIFIED.code}


def find(site: Site) -> Iterator[Action]:
    """For a table here of which the number of rows is wrong, be it that the place is where the rows end, where the
    number stands, or between them."""
    table = site.path[-1] if site.path else None
    about = site.real(table.span) if isinstance(table, ast.Table) else site.span
    for diagnostic in site.analysis.diagnostics:
        here = diagnostic in site.found or about[0] <= diagnostic.span.start < about[1]
        if diagnostic.code not in MISCOUNTED or not here:
            continue
        place = site.at(diagnostic.span.start)
        table = place.path[-1] if place.path else None
        rows = _rows(place) if isinstance(table, ast.Table) else None
        if rows is None or not isinstance(table, ast.Table):
            continue
        start, end = place.real(table.bulk or table.entries[0].span)
        count = next(numerals.scalars(site.data, start, end), None)
        if count is None or not site.text(count).isdecimal():
            continue
        edit: Edit = count, str(rows)
        if _is_safe(site, edit):
            title = f"Write that there are {rows} {table.keyword.text}"
            yield Action(title, types.CodeActionKind.QuickFix, [edit], (diagnostic,))


def _rows(place: Site) -> int | None:
    """How many rows the table has, if one number tells it."""
    here = None if place.node is None else place.analysis.enclosing(place.node)
    table = None if here is None else here.path.member
    if not isinstance(table, program.Table) or len(table.entry.head) != 1:
        return None
    return len(table.bulk.offsets) if table.bulk is not None else len(table.rows)


def _is_safe(site: Site, edit: Edit) -> bool:
    """Whether the rows that were not read so far bring no more errors than the one that goes."""
    (start, end), text = edit
    mended = m3dc.compile(site.data[:start] + text.encode() + site.data[end:])
    return _errors(mended.diagnostics) <= _errors(site.analysis.diagnostics)


def _errors(diagnostics: tuple[m3dc.Diagnostic, ...]) -> int:
    return sum(diagnostic.severity == "error" for diagnostic in diagnostics)
