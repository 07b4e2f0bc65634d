"""Spheres (thesis 7.5.5.3). A transformation moves and turns one, and makes it larger, but never an ellipsoid."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ...columns.column import FARTHEST, POSITION, UNIT, Column, Within
from ...columns.rows import Rows
from ...diagnostics import Findings
from ..transform import IDENTITY, Transform, clean, unit
from ..values import Record
from .box import may_meet
from .primitive import Ball, Fact, Field, Points, Primitive, Tables

_TABLES = {
    "spheres": {
        "center": Column("f8", (3,), "centre", POSITION),
        "radius": Column("f8", (), "radius", Within(0.0, FARTHEST)),
        "pole": Column("f8", (3,), "unit vector to the north pole, where u is 0", UNIT),
        "equator": Column("f8", (3,), "unit vector to where v is 0, at right angles to the pole", UNIT),
    },
}


def _finish(record: Record, findings: Findings, *, whole: bool) -> None:
    pass


def _ball(record: Record, transform: Transform) -> Ball:
    centre = transform.points(np.array(record.vector("CENTER")))
    return Ball(centre, record.number("RADIUS") * transform.length())


def _reach(record: Record, transform: Transform) -> float:
    centre, radius = _ball(record, transform)
    return float(np.abs(centre).max()) + radius


def _reaches_into(_record: Record, _transform: Transform, own: Ball, ball: Ball) -> bool:
    """A sphere is hollow: it has no points in a ball that it surrounds."""
    surrounds = math.dist(own.centre, ball.centre) + ball.radius <= own.radius
    return may_meet(own, ball) and not surrounds


def _lower(rows: Rows, record: Record, transform: Transform) -> int:
    if transform is IDENTITY:
        return rows.add(
            "spheres",
            center=record.vector("CENTER"),
            radius=record.number("RADIUS"),
            pole=(0.0, 0.0, 1.0),
            equator=(1.0, 0.0, 0.0),
        )
    centre, radius = _ball(record, transform)
    pole, x = unit(transform.ways(np.array([0.0, 0.0, 1.0]))), transform.ways(np.array([1.0, 0.0, 0.0]))
    equator = unit(x - pole * (x @ pole))
    return rows.add("spheres", center=centre, radius=radius, pole=clean(pole), equator=clean(equator))


def _extent(tables: Tables) -> tuple[Points, Points]:
    center, radius = tables["spheres"]["center"], tables["spheres"]["radius"][:, None]
    return center - radius, center + radius


def _dump(tables: Tables, row: int, _most: int | None) -> Iterator[Field]:
    sphere = {name: column[row] for name, column in tables["spheres"].items()}
    yield Field("Radius", float(sphere["radius"]))
    yield Field("Center", sphere["center"])
    yield Field("North Pole", sphere["pole"])
    yield Field("Equator", sphere["equator"])


def _facts(tables: Tables, row: int) -> Sequence[Sequence[Fact]]:
    spheres = tables["spheres"]
    return [[Fact("centre", [spheres["center"][row]]), Fact("radius", [float(spheres["radius"][row])])]]


SPHERE = Primitive(_TABLES, _finish, _lower, _extent, _reach, _ball, _reaches_into, _dump, _facts)
