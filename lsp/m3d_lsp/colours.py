"""Where colours stand in a scene: in statements and tables that take one, and in the vectors that end up there."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from m3d_language.table import Argument
from m3dc.analysis import Analysis
from m3dc.meaning import program
from m3dc.meaning.values import Vector
from m3dc.syntax import ast, numerals

from .rows import row_starts
from .text import Span

KIND = "color"
# A table of colours has 20 rows at most; one that is longer is not looked at.
_MOST_ROWS = 100


class Colour(NamedTuple):
    """A colour in the text. `variable` is the name of the variable, where it stands for the colour."""

    span: Span
    value: Vector
    variable: str | None


class _Use(NamedTuple):
    """An argument that is a colour, in the item that begins at `start`."""

    argument: ast.Vector | ast.Name
    start: int


@lru_cache(maxsize=8)
def colours(analysis: Analysis) -> list[Colour]:
    """Every colour of a scene, as far as it is right, in the order of the text."""
    uses = list(_uses(analysis))
    variables = color_variables(analysis)
    for item in analysis.program:
        content = item.content
        if not isinstance(content, program.Assignment) or content.target.text not in variables:
            continue
        if isinstance(content.value, (ast.Vector, ast.Name)):
            uses.append(_Use(content.value, item.start))
    found = [colour for use in uses if (colour := _colour(use, analysis)) is not None]
    return sorted([*found, *_in_tables(analysis)])


@lru_cache(maxsize=8)
def color_variables(analysis: Analysis) -> frozenset[str]:
    """The vectors that are used as colours, or whose value another takes that is."""
    found = {use.argument.text for use in _uses(analysis) if isinstance(use.argument, ast.Name)}
    for item in reversed(analysis.program):
        content = item.content
        if not isinstance(content, program.Assignment) or content.target.text not in found:
            continue
        if isinstance(content.value, ast.Name):
            found.add(content.value.text)
    return frozenset(found)


def _uses(analysis: Analysis) -> Iterator[_Use]:
    for item in analysis.program:
        for member in program.leaves(item.content):
            lists = (
                [(member.entry.arguments, member.arguments)]
                if isinstance(member, program.Statement)
                else [(member.entry.row, row) for row in member.rows]
            )
            for expected, given in lists:
                yield from (_Use(argument, item.start) for argument in _of_kind(expected, given))


def _of_kind(expected: tuple[Argument, ...], given: tuple[ast.Argument, ...]) -> Iterator[ast.Vector | ast.Name]:
    for wanted, argument in zip(expected, given, strict=False):
        if wanted.kind == KIND and not isinstance(argument, ast.Number):
            yield argument


def _colour(use: _Use, analysis: Analysis) -> Colour | None:
    span = use.argument.span.within(use.start)
    value = analysis.value(use.argument, span[0])
    variable = use.argument.text if isinstance(use.argument, ast.Name) else None
    return Colour(span, value, variable) if isinstance(value, tuple) else None


def _in_tables(analysis: Analysis) -> Iterator[Colour]:
    """The colours in tables that hold nothing but numbers."""
    for item in analysis.program:
        for member in program.leaves(item.content):
            if isinstance(member, program.Table) and any(argument.kind == KIND for argument in member.entry.row):
                yield from _in_rows(member, item.start, analysis.source.data)


def _in_rows(table: program.Table, item: int, data: bytes) -> Iterator[Colour]:
    starts = row_starts(table, item)
    if table.bulk is None or not 0 < len(starts) <= _MOST_ROWS:
        return
    rows = np.asarray(table.bulk.rows).reshape(-1, table.bulk.width)
    ends = [*starts[1:].tolist(), table.span.within(item)[1] - 1]
    for row, start, end in zip(rows.tolist(), starts.tolist(), ends, strict=True):
        column = 0
        for argument, span in zip(table.entry.row, numerals.values(data, start, end), strict=False):
            width = max(len(argument.components), 1)
            if argument.kind == KIND:
                x, y, z = row[column : column + width]
                yield Colour(span, (x, y, z), None)
            column += width
