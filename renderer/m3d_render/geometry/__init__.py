"""What each kind of primitive is for figures: its outline, its triangles, and what a vertical plane cuts out of it.

One module a table of the IR: `sphere`, `planar` (planes, triangles and rectangles) and `mesh`. All of it works on the
plain arrays of an IR, in the scene's coordinates; nothing here draws.
"""

from __future__ import annotations

from typing import assert_never

from m3d_render.geometry import mesh, planar, sphere
from m3d_render.geometry.shape import Section, Shape, Triangles
from m3d_render.geometry.view_plane import ViewPlane
from m3dc.ir import PrimitiveKind

__all__ = ["Section", "Shape", "Triangles", "ViewPlane", "shape_of"]


def shape_of(kind: PrimitiveKind) -> Shape:
    """What a kind of primitive is for figures."""
    match kind:
        case PrimitiveKind.SPHERE:
            return sphere.SPHERE
        case PrimitiveKind.PLANE:
            return planar.PLANE
        case PrimitiveKind.TRIANGLE:
            return planar.TRIANGLE
        case PrimitiveKind.RECTANGLE:
            return planar.RECTANGLE
        case PrimitiveKind.POLYGONS | PrimitiveKind.TERRAIN:
            return mesh.MESH
        case _:
            assert_never(kind)
