"""What a vertical plane through the eye cuts out of a scene's solids: the things in a figure of rays."""

from __future__ import annotations

import math
from dataclasses import dataclass

from m3d_render.geometry import ViewPlane, shape_of
from m3d_render.geometry.shape import Points
from m3dc.ir import PrimitiveKind, SceneIR


@dataclass(frozen=True, slots=True)
class Cut:
    """A primitive of solid `solid` (a row of the IR) in section, as geometry.Section: what lies before the eye."""

    solid: int
    kind: PrimitiveKind
    segments: Points
    filled: bool = False
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
        cut = shape_of(kind).section(ir, row, plane)
        before = cut.segments[cut.segments[:, :, 0].max(axis=1, initial=-math.inf) > 0]
        if len(before) or cut.level is not None:
            found.append(Cut(solid, kind, before, cut.filled, cut.level))
    return found
