"""What a row of a table says, in Markdown: which vertex it is and where, which facet, what the air does to light."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3dc.analysis import Enclosing
from m3dc.meaning import program
from m3dc.meaning.values import Record, TableValue

from .air import EARTH_CURVATURE, Air
from .markdown import shown
from .resolved import in_scene
from .summary import number, vector


class Row(NamedTuple):
    """A row of a table: its number in the text, the values of the whole table, and its `place` among them."""

    number: int
    table: TableValue
    place: int


def row_at(here: Enclosing, offset: int) -> Row | None:
    """The row of the table around a byte; None in its head, and where the table could not be read."""
    member, item = here.path.member, here.path.item
    value = here.innermost.tables.get(member.entry.keyword) if isinstance(member, program.Table) else None
    if value is None or not isinstance(member, program.Table):
        return None
    starts = row_starts(member, item.start)
    row = int(np.searchsorted(starts, offset, side="right")) - 1
    if row < 0:
        return None
    if value.span.start == member.span.at(item.base).start:
        return Row(row, value, row + len(value.rows) - len(starts))  # COLORS come after those there are already
    places = value.offsets.astype(np.int64) + value.span.start
    found = np.flatnonzero(places == int(starts[row]) - item.start + item.base)
    return Row(row, value, int(found[0])) if found.size else None  # a later PROFILE took its place


def row_starts(table: program.Table, start: int) -> NDArray[np.int64]:
    """Where the rows of a table begin, in bytes of the text, when its item begins at `start`."""
    if table.bulk is not None:
        return np.asarray(table.bulk.offsets).astype(np.int64) + (start - table.origin)
    return np.array([row[0].span.within(start)[0] for row in table.rows], np.int64)


def facts(here: Enclosing, offset: int, *, images: bool) -> str:
    """What the row around a byte says; '' where there is none."""
    row = row_at(here, offset)
    if row is None:
        return ""
    keyword = here.path.member.entry.keyword if here.path.member is not None else ""
    values = row.table.rows[row.place]
    match keyword:
        case "VERTICES":
            return _vertex(here, row)
        case "FACETS" | "SFACETS":
            return _facet(here, row)
        case "PROFILE":
            return _profile(here.innermost, row)
        case "COLORS":
            start, end = (number(value) for value in values[:2])
            first, last = (shown(values[columns], images=images) for columns in (slice(2, 5), slice(5, 8)))
            return f"Range {row.place + 1}: from {start}, {first}, to {end}, {last}"
        case _:
            return ""


def _vertex(here: Enclosing, row: Row) -> str:
    values = row.table.rows[row.place]
    name = f"Vertex **{row.place}** of {len(row.table.rows)}, counted from 0"
    if len(row.table.head) == 2:
        columns = max(row.table.head[1], 1)
        name = f"Row {row.place // columns}, column {row.place % columns} of the grid, counted from 0"
    scene = in_scene(here).points(values)
    return f"{name}: `{vector(values)}`" + ("" if np.array_equal(scene, values) else f"\n\nMoved to `{vector(scene)}`")


def _facet(here: Enclosing, row: Row) -> str:
    vertices = here.innermost.tables.get("VERTICES")
    lines = [f"Facet {row.place + 1} of {len(row.table.rows)}:\n"]
    for corner in row.table.rows[row.place][:3].astype(int).tolist():
        known = vertices is not None and 0 <= corner < len(vertices.rows)
        lines.append(f"- vertex {corner}: " + (f"`{vector(vertices.rows[corner])}`" if known and vertices else "none"))
    return "\n".join(lines)


def _profile(mirage: Record, row: Row) -> str:
    """The air between a point of the profile and its neighbours: the gradient of temperature, and how a level ray is
    curved there."""
    heights, temperatures = row.table.rows.T.tolist()
    try:
        air = Air(heights, temperatures)
    except ValueError:
        return ""
    parts = [f"{number(temperatures[row.place])} °C at {number(heights[row.place])} m"]
    for name, low in (("Above", row.place), ("Below", row.place - 1)):
        if not 0 <= low < len(heights) - 1:
            continue
        layer = air.layer(low)
        parts.append(f"**{name}**, {number(layer.bottom)} to {number(layer.top)} m:\n")
        parts[-1] += f"\n- temperature gradient dT/dz = {layer.gradient:+.4g} K/m"
        if layer.bottom >= mirage.number("ELEVATION"):
            parts[-1] += "\n- above the ELEVATION of the MIRAGE, rays go on straight"
            continue
        curvature, effective = layer.curvature, layer.curvature - EARTH_CURVATURE
        parts[-1] += f"\n- ray curvature κ = {curvature:.3e} 1/m, radius {_radius(curvature)}"
        parts[-1] += f"\n- less the earth's {EARTH_CURVATURE:.3e}: {effective:.3e} 1/m, radius {_radius(effective)}"
    return "\n\n".join(parts)


def _radius(curvature: float) -> str:
    """The radius of curvature, and to which side."""
    if curvature == 0.0:
        return "infinite: straight"
    radius = abs(1 / curvature) / 1000
    shown = f"{radius:,.0f}" if radius >= 1000 else f"{radius:.4g}"
    return f"{shown} km, bent {'down' if curvature > 0 else 'up'}"
