"""The finite things of a scene as triangles: those of its solids, and of its visible lights."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR

Points = NDArray[np.float64]
Rows = NDArray[np.int64]

FINEST_SPHERE = 48
"""Sides of a sphere's equator, where there are not many spheres."""

COARSEST_SPHERE = 8

_MOST_TRIANGLES = 2_000_000  # of all spheres together, while they are finer than the coarsest


class Mesh(NamedTuple):
    """`points` (n, 3); `triangles` (m, 3), rows of points; `primitives` (m), the row of the IR that each is part of.

    `normals` (n, 3) are unit vectors where light is to fall smoothly over the triangles' edges, else None.
    """

    points: Points
    triangles: Rows
    primitives: Rows
    normals: Points | None = None


def flat_bodies(ir: SceneIR) -> Mesh:
    """Triangles, rectangles, and polygons and terrain that are not PHONG."""
    parts = [
        _corners(ir, PrimitiveKind.TRIANGLE, [[0, 1, 2]]),
        _corners(ir, PrimitiveKind.RECTANGLE, [[0, 1, 2], [0, 2, 3]]),
    ]
    positions = ir["vertices"]["position"]
    for primitive, row in _meshes(ir, phong=False):
        first, facets = int(ir["meshes"]["first_vertex"][row]), _facets(ir, row)
        count = int(ir["meshes"]["vertex_count"][row])
        triangles = ir["facets"]["vertex"][facets].astype(np.int64) - first
        parts.append(Mesh(positions[first : first + count], triangles, np.full(len(triangles), primitive)))
    return _joined(parts)


def smooth_bodies(ir: SceneIR) -> Mesh:
    """Spheres, and polygons and terrain that are PHONG, with the normals of the scene."""
    parts = [_spheres(ir)]
    for primitive, row in _meshes(ir, phong=True):
        facets = _facets(ir, row)
        points = ir["vertices"]["position"][ir["facets"]["vertex"][facets]].reshape(-1, 3)
        normals = ir["normals"]["direction"][ir["facets"]["normal"][facets]].reshape(-1, 3)
        triangles = np.arange(len(points)).reshape(-1, 3)
        parts.append(Mesh(points, triangles, np.full(len(triangles), primitive), normals))
    return _joined(parts)


def primitive_colors(ir: SceneIR) -> Points:
    """The colour (n, 3), 0..1, of every primitive: COLOR of its solid's SURFACE, or of its light. Textures are left
    out."""
    solid, light = ir["primitives"]["solid"], ir["primitives"]["light"]
    colors = np.zeros((len(solid), 3))
    colors[solid >= 0] = ir["surfaces"]["color"][solid[solid >= 0]]
    colors[solid < 0] = ir["lights"]["color"][light[solid < 0]]
    return np.clip(colors, 0, 1)


def sphere_sides(count: int) -> int:
    """Of how many sides the equator of each of so many spheres is made; it has half as many parallels."""
    affordable = math.sqrt(_MOST_TRIANGLES / max(count, 1))
    return int(np.clip(affordable // 4 * 4, COARSEST_SPHERE, FINEST_SPHERE))


def _of_kind(ir: SceneIR, kind: PrimitiveKind) -> tuple[Rows, Rows]:
    """The primitives of a kind, and their rows in its table."""
    primitives = np.flatnonzero(ir["primitives"]["kind"] == kind)
    return primitives, ir["primitives"]["row"][primitives].astype(np.int64)


def _corners(ir: SceneIR, kind: PrimitiveKind, triangles: list[list[int]]) -> Mesh:
    """All of a kind that is told by three corners, or by a fourth beside them."""
    primitives, rows = _of_kind(ir, kind)
    point, u, v = (ir[PRIMITIVE_TABLE[kind]][column][rows] for column in ("point", "u", "v"))
    corners = np.stack([point + v, point, point + u, point + u + v][: 2 + len(triangles)], axis=1)
    firsts = corners.shape[1] * np.arange(len(rows))[:, None, None]
    faces = (firsts + np.array(triangles)).reshape(-1, 3)
    return Mesh(corners.reshape(-1, 3), faces, np.repeat(primitives, len(triangles)))


def _spheres(ir: SceneIR) -> Mesh:
    primitives, rows = _of_kind(ir, PrimitiveKind.SPHERE)
    directions, triangles = _unit_sphere(sphere_sides(len(rows)))
    spheres = ir["spheres"]
    pole, equator = spheres["pole"][rows], spheres["equator"][rows]
    axes = np.stack([equator, np.cross(pole, equator), pole], axis=1)
    normals = directions @ axes
    points = spheres["center"][rows][:, None] + spheres["radius"][rows][:, None, None] * normals
    faces = len(directions) * np.arange(len(rows))[:, None, None] + triangles
    return Mesh(
        points.reshape(-1, 3), faces.reshape(-1, 3), np.repeat(primitives, len(triangles)), normals.reshape(-1, 3)
    )


def _unit_sphere(sides: int) -> tuple[Points, Rows]:
    """A sphere about the origin: its north pole, its south pole, and the parallels between, from the north."""
    latitude = np.linspace(math.pi / 2, -math.pi / 2, sides // 2 + 1)[1:-1, None]
    longitude = np.linspace(0, 2 * math.pi, sides, endpoint=False)
    x, y = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)
    rings = np.stack([x, y, np.broadcast_to(np.sin(latitude), x.shape)], axis=-1).reshape(-1, 3)
    points = np.concatenate([[[0, 0, 1], [0, 0, -1]], rings])
    ring = 2 + np.arange(len(rings)).reshape(-1, sides)
    beside = np.roll(ring, -1, axis=1)
    north = np.stack([np.zeros(sides, np.int64), ring[0], beside[0]], axis=-1)
    south = np.stack([np.ones(sides, np.int64), beside[-1], ring[-1]], axis=-1)
    upper = np.stack([ring[:-1], ring[1:], beside[:-1]], axis=-1).reshape(-1, 3)
    lower = np.stack([beside[:-1], ring[1:], beside[1:]], axis=-1).reshape(-1, 3)
    return points, np.concatenate([north, upper, lower, south])


def _meshes(ir: SceneIR, *, phong: bool) -> list[tuple[int, int]]:
    """The primitives that are meshes, with their rows in `meshes`."""
    kinds, rows = ir["primitives"]["kind"], ir["primitives"]["row"]
    found = np.flatnonzero(np.isin(kinds, (PrimitiveKind.POLYGONS, PrimitiveKind.TERRAIN))).tolist()
    return [(i, int(rows[i])) for i in found if bool(ir["meshes"]["phong"][rows[i]]) == phong]


def _facets(ir: SceneIR, row: int) -> slice:
    first = int(ir["meshes"]["first_facet"][row])
    return slice(first, first + int(ir["meshes"]["facet_count"][row]))


def _joined(parts: list[Mesh]) -> Mesh:
    firsts = np.cumsum([0, *(len(part.points) for part in parts)])
    triangles = [part.triangles + first for part, first in zip(parts, firsts, strict=False)]
    normals = [part.normals for part in parts if part.normals is not None]
    return Mesh(
        np.concatenate([part.points for part in parts]),
        np.concatenate(triangles),
        np.concatenate([part.primitives for part in parts]),
        np.concatenate(normals) if normals else None,
    )
