"""Endless planes, triangles and rectangles: a point P and the vectors U and V."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from m3d_render.geometry.facets import cut
from m3d_render.geometry.shape import Lines, Points, Roundness, Rows, Section, Shape, Triangles, closed, no_segments
from m3d_render.geometry.view_plane import ViewPlane
from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR
from m3dc.meaning.transform import unit

GRID_LINES = 20

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


def _outline(kind: PrimitiveKind, ir: SceneIR, row: int, _roundness: Roundness) -> Lines:
    (corners,) = _corners(ir, kind, np.array([row]))
    return closed(corners)


def _section(kind: PrimitiveKind, ir: SceneIR, row: int, plane: ViewPlane) -> Section:
    (corners,) = _corners(ir, kind, np.array([row]))
    return Section(cut(corners[np.array(_HALVES[kind])], plane))


def _no_triangles(ir: SceneIR, primitives: Rows, rows: Rows) -> tuple[Triangles, ...]:
    return ()


def _grid(ir: SceneIR, row: int, _roundness: Roundness) -> Lines:
    """A square of grid lines in a plane, below whatever is in the scene and around the eye's target."""
    point, u, v = (ir["planes"][column][row] for column in ("point", "u", "v"))
    u, v = unit(u), unit(v)
    normal = unit(np.cross(u, v))
    v = np.cross(normal, u)
    scene = ir.scene
    near = np.array([scene.view.target])
    if scene.extent is not None:
        near = np.array([scene.extent.minimum, scene.extent.maximum])
    middle, reach = near.mean(axis=0), float(np.ptp(near, axis=0).max()) or 10.0
    middle = middle - normal * ((middle - point) @ normal)
    at = np.linspace(-reach, reach, GRID_LINES + 1)[:, None]
    across, along = middle + at * u, middle + at * v
    starts = np.concatenate([across - reach * v, along - reach * u])
    ends = np.concatenate([across + reach * v, along + reach * u])
    return _split(starts, ends)


def _split(starts: Points, ends: Points) -> Lines:
    """Long lines in pieces, so that the part before the eye is drawn where the rest is behind it."""
    at = np.linspace(0, 1, GRID_LINES + 1)[:, None, None]
    points = starts + at * (ends - starts)
    return points[:-1].reshape(-1, 3), points[1:].reshape(-1, 3)


def _level(ir: SceneIR, row: int, plane: ViewPlane) -> Section:
    normal = ir["planes"]["normal"][row]
    level = math.hypot(*normal[:2]) <= 1e-9 * abs(normal[2])
    return Section(no_segments(), level=float(ir["planes"]["point"][row][2]) if level else None)


PLANE = Shape(_no_triangles, _grid, _level)
TRIANGLE, RECTANGLE = (
    Shape(partial(_triangles, kind), partial(_outline, kind), partial(_section, kind))
    for kind in (PrimitiveKind.TRIANGLE, PrimitiveKind.RECTANGLE)
)
