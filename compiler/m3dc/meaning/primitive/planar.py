"""Endless planes, triangles and rectangles (thesis 7.5.5.3): three points, of which the second is P; U leads from it to
the third, V to the first."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from ...columns.column import POSITION, Column
from ...columns.rows import Rows
from ...diagnostics import Findings, catalogue
from ..transform import Transform, clean, unit
from ..values import Record
from .box import ball_about, may_meet, reach_of
from .degenerate import degenerate
from .primitive import Ball, Fact, Field, Points, Primitive, Tables


def _columns(what: str) -> dict[str, Column]:
    return {
        "point": Column("f8", (3,), "P, the reference point: VERTEX2", POSITION),
        "u": Column("f8", (3,), "U, from VERTEX2 to VERTEX3"),
        "v": Column("f8", (3,), "V, from VERTEX2 to VERTEX1"),
        "normal": Column("f8", (3,), f"U x V, the normal of the {what}, not normalised"),
    }


def _finish(record: Record, findings: Findings, *, whole: bool) -> None:
    first, second, third = _vertices(record)
    (ux, uy, uz), (vx, vy, vz) = third - second, first - second
    if degenerate((ux, uy, uz), (vx, vy, vz)):
        detail = "the three points must differ and not lie on one line"
        findings.add_at(catalogue.INVALID_VERTICES, record.span, detail)


def _vertices(record: Record) -> tuple[Points, Points, Points]:
    first, second, third = (np.array(record.vector(f"VERTEX{n}")) for n in (1, 2, 3))
    return first, second, third


def _corners(record: Record, transform: Transform) -> Points:
    """The corners (4, 3) of the rectangle that it is, or is half of."""
    first, second, third = _vertices(record)
    return transform.points(np.stack([first, second, third, first + third - second]))


def _reach(record: Record, transform: Transform) -> float:
    return reach_of(_corners(record, transform))


def _ball(record: Record, transform: Transform) -> Ball:
    return ball_about(_corners(record, transform))


def _reaches_into(_record: Record, _transform: Transform, own: Ball, ball: Ball) -> bool:
    return may_meet(own, ball)


def _lower(table: str, rows: Rows, record: Record, transform: Transform) -> int:
    first, second, third = _vertices(record)
    u, v = transform.vectors(third - second), transform.vectors(first - second)
    return rows.add(table, point=transform.points(second), u=u, v=v, normal=clean(np.cross(u, v)))


def _extent(corners: int, table: str, tables: Tables) -> Sequence[Points]:
    point, u, v = (tables[table][column] for column in ("point", "u", "v"))
    return [point, point + u, point + v, point + u + v][:corners]


def _dump(corners: Sequence[str], table: str, tables: Tables, row: int, _most: int | None) -> Iterator[Field]:
    point, u, v, normal = (tables[table][column][row] for column in ("point", "u", "v", "normal"))
    yield Field("Reference P", point)
    yield Field("U vector", u)
    yield Field("V vector", v)
    yield Field("Normal", normal)
    for label, corner in zip(corners, (point + v, point + u, point + u + v), strict=False):
        yield Field(label, corner)


def _facts(table: str, tables: Tables, row: int) -> Sequence[Sequence[Fact]]:
    p, u, v, normal = (tables[table][column][row] for column in ("point", "u", "v", "normal"))
    return [[Fact("corners", [p + v, p, p + u])], [Fact("normal", [unit(normal)])]]


def _point(record: Record, transform: Transform) -> Ball:
    return Ball(transform.points(np.array(record.vector("VERTEX2"))), 0.0)


def _passes_through(record: Record, transform: Transform, _own: Ball, ball: Ball) -> bool:
    first, second, third = (transform.points(vertex) for vertex in _vertices(record))
    normal = unit(np.cross(third - second, first - second))
    return abs(float((ball.centre - second) @ normal)) < ball.radius


def _no_extent(_tables: Tables) -> tuple[()]:
    return ()


def _finite(table: str, corners: Sequence[str]) -> Primitive:
    """Triangles or rectangles, with what the dump calls their corners besides P."""
    return Primitive(
        {table: _columns(table.removesuffix("s"))},
        _finish,
        partial(_lower, table),
        partial(_extent, 1 + len(corners), table),
        _reach,
        _ball,
        _reaches_into,
        partial(_dump, corners, table),
        partial(_facts, table),
    )


TRIANGLE = _finite("triangles", ["V1", "V3"])
RECTANGLE = _finite("rectangles", ["V1", "V3", "V4"])
PLANE = Primitive(
    {"planes": _columns("plane")},
    _finish,
    partial(_lower, "planes"),
    _no_extent,
    _reach,
    _point,
    _passes_through,
    partial(_dump, [], "planes"),
    partial(_facts, "planes"),
    is_endless=True,
)
