"""What a vertical plane through the eye cuts out of a scene's solids: the things in a figure of rays."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from m3d_render.plot.view_plane import ViewPlane
from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR

Points = NDArray[np.float64]

_CIRCLE_STEPS = 96


@dataclass(frozen=True, slots=True)
class Cut:
    """A primitive of solid `solid` (a row of the IR) in section: line segments (n, 2, 2) of (distance, height), m.

    `level` is the height of an endless level plane, which has no segments.
    """

    solid: int
    kind: PrimitiveKind
    segments: Points
    level: float | None = None


def section(ir: SceneIR, plane: ViewPlane) -> list[Cut]:
    """All primitives of solids that the plane cuts before the eye, in the scene's order. Endless planes that are not
    level are left out."""
    found: list[Cut] = []
    primitives = ir["primitives"]
    for kind_number, row, solid in zip(*(primitives[c].tolist() for c in ("kind", "row", "solid")), strict=True):
        if solid < 0:
            continue
        kind = PrimitiveKind(kind_number)
        if kind is PrimitiveKind.PLANE:
            planes = ir["planes"]
            normal = planes["normal"][row]
            if math.hypot(*normal[:2]) <= 1e-9 * abs(normal[2]):
                found.append(Cut(solid, kind, np.zeros((0, 2, 2)), float(planes["point"][row][2])))
            continue
        segments = _circle(ir, plane, row) if kind is PrimitiveKind.SPHERE else _flat(ir, plane, kind, row)
        segments = segments[segments[:, :, 0].max(axis=1, initial=-math.inf) > 0]
        if len(segments):
            found.append(Cut(solid, kind, segments))
    return found


def _circle(ir: SceneIR, plane: ViewPlane, row: int) -> Points:
    center, radius = ir["spheres"]["center"][row], float(ir["spheres"]["radius"][row])
    aside = float((center - plane.eye) @ plane.normal)
    if abs(aside) >= radius:
        return np.zeros((0, 2, 2))
    angle = np.linspace(0, 2 * math.pi, _CIRCLE_STEPS + 1)
    points = math.sqrt(radius**2 - aside**2) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points += plane.to_plane(center)
    return np.stack([points[:-1], points[1:]], axis=1)


def _flat(ir: SceneIR, plane: ViewPlane, kind: PrimitiveKind, row: int) -> Points:
    """Triangles (n, 3, 3) cut to segments, thesis 4.3."""
    if kind in (PrimitiveKind.POLYGONS, PrimitiveKind.TERRAIN):
        mesh = {name: int(column[row]) for name, column in ir["meshes"].items()}
        facets = ir["facets"]["vertex"][mesh["first_facet"] : mesh["first_facet"] + mesh["facet_count"]]
        corners = ir["vertices"]["position"][facets]
        return _cut_triangles(corners, plane)
    table = ir[PRIMITIVE_TABLE[kind]]
    point, u, v = (table[column][row] for column in ("point", "u", "v"))
    if kind is PrimitiveKind.TRIANGLE:
        return _cut_triangles(np.array([[point, point + u, point + v]]), plane)
    halves = np.array([[point, point + u, point + v], [point + u, point + u + v, point + v]])
    return _cut_triangles(halves, plane)


def _cut_triangles(corners: Points, plane: ViewPlane) -> Points:
    side = (corners - plane.eye) @ plane.normal
    cut = (side.min(axis=1) <= 0) & (side.max(axis=1) >= 0)
    corners, side = corners[cut], side[cut]
    following, next_side = np.roll(corners, -1, axis=1), np.roll(side, -1, axis=1)
    # The edge of an open mesh may lie in the plane.
    lying = (side == 0) & (next_side == 0)
    edges = np.stack([corners[lying], following[lying]], axis=1)
    # A proper cut leaves through two edges; a corner in the plane counts to one side, so that they stay two.
    crossed = (side < 0) != (next_side < 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (side / (side - next_side))[..., None]
        points = corners + share * (following - corners)
    return plane.to_plane(np.concatenate([edges, points[crossed].reshape(-1, 2, 3)]))
