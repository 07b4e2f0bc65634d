"""The edges of everything in a scene."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from m3d_render.geometry import shape_of
from m3d_render.geometry.shape import Points, Roundness
from m3dc.ir import PrimitiveKind, SceneIR

CIRCLE_STEPS = 48


def _alike(_centre: Points, _radius: float) -> int:
    return CIRCLE_STEPS


class Edges(NamedTuple):
    """Line segments: `starts` and `ends` (n, 3) in the scene, the `color` (3) that all are drawn in, and the `name` of
    what they belong to, such as solid-3, after its row in the IR. `curved` says that only the segments' ends lie on
    the surface they belong to."""

    starts: Points
    ends: Points
    color: Points
    name: str
    curved: bool = False


def edges(ir: SceneIR, roundness: Roundness = _alike) -> Iterator[Edges]:
    """The edges of every primitive of solids and lights, in the colour of its object. `roundness` gives the number of
    segments of a circle about a centre with a radius; it is CIRCLE_STEPS if not given."""
    primitives = ir["primitives"]
    for kind, row, solid, light in zip(
        *(primitives[column].tolist() for column in ("kind", "row", "solid", "light")), strict=True
    ):
        color = ir["surfaces"]["color"][solid] if solid >= 0 else ir["lights"]["color"][light]
        name = f"solid-{solid}" if solid >= 0 else f"light-{light}"
        shape = shape_of(PrimitiveKind(kind))
        starts, ends = shape.outline(ir, row, roundness)
        yield Edges(starts, ends, np.asarray(color, float), name, shape.is_curved)
