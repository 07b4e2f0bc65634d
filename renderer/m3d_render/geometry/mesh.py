"""Polygons and terrain: vertices and facets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from m3d_render.geometry.facets import cut
from m3d_render.geometry.shape import Lines, Roundness, Rows, Section, Shape, Triangles
from m3d_render.geometry.view_plane import ViewPlane
from m3dc.ir import SceneIR


def facets(ir: SceneIR, row: int) -> slice:
    """The rows of a mesh in `facets`."""
    first = int(ir["meshes"]["first_facet"][row])
    return slice(first, first + int(ir["meshes"]["facet_count"][row]))


def _triangles(ir: SceneIR, primitives: Rows, rows: Rows) -> tuple[Triangles, ...]:
    return tuple(
        _smooth(ir, primitive, row) if ir["meshes"]["phong"][row] else _flat(ir, primitive, row)
        for primitive, row in zip(primitives.tolist(), rows.tolist(), strict=True)
    )


def _flat(ir: SceneIR, primitive: int, row: int) -> Triangles:
    first, count = (int(ir["meshes"][column][row]) for column in ("first_vertex", "vertex_count"))
    corners = _corners(ir, row).astype(np.int64) - first
    points = ir["vertices"]["position"][first : first + count]
    return Triangles(points, corners, np.full(len(corners), primitive))


def _smooth(ir: SceneIR, primitive: int, row: int) -> Triangles:
    """With the normals of the scene: each corner of each facet is a point of its own."""
    points = ir["vertices"]["position"][_corners(ir, row)].reshape(-1, 3)
    normals = ir["normals"]["direction"][ir["facets"]["normal"][facets(ir, row)]].reshape(-1, 3)
    corners = np.arange(len(points)).reshape(-1, 3)
    return Triangles(points, corners, np.full(len(corners), primitive), normals)


def _corners(ir: SceneIR, row: int) -> NDArray[np.int32]:
    return ir["facets"]["vertex"][facets(ir, row)]


def _outline(ir: SceneIR, row: int, _roundness: Roundness) -> Lines:
    """Every edge of the facets once."""
    corners = _corners(ir, row)
    pairs = np.concatenate([corners[:, (0, 1)], corners[:, (1, 2)], corners[:, (2, 0)]])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    positions = ir["vertices"]["position"]
    return positions[pairs[:, 0]], positions[pairs[:, 1]]


def _section(ir: SceneIR, row: int, plane: ViewPlane) -> Section:
    return Section(cut(ir["vertices"]["position"][_corners(ir, row)], plane))


MESH = Shape(_triangles, _outline, _section)
