"""The vertical plane in which a figure of rays lies: through the eye, along the direction of view."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import SceneIR


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
