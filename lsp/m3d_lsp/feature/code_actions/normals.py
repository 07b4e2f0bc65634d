"""Turning FACETS into SFACETS: with a normal at every corner, and PHONG, a mesh looks smooth.

The normal at a corner is the mean of those of the facets about the vertex, by area, but only of facets that are turned
against its own by less than 60 degrees: sharper edges stay sharp.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import islice

import numpy as np
from lsprotocol import types
from numpy.typing import NDArray

from m3d_language import blank_comments
from m3dc.diagnostics import catalogue
from m3dc.meaning.transform import unit
from m3dc.meaning.values import Mesh, Record, spelled
from m3dc.syntax import ast, numerals

from .action import Action, Edit, Site

FLAT, SMOOTH, FLAG = "FACETS", "SFACETS", "PHONG"
SHARP = math.cos(math.radians(60))
DIGITS = 4


def find(site: Site) -> Iterator[Action]:
    """For a table of facets here, or the PHONG that has no effect on one."""
    table = _table(site)
    if table is not None:
        record = _record(site, table)
        if record is not None:
            title = f"Write {SMOOTH} with computed normals"
            mends = tuple(d for d in site.found if d.code == catalogue.PHONG_WITHOUT_NORMALS.code)
            kind = types.CodeActionKind.QuickFix if mends else types.CodeActionKind.RefactorRewrite
            yield Action(title, kind, [], mends, later=lambda: [_rewritten(site, table, record)])


def _table(site: Site) -> ast.Table | None:
    """The table of facets at the place, or beside the PHONG there."""
    if len(site.path) < 2:
        return None
    item, outer = site.path[-1], site.path[-2]
    if isinstance(item, ast.Table):
        return item if item.keyword.text == FLAT else None
    body = outer.body if isinstance(outer, (ast.Block, ast.Assignment)) else None
    if not isinstance(item, ast.Statement) or item.keyword.text != FLAG or body is None:
        return None
    return next((each for each in body.items if isinstance(each, ast.Table) and each.keyword.text == FLAT), None)


def _record(site: Site, table: ast.Table) -> Record | None:
    """The primitive that the table belongs to, if it has a mesh."""
    around = None if site.node is None else site.analysis.enclosing(site.node)
    if around is None:
        return None
    record = around.innermost
    value = record.tables.get(FLAT)
    own = value is not None and site.analysis.places.absolute(value.span).bytes == site.real(table.span)
    return record if own and record.mesh is not None and len(record.mesh.facets) else None


def _rewritten(site: Site, table: ast.Table, record: Record) -> Edit:
    """The table with its rows as they are, a line each, and normals behind them."""
    start, end = site.real(table.span)
    mesh = record.mesh
    assert mesh is not None
    line = site.data[site.data.rfind(b"\n", 0, start) + 1 : start]
    margin = "\n" + line[: len(line) - len(line.lstrip())].decode()
    text = site.data[start:end].decode("latin-1")
    plain = blank_comments(text)
    parts = [] if record.flag(FLAG) else [FLAG, margin if not line.strip() else " "]
    parts.append(SMOOTH)
    done = len(FLAT)
    data, offsets = plain.encode("latin-1"), mesh.offsets.tolist()
    for offset, after, corners in zip(offsets, [*offsets[1:], len(plain)], normals_of(mesh).tolist(), strict=True):
        _, _, (_, row_end) = islice(numerals.scalars(data, offset, after), 3)
        parts.append(text[done:row_end])
        parts += [f" < {', '.join(spelled(round(x, DIGITS) + 0.0) for x in normal)} >" for normal in corners]
        done = row_end
        blank = len(plain) - len(plain[done:].lstrip())
        if "\n" not in text[done:blank] and blank < len(text) - 1 and plain[done:blank] == text[done:blank]:
            parts.append(f"{margin}    ")
            done = blank
    parts.append(text[done:])
    return (start, end), "".join(parts).encode("latin-1").decode("utf-8", "replace")


def normals_of(mesh: Mesh) -> NDArray[np.float64]:
    """The normals at the corners of each facet, (m, 3, 3)."""
    corners = mesh.facets.astype(np.intp)
    a, b, c = (mesh.vertices[corners[:, corner]] for corner in range(3))
    areas = np.cross(b - a, c - a)
    own = unit(areas)
    facets = np.repeat(np.arange(len(corners)), 3)
    order = np.argsort(corners.reshape(-1), kind="stable")
    counts = np.bincount(corners.reshape(-1), minlength=len(mesh.vertices))
    first = np.cumsum(counts) - counts
    sums = np.zeros((len(facets), 3))
    # Each corner looks at the facets of its vertex one after the other: the first of each, the second, ...
    vertices = corners.reshape(-1)
    for number in range(int(counts.max())):
        looks = np.flatnonzero(counts[vertices] > number)
        other = facets[order[first[vertices[looks]] + number]]
        near = np.einsum("ij,ij->i", own[facets[looks]], own[other]) > SHARP
        sums[looks[near]] += areas[other[near]]
    return unit(sums).reshape(-1, 3, 3)
