"""What a wireframe shows beside the scene's things, on request: the view's frustum, lights, and the axes."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from m3d_render.sight import half_height, things_distance
from m3d_render.wireframe.edges import Edges
from m3dc.ir import LightKind, SceneIR, View
from m3dc.meaning.transform import unit

Points = NDArray[np.float64]

MARKS = ("frustum", "lights", "axes")

SMALLEST = 1e-100  # scene units that marks are made for, at least

_YELLOW = np.array([1.0, 0.85, 0.2])
_AXIS_COLORS = np.array([[1.0, 0.3, 0.3], [0.3, 0.9, 0.3], [0.45, 0.6, 1.0]])
_LETTERS = {  # strokes from (right, up) to (right, up), in a square of 1
    "X": [((0, 0), (1, 1)), ((0, 1), (1, 0))],
    "Y": [((0, 1), (0.5, 0.5)), ((1, 1), (0.5, 0.5)), ((0.5, 0.5), (0.5, 0))],
    "Z": [((0, 1), (1, 1)), ((1, 1), (0, 0)), ((0, 0), (1, 0))],
}


def marks(ir: SceneIR, seen_by: View, names: frozenset[str]) -> Iterator[Edges]:
    """The lines of the marks in `names`, for a picture of a camera, toward which letters and arrow heads turn.

    The frustum reaches as far as what is looked at. A light from infinitely far away is an arrow in the direction it
    shines to, through the middle of the things; a point light is a star, with an arrow if it is a spotlight.
    """
    size = _size(ir)
    if "frustum" in names:
        yield _edges(_frustum(ir), _YELLOW, "frustum")
    if "lights" in names:
        lights = ir["lights"]
        for row in range(len(lights["kind"])):
            yield _edges(_light(ir, seen_by, row, size), lights["color"][row], f"light-{row}")
    if "axes" in names:
        for axis, letter in enumerate("XYZ"):
            yield _edges(_axis(seen_by, axis, letter, size), _AXIS_COLORS[axis], "axes")


def frustum_points(ir: SceneIR) -> Points:
    """The ends of the frustum's lines (n, 3)."""
    return np.array([point for line in _frustum(ir) for point in line])


def _edges(lines: list[tuple[Points, Points]], color: Points, name: str) -> Edges:
    starts, ends = zip(*lines, strict=True)
    return Edges(np.array(starts, float), np.array(ends, float), np.asarray(color, float), name)


def _size(ir: SceneIR) -> float:
    """A round number of scene units, about a third of the things' greatest extent, or of the distance to them."""
    extent = ir.scene.extent
    reach = things_distance(ir) if extent is None else float(np.ptp([extent.minimum, extent.maximum], axis=0).max())
    third = max(reach or 3.0, SMALLEST) / 3
    decade = 10.0 ** math.floor(math.log10(third))
    return max((step * decade for step in (1, 2, 5) if step * decade <= third), default=third)


def _frustum(ir: SceneIR) -> list[tuple[Points, Points]]:
    """Four edges, the far end's rectangle, and a triangle on its upper side, which tells up."""
    view = ir.scene.view
    eye, right, up = np.array(view.eye), np.array(view.right), np.array(view.up)
    upper = half_height(view) * up
    reach = max(things_distance(ir), 1e-6) / view.distance
    middle = eye + reach * view.distance * np.array(view.normal)
    corners = [middle + reach * (x * right + y * upper) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    tip = middle + reach * 1.4 * upper
    sides = [(corners[i], corners[(i + 1) % 4]) for i in range(4)]
    return [*((eye, corner) for corner in corners), *sides, (corners[2], tip), (tip, corners[3])]


def _light(ir: SceneIR, seen_by: View, row: int, size: float) -> list[tuple[Points, Points]]:
    lights = ir["lights"]
    direction = lights["direction"][row]
    if lights["kind"][row] == LightKind.INFINITE:
        extent = ir.scene.extent
        middle = np.array(ir.scene.view.target) if extent is None else np.mean([extent.minimum, extent.maximum], axis=0)
        return _arrow(middle - direction * size, middle - direction * 0.3 * size, seen_by, 0.15 * size)
    position = lights["position"][row]
    ray = 0.06 * size
    ways = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]], float)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    star = [(position - ray * way, position + ray * way) for way in ways]
    if lights["angle"][row] < 180:
        star += _arrow(position, position + 0.4 * size * direction, seen_by, 0.08 * size)
    return star


def _arrow(start: Points, end: Points, seen_by: View, head: float) -> list[tuple[Points, Points]]:
    """A line with a head that is open toward the camera."""
    way = unit(end - start)
    aside = np.cross(way, seen_by.normal)
    length = float(np.linalg.norm(aside))
    aside = np.array(seen_by.right) if length < 1e-6 else aside / length
    barbs = [end - head * (way + sign * 0.5 * aside) for sign in (-1, 1)]
    return [(start, end), *((end, barb) for barb in barbs)]


def _axis(seen_by: View, axis: int, letter: str, size: float) -> list[tuple[Points, Points]]:
    """From the origin, with the axis's letter beyond its end, upright in the picture."""
    end = size * np.eye(3)[axis]
    right, up = np.array(seen_by.right), np.array(seen_by.up)
    width = 0.08 * size
    corner = 1.12 * end - 0.5 * width * (right + up)
    strokes = [tuple(corner + width * (x * right + y * up) for x, y in stroke) for stroke in _LETTERS[letter]]
    return [(np.zeros(3), end), *((start, stop) for start, stop in strokes)]
