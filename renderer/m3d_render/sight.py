"""What a scene's camera looks at: over which angles, and how far away."""

from __future__ import annotations

import math

import numpy as np

from m3dc.ir import SceneIR, View

_STEEPEST = math.radians(89)


# An ASPECT has no upper limit; beyond this no picture differs any more.
_TALLEST = 1e30


def half_height(view: View, columns: int | None = None, rows: int | None = None) -> float:
    """Half the height of a picture of so many pixels (the scene's) on the view plane, where half its width is 1."""
    return min((rows or view.height) / (columns or view.width) * view.aspect, _TALLEST)


def view_angles(ir: SceneIR) -> tuple[float, float]:
    """Angles above the horizontal, rad, of the lowest and the highest pixel of the picture's middle column; the nadir
    and the zenith, where they are in the picture, count as 89 degrees."""
    view = ir.scene.view
    ahead, up = view.distance * np.array(view.normal), half_height(view) * np.array(view.up)
    ends = (ahead - up, ahead + up)
    low, high = sorted(math.atan2(z, math.hypot(x, y)) for x, y, z in ends)
    if float(ends[0][:2] @ ends[1][:2]) <= 0:  # they are on different sides of the vertical
        low, high = (-_STEEPEST, high) if ahead[2] < 0 else (low, _STEEPEST)
    return max(low, -_STEEPEST), min(high, _STEEPEST)


def things_distance(ir: SceneIR) -> float:
    """Horizontal distance, m, of what is looked at: VIEW's TO; if all things stand beyond it, so that it gives no
    more than a direction, the middle of the box about them."""
    view = ir.scene.view
    eye = np.array(view.eye[:2])
    target = float(np.linalg.norm(np.array(view.target[:2]) - eye))
    extent = ir.scene.extent
    if extent is None:
        return target
    low, high = np.array(extent.minimum[:2]), np.array(extent.maximum[:2])
    nearest = float(np.linalg.norm(np.clip(eye, low, high) - eye))
    return target if target >= nearest else float(np.linalg.norm((low + high) / 2 - eye))
