"""From where a scene is looked at: from its own camera, from above, or from the side."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3d_render.geometry import ViewPlane
from m3d_render.sight import things_distance, view_angles
from m3d_render.view.ground import places_of_interest, round_down
from m3dc.ir import SceneIR

Points = NDArray[np.float64]
From = Literal["camera", "above", "side"]

LEAST_VERTICAL, MOST_VERTICAL = 1e-3, 1e6

FROM: tuple[From, ...] = ("camera", "above", "side")

_MARGIN = 1.2
_FLAT = 1 / 12  # of the window's height: what is lower is stretched ...
_UPRIGHT = 2 / 3  # ... to so much


class Viewpoint(NamedTuple):
    """A camera at `position` that looks at `target`, with `up` upward, all (3), in a scene whose heights are stretched.

    In perspective `angle`, degrees, is what is seen from the picture's lower edge to its upper one; a parallel
    projection has `half_height` instead, in scene units.
    """

    position: Points
    target: Points
    up: Points
    angle: float | None = None
    half_height: float | None = None


def viewpoint(ir: SceneIR, place: From, ratio: float, vertical: float = 1.0) -> Viewpoint:
    """A viewpoint for a window `ratio` times as wide as it is high, with heights stretched `vertical` times.

    The scene's camera sees what is in its picture, and more to the sides or above and below if the window has another
    shape. From above and from the side the projection is parallel, and the direction of view is to the right.
    """
    stretch = np.array([1.0, 1.0, vertical])
    if place == "camera":
        return _camera(ir, ratio, stretch)
    plane = ViewPlane.of(ir)
    upward, back = np.array([0.0, 0.0, 1.0]), plane.normal
    if place == "above":
        upward, back = -plane.normal, upward
    points = places_of_interest(ir) * stretch
    aside, high = points @ plane.along, points @ upward
    half_height = max(float(np.ptp(high)), float(np.ptp(aside)) / ratio, 1e-9) / 2 * _MARGIN
    middle = (
        plane.along * (aside.min() + aside.max()) / 2
        + upward * (high.min() + high.max()) / 2
        + back * float((points @ back).mean())
    )
    away = float(np.ptp(points, axis=0).max()) + half_height
    return Viewpoint(middle + 2 * away * back, middle, upward, half_height=half_height)


def fitting_vertical(ir: SceneIR, place: From, ratio: float) -> float:
    """How many times heights must be stretched for something to be seen of them, a round number: from the side of what
    is far longer than high. From the camera it is 1, since it sees what the picture shows."""
    if place != "side":
        return 1.0
    points = places_of_interest(ir)
    window = float(np.ptp(points @ ViewPlane.of(ir).along)) / ratio
    # Things, the eye, and what the picture shows at the distance of the things.
    distance = things_distance(ir)
    seen = [ir.scene.view.eye[2] + distance * math.tan(angle) for angle in view_angles(ir)]
    high = float(np.ptp([*points[:, 2], *seen]))
    if not 0 < high < _FLAT * window:
        return 1.0
    return min(max(round_down(_UPRIGHT * window / high), 1.0), MOST_VERTICAL)


def _camera(ir: SceneIR, ratio: float, stretch: Points) -> Viewpoint:
    view = ir.scene.view
    ahead = np.array(view.normal) * view.distance
    right, up = np.array(view.right), np.array(view.up) * view.height / view.width * view.aspect
    # Heights that are stretched turn and widen what is seen, so its edges are asked.
    low, high, left, far_right = (_unit((ahead + edge) * stretch) for edge in (-up, up, -right, right))
    across, upright = _angle(left, far_right), _angle(low, high)
    angle = max(upright, 2 * math.atan(math.tan(across / 2) / ratio))
    middle = _unit(low + high)
    eye = np.array(view.eye) * stretch
    distance = max(things_distance(ir), math.dist(view.eye, view.target))
    return Viewpoint(eye, eye + middle * distance, _unit(np.array(view.up) * stretch), angle=math.degrees(angle))


def _unit(vector: Points) -> Points:
    return vector / np.linalg.norm(vector)


def _angle(a: Points, b: Points) -> float:
    """Between unit vectors, also where they are almost the same."""
    return 2 * math.atan2(float(np.linalg.norm(a - b)), float(np.linalg.norm(a + b)))
