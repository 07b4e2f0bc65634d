"""What figures ask of a kind of primitive."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3d_render.geometry.view_plane import ViewPlane
from m3dc.ir import SceneIR

Points = NDArray[np.float64]
Rows = NDArray[np.int64]


Lines = tuple[Points, Points]
"""Where line segments start and end, (n, 3) each."""
Roundness = Callable[[Points, float], int]
"""How many segments a circle about a centre (3) with a radius is made of."""


class Triangles(NamedTuple):
    """`points` (n, 3); `corners` (m, 3), rows of points; `primitives` (m), the row of the IR that each is part of.

    `normals` (n, 3) are unit vectors where light is to fall smoothly over the triangles' edges, else None.
    """

    points: Points
    corners: Rows
    primitives: Rows
    normals: Points | None = None


class Section(NamedTuple):
    """What a vertical plane cuts out of a primitive: segments (n, 2, 2) of (distance, height), m.

    `filled` says that they close around what is within. `level` is the height of an endless level plane, which has no
    segments.
    """

    segments: Points
    filled: bool = False
    level: float | None = None


class Shape(NamedTuple):
    """What a kind of primitive is for figures, as functions of an IR and rows of the kind's table."""

    triangles: Callable[[SceneIR, Rows, Rows], tuple[Triangles, ...]]
    """The triangles of all primitives of the kind: given their rows in `primitives`, and in the kind's table. Empty for
    what is endless."""

    outline: Callable[[SceneIR, int, Roundness], Lines]
    """The edges of one primitive, given its row in the kind's table; of what is endless, a grid in it."""

    section: Callable[[SceneIR, int, ViewPlane], Section]
    """What a plane cuts out of one primitive, given its row in the kind's table."""

    is_curved: bool = False
    """Whether of the edges only the segments' ends lie on the surface."""


def no_segments() -> Points:
    """An array (0, 2, 2)."""
    return np.zeros((0, 2, 2))


def closed(corners: Points) -> Lines:
    """The edges from each of some corners (n, 3) to the next, and from the last to the first."""
    return corners, np.roll(corners, -1, axis=0)
