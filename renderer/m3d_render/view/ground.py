"""The endless planes of a scene as patches that reach as far as its things, with grid lines in round steps."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3d_render.geometry import Triangles
from m3dc.ir import PrimitiveKind, SceneIR

Points = NDArray[np.float64]

_MARGIN = 0.1  # of the longer side
_LINES = 20  # about so many along the longer side


class Ground(NamedTuple):
    """`patches`, two triangles a plane, and their grid lines, `lines` (n, 2, 3) `step` scene units apart."""

    patches: Triangles
    lines: Points
    step: float


def ground(ir: SceneIR) -> Ground:
    """The planes of a scene, each as the rectangle in it that lies under all finite things and the eye.

    Its sides are along the scene's axes if it is level, else level and upward; grid lines are at whole multiples of the
    step from there where the scene's origin falls on the plane.
    """
    places = places_of_interest(ir)
    step = round_down(float(np.ptp(places, axis=0).max()) * (1 + 2 * _MARGIN) / _LINES)
    kinds, rows = ir["primitives"]["kind"], ir["primitives"]["row"]
    primitives = np.flatnonzero(kinds == PrimitiveKind.PLANE)
    made = [_patch(ir, int(row), places, step) for row in rows[primitives]]
    corners = [patch for patch, _ in made]
    lines = [grid for _, grid in made]
    triangles = 4 * np.arange(len(made))[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]])
    mesh = Triangles(
        np.concatenate([np.zeros((0, 3)), *corners]),
        triangles.reshape(-1, 3),
        np.repeat(primitives.astype(np.int64), 2),
    )
    return Ground(mesh, np.concatenate([np.zeros((0, 2, 3)), *lines]), step)


def places_of_interest(ir: SceneIR) -> Points:
    """Points (n, 3) that a view of the whole scene holds: the eye, and the box about the finite things; without any,
    what the eye looks at."""
    view, extent = ir.scene.view, ir.scene.extent
    if extent is None:
        return np.array([view.eye, view.target])
    sides = np.array([extent.minimum, extent.maximum])
    corners = [[sides[i, 0], sides[j, 1], sides[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    return np.array([view.eye, *corners])


def round_down(length: float) -> float:
    """The largest of 1, 2, 5, 10, ... and their tenths that is not longer; 1 where there is no length."""
    if not (math.isfinite(length) and length > 0):
        return 1.0
    decade = 10.0 ** math.floor(math.log10(length))
    return max(step * decade for step in (1, 2, 5) if step * decade <= length * (1 + 1e-9))


def _patch(ir: SceneIR, row: int, places: Points, step: float) -> tuple[Points, Points]:
    """The four corners of a plane's patch, and its grid lines (n, 2, 3)."""
    normal = ir["planes"]["normal"][row] / np.linalg.norm(ir["planes"]["normal"][row])
    origin = normal * (ir["planes"]["point"][row] @ normal)
    level = math.hypot(*normal[:2]) < 1e-9
    across = np.array([1.0, 0.0, 0.0]) if level else np.array([-normal[1], normal[0], 0.0])
    across /= np.linalg.norm(across)
    along = np.array([0.0, 1.0, 0.0]) if level else np.cross(normal, across)
    axes = np.stack([across, along])
    flat = (places - origin) @ axes.T
    margin = max(_MARGIN * float(np.ptp(flat, axis=0).max()), step)
    low = np.floor((flat.min(axis=0) - margin) / step).astype(np.int64)
    high = np.ceil((flat.max(axis=0) + margin) / step).astype(np.int64)
    corners = step * np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    grid: list[Points] = []
    for side in (0, 1):
        at = step * np.arange(int(low[side]), int(high[side]) + 1)
        ends = np.empty((len(at), 2, 2))
        ends[:, :, side] = at[:, None]
        ends[:, :, 1 - side] = step * np.array([low[1 - side], high[1 - side]])
        grid.append(ends)
    return origin + corners @ axes, origin + np.concatenate(grid) @ axes
