"""The edges of everything in a scene."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR, Table
from m3dc.meaning.transform import unit

Points = NDArray[np.float64]

CIRCLE_STEPS = 48
PLANE_LINES = 20

Roundness = Callable[[Points, float], int]


class Edges(NamedTuple):
    """Line segments: `starts` and `ends` (n, 3) in the scene, the `color` (3) that all are drawn in, and the `name` of
    what they belong to, such as solid-3, after its row in the IR. `curved` says that only the segments' ends lie on
    the surface they belong to."""

    starts: Points
    ends: Points
    color: Points
    name: str
    curved: bool = False


def edges(ir: SceneIR, roundness: Roundness | None = None) -> Iterator[Edges]:
    """The edges of every primitive of solids and lights, in the colour of its object. `roundness` gives the number of
    segments of a circle about a centre with a radius; it is CIRCLE_STEPS if not given."""
    primitives = ir["primitives"]
    for kind, row, solid, light in zip(
        *(primitives[column].tolist() for column in ("kind", "row", "solid", "light")), strict=True
    ):
        color = ir["surfaces"]["color"][solid] if solid >= 0 else ir["lights"]["color"][light]
        name = f"solid-{solid}" if solid >= 0 else f"light-{light}"
        starts, ends = _outline(ir, PrimitiveKind(kind), row, roundness)
        yield Edges(starts, ends, np.asarray(color, float), name, kind == PrimitiveKind.SPHERE)


def _outline(ir: SceneIR, kind: PrimitiveKind, row: int, roundness: Roundness | None) -> tuple[Points, Points]:
    table = ir[PRIMITIVE_TABLE[kind]]
    if kind is PrimitiveKind.SPHERE:
        return _sphere(table, row, roundness)
    if kind in (PrimitiveKind.POLYGONS, PrimitiveKind.TERRAIN):
        return _mesh(ir, row)
    point, u, v = (table[column][row] for column in ("point", "u", "v"))
    if kind is PrimitiveKind.PLANE:
        return _grid(ir, point, u, v)
    corners = [point + v, point, point + u]
    if kind is PrimitiveKind.RECTANGLE:
        corners.append(point + u + v)
    return _closed(np.array(corners))


def _closed(corners: Points) -> tuple[Points, Points]:
    return corners, np.roll(corners, -1, axis=0)


def _sphere(table: Table, row: int, roundness: Roundness | None) -> tuple[Points, Points]:
    """The equator, two parallels and four meridians."""
    centre, radius = table["center"][row], float(table["radius"][row])
    pole, x = table["pole"][row], table["equator"][row]
    y = np.cross(pole, x)
    steps = CIRCLE_STEPS if roundness is None else roundness(centre, radius)
    angle = np.linspace(0, 2 * math.pi, steps, endpoint=False)[:, None]
    circles: list[Points] = []
    for latitude in (-math.pi / 4, 0.0, math.pi / 4):
        around = np.cos(angle) * x + np.sin(angle) * y
        circles.append(centre + radius * (math.cos(latitude) * around + math.sin(latitude) * pole))
    for longitude in np.linspace(0, math.pi, 4, endpoint=False):
        side = math.cos(longitude) * x + math.sin(longitude) * y
        circles.append(centre + radius * (np.cos(angle) * side + np.sin(angle) * pole))
    starts, ends = zip(*(_closed(circle) for circle in circles), strict=True)
    return np.concatenate(starts), np.concatenate(ends)


def _mesh(ir: SceneIR, row: int) -> tuple[Points, Points]:
    """Every edge of the facets once."""
    mesh = {name: int(column[row]) for name, column in ir["meshes"].items()}
    facets = ir["facets"]["vertex"][mesh["first_facet"] : mesh["first_facet"] + mesh["facet_count"]]
    pairs = np.concatenate([facets[:, (0, 1)], facets[:, (1, 2)], facets[:, (2, 0)]])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    positions = ir["vertices"]["position"]
    return positions[pairs[:, 0]], positions[pairs[:, 1]]


def _grid(ir: SceneIR, point: Points, u: Points, v: Points) -> tuple[Points, Points]:
    """A square of grid lines in a plane, below whatever is in the scene and around the eye's target."""
    u, v = unit(u), unit(v)
    normal = unit(np.cross(u, v))
    v = np.cross(normal, u)
    scene = ir.scene
    near = np.array([scene.view.target])
    if scene.extent is not None:
        near = np.array([scene.extent.minimum, scene.extent.maximum])
    middle, reach = near.mean(axis=0), float(np.ptp(near, axis=0).max()) or 10.0
    middle = middle - normal * ((middle - point) @ normal)
    at = np.linspace(-reach, reach, PLANE_LINES + 1)[:, None]
    across, along = middle + at * u, middle + at * v
    starts = np.concatenate([across - reach * v, along - reach * u])
    ends = np.concatenate([across + reach * v, along + reach * u])
    return _split(starts, ends)


def _split(starts: Points, ends: Points) -> tuple[Points, Points]:
    """Long lines in pieces, so that the part before the eye is drawn where the rest is behind it."""
    at = np.linspace(0, 1, PLANE_LINES + 1)[:, None, None]
    points = starts + at * (ends - starts)
    return points[:-1].reshape(-1, 3), points[1:].reshape(-1, 3)
