"""The vertical plane in which a figure of rays lies: through the eye, along the direction of view."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import SceneIR

_STEEPEST = math.radians(89)


@dataclass(frozen=True, slots=True)
class ViewPlane:
    """A vertical plane through the eye. `eye` and `along`, a horizontal unit vector, are in the scene (x, y, z)."""

    eye: NDArray[np.float64]
    along: NDArray[np.float64]

    @staticmethod
    def of(ir: SceneIR, turn_deg: float = 0.0) -> ViewPlane:
        """The plane along the direction of view, turned so many degrees to the right. Where the view is straight up
        or down, it is along what is up in the picture."""
        view = ir.scene.view
        ahead = np.array(view.normal[:2])
        if math.hypot(*ahead) < 1e-9:
            ahead = np.array(view.up[:2])
        ahead = ahead / math.hypot(*ahead)
        turn = math.radians(turn_deg)
        cos, sin = math.cos(turn), math.sin(turn)
        along = np.array([ahead[0] * cos + ahead[1] * sin, ahead[1] * cos - ahead[0] * sin, 0.0])
        return ViewPlane(np.array(view.eye), along)

    @property
    def normal(self) -> NDArray[np.float64]:
        """The horizontal unit vector to the plane's right."""
        return np.array([self.along[1], -self.along[0], 0.0])

    def to_plane(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(horizontal distance from the eye, height) of points (..., 3) of the scene, moved into the plane."""
        return np.stack([(points - self.eye) @ self.along, points[..., 2]], axis=-1)


def view_angles(ir: SceneIR) -> tuple[float, float]:
    """Angles above the horizontal, rad, of the lowest and the highest pixel of the picture's middle column."""
    view = ir.scene.view
    half_height = view.height / view.width * view.aspect
    low, high = sorted(
        math.atan2(z, math.hypot(x, y))
        for x, y, z in (
            view.distance * np.array(view.normal) + sign * half_height * np.array(view.up) for sign in (-1, 1)
        )
    )
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
