"""The finite things of a scene as triangles: those of its solids, and of its visible lights."""

from __future__ import annotations

import numpy as np

from m3d_render.geometry import Triangles, shape_of
from m3d_render.geometry.shape import Points
from m3dc.ir import PrimitiveKind, SceneIR


def bodies(ir: SceneIR) -> tuple[Triangles, Triangles]:
    """Triangles that are flat, and those with normals over which light falls smoothly: spheres, and polygons and
    terrain that are PHONG."""
    kinds, table_rows = ir["primitives"]["kind"], ir["primitives"]["row"].astype(np.int64)
    flat: list[Triangles] = []
    smooth: list[Triangles] = []
    for kind in PrimitiveKind:
        primitives = np.flatnonzero(kinds == kind)
        if len(primitives):
            for part in shape_of(kind).triangles(ir, primitives, table_rows[primitives]):
                (flat if part.normals is None else smooth).append(part)
    return _joined(flat), _joined(smooth)


def primitive_colors(ir: SceneIR) -> Points:
    """The colour (n, 3), 0..1, of every primitive: COLOR of its solid's SURFACE, or of its light. Textures are left
    out."""
    solid, light = ir["primitives"]["solid"], ir["primitives"]["light"]
    colors = np.zeros((len(solid), 3))
    colors[solid >= 0] = ir["surfaces"]["color"][solid[solid >= 0]]
    colors[solid < 0] = ir["lights"]["color"][light[solid < 0]]
    return np.clip(colors, 0, 1)


def _joined(parts: list[Triangles]) -> Triangles:
    if not parts:
        return Triangles(np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros(0, np.int64))
    firsts = np.cumsum([0, *(len(part.points) for part in parts)])
    normals = [part.normals for part in parts if part.normals is not None]
    return Triangles(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.corners + first for part, first in zip(parts, firsts, strict=False)]),
        np.concatenate([part.primitives for part in parts]),
        np.concatenate(normals) if normals else None,
    )
