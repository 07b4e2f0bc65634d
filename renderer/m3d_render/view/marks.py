"""What stands for the scene's camera, lights and extent."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3d_render.sight import things_distance
from m3d_render.view.ground import places_of_interest
from m3dc.ir import LightKind, SceneIR

Points = NDArray[np.float64]

_RAY = 0.35  # of the things' size: how long the line is from where a light comes
_CIRCLE_STEPS = 32


class LightMark(NamedTuple):
    """A light: `source`, the point that it is drawn at; `lines` (n, 2, 3) along which it shines; its colour (3), 0..1;
    and its `name`, such as light 2, after its row in the IR."""

    source: Points
    lines: Points
    color: Points
    name: str


def frustum(ir: SceneIR) -> Points:
    """Lines (12, 2, 3): from the eye along the picture's corners to what is looked at, the rectangle seen there, and a
    triangle on its upper side."""
    view = ir.scene.view
    right, up = np.array(view.right), np.array(view.up) * view.height / view.width * view.aspect
    eye = np.array(view.eye)
    ahead = np.array(view.normal) * view.distance
    reach = _reach(ir) / view.distance
    corners = [eye + reach * (ahead + x * right + y * up) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    tip = eye + reach * (ahead + 1.3 * up)
    sides = [(corners[i], corners[(i + 1) % 4]) for i in range(4)]
    lines = [*((eye, corner) for corner in corners), *sides, (corners[2], tip), (tip, corners[3])]
    return np.array(lines)


def extent_box(ir: SceneIR) -> Points:
    """The edges (12, 2, 3) of the box about all finite things; none without any."""
    extent = ir.scene.extent
    return np.zeros((0, 2, 3)) if extent is None else box(np.array(extent.minimum), np.array(extent.maximum))


def box(low: Points, high: Points) -> Points:
    """The edges (12, 2, 3) of a box with its sides along the axes."""
    ends: list[list[list[float]]] = []
    for axis in range(3):
        for corner in range(4):
            start = low.copy()
            for bit, other in enumerate(side for side in range(3) if side != axis):
                start[other] = (high if corner >> bit & 1 else low)[other]
            stop = start.copy()
            stop[axis] = high[axis]
            ends.append([start.tolist(), stop.tolist()])
    return np.array(ends)


def light_marks(ir: SceneIR) -> list[LightMark]:
    """Every light. One from infinitely far away is a line that ends in the middle of the things; a point light is where
    it stands, with the edge of its cone if it shines into one."""
    lights = ir["lights"]
    return [_light(ir, row) for row in range(len(lights["kind"]))]


def _light(ir: SceneIR, row: int) -> LightMark:
    lights = ir["lights"]
    color = np.clip(lights["color"][row], 0, 1)
    direction = lights["direction"][row]
    length = _RAY * _size(ir)
    if lights["kind"][row] == LightKind.INFINITE:
        middle = _middle(ir)
        source = middle - direction * 2 * length
        name = "sun" if lights["sun"][row] else f"light {row}"
        return LightMark(source, np.array([[source, middle]]), color, name)
    source = lights["position"][row]
    angle = math.radians(float(lights["angle"][row]))
    lines = _cone(source, direction, angle, length) if angle < math.pi else np.zeros((0, 2, 3))
    return LightMark(source, lines, color, f"light {row}")


def _cone(tip: Points, axis: Points, half_angle: float, length: float) -> Points:
    """The axis of a cone, the circle at its end, and four lines on its side."""
    aside = np.asarray(np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())]), np.float64)
    aside /= np.linalg.norm(aside)
    upward = np.asarray(np.cross(axis, aside), np.float64)
    turn = np.linspace(0, 2 * math.pi, _CIRCLE_STEPS, endpoint=False)[:, None]
    around = np.cos(turn) * aside + np.sin(turn) * upward
    rim = tip + length * (math.cos(half_angle) * axis + math.sin(half_angle) * around)
    circle = np.stack([rim, np.roll(rim, -1, axis=0)], axis=1)
    edges = np.stack([np.broadcast_to(tip, (4, 3)), rim[:: _CIRCLE_STEPS // 4]], axis=1)
    middle = np.stack([tip, tip + length * axis])[None]
    return np.concatenate([middle, edges, circle])


def _reach(ir: SceneIR) -> float:
    """Along the direction of view, how far what is looked at is away."""
    view = ir.scene.view
    level = math.hypot(*view.normal[:2])
    straight = math.dist(view.eye, view.target)
    distance = things_distance(ir) / level if level > 0.1 else straight
    return distance or 1.0


def _size(ir: SceneIR) -> float:
    extent = ir.scene.extent
    points = places_of_interest(ir) if extent is None else np.array([extent.minimum, extent.maximum])
    return float(np.ptp(points, axis=0).max()) or 1.0


def _middle(ir: SceneIR) -> Points:
    extent = ir.scene.extent
    return np.array(ir.scene.view.target) if extent is None else np.mean([extent.minimum, extent.maximum], axis=0)
