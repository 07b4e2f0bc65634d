"""Endless planes, triangles and rectangles: a point P and the vectors U and V."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from m3d_render.geometry.facets import cut
from m3d_render.geometry.shape import Points, Rows, Section, Shape, Triangles, no_segments
from m3d_render.geometry.view_plane import ViewPlane
from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR

_HALVES = {PrimitiveKind.TRIANGLE: [[0, 1, 2]], PrimitiveKind.RECTANGLE: [[0, 1, 2], [0, 2, 3]]}
"""Triangles of the corners P + V, P, P + U and P + U + V."""


def _corners(ir: SceneIR, kind: PrimitiveKind, rows: Rows) -> Points:
    """The corners (n, 3 or 4, 3) of triangles or rectangles."""
    point, u, v = (ir[PRIMITIVE_TABLE[kind]][column][rows] for column in ("point", "u", "v"))
    return np.stack([point + v, point, point + u, point + u + v][: 2 + len(_HALVES[kind])], axis=1)


def _triangles(kind: PrimitiveKind, ir: SceneIR, primitives: Rows, rows: Rows) -> tuple[Triangles, ...]:
    corners, halves = _corners(ir, kind, rows), np.array(_HALVES[kind])
    firsts = corners.shape[1] * np.arange(len(rows))[:, None, None]
    return (Triangles(corners.reshape(-1, 3), (firsts + halves).reshape(-1, 3), np.repeat(primitives, len(halves))),)


def _section(kind: PrimitiveKind, ir: SceneIR, row: int, plane: ViewPlane) -> Section:
    (corners,) = _corners(ir, kind, np.array([row]))
    return Section(cut(corners[np.array(_HALVES[kind])], plane))


def _no_triangles(ir: SceneIR, primitives: Rows, rows: Rows) -> tuple[Triangles, ...]:
    return ()


def _level(ir: SceneIR, row: int, plane: ViewPlane) -> Section:
    normal = ir["planes"]["normal"][row]
    level = math.hypot(*normal[:2]) <= 1e-9 * abs(normal[2])
    return Section(no_segments(), level=float(ir["planes"]["point"][row][2]) if level else None)


PLANE = Shape(_no_triangles, _level)
TRIANGLE, RECTANGLE = (
    Shape(partial(_triangles, kind), partial(_section, kind))
    for kind in (PrimitiveKind.TRIANGLE, PrimitiveKind.RECTANGLE)
)
