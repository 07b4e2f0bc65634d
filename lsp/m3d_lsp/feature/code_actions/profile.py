"""Sorting the points of a PROFILE by their elevation."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from lsprotocol import types

from m3dc.diagnostics import catalogue
from m3dc.syntax import ast

from ...text import Span
from .action import Action, Edit, Site

KEYWORD = "PROFILE"


def find(site: Site) -> Iterator[Action]:
    """For a table at the place that is not sorted."""
    table = site.path[-1] if site.path else None
    if site.node is None or not isinstance(table, ast.Table) or table.keyword.text != KEYWORD:
        return
    edit = _sorted(site, site.node.item)
    if edit is not None:
        unsorted = (d for d in site.analysis.diagnostics if d.code == catalogue.PROFILE_NOT_INCREASING.code)
        mends = tuple(d for d in unsorted if _is_in(d.span.bytes, site, table))
        kind = types.CodeActionKind.QuickFix if mends else types.CodeActionKind.RefactorRewrite
        yield Action("Sort the points from low to high", kind, [edit], mends)


def _is_in(span: Span, site: Site, table: ast.Table) -> bool:
    start, end = site.real(table.span)
    return start <= span[0] < end


def _sorted(site: Site, table: ast.Located) -> Edit | None:
    """The rows in their new order, each with the comments behind it. None if they are in order, or can not be read."""
    start, end = table.span
    value = site.analysis.table_value(table)
    if value is None or len(value.rows) < 2:
        return None
    order = np.argsort(value.rows[:, 0], kind="stable")
    if (np.diff(order) > 0).all():
        return None
    starts = [start + int(offset) for offset in value.offsets]
    pieces = [site.data[a:b] for a, b in zip(starts, [*starts[1:], end - 1], strict=True)]
    rows = [piece.rstrip() for piece in pieces]
    blanks = [piece[len(row) :] for piece, row in zip(pieces, rows, strict=True)]
    places: list[int] = order.tolist()
    text = b"".join(rows[index] + blank for index, blank in zip(places, blanks, strict=True))
    return (starts[0], end - 1), text.decode("utf-8", "replace")
