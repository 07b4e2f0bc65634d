"""Wireframe pictures: the edges of everything in a scene, seen by its camera. Thesis 7.2, command -W.

Nothing is traced: edges are projected with straight rays and drawn, nearer ones over farther ones.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR, Table

Points = NDArray[np.float64]

CIRCLE_STEPS = 48
PLANE_LINES = 20
NEAREST = 1e-6  # of the view distance: what is nearer to the eye is cut off
DARKEST = 0.35  # of 1: black things are drawn in grey, to be seen on black

_GREY = np.full(3, 0.6)


class Edges(NamedTuple):
    """Line segments: `starts` and `ends` (n, 3) in the scene, and the `color` (3) that all are drawn in."""

    starts: Points
    ends: Points
    color: Points


def edges(ir: SceneIR) -> Iterator[Edges]:
    """The edges of every primitive of solids and lights, in the colour of its object."""
    primitives = ir["primitives"]
    for kind, row, solid, light in zip(
        *(primitives[column].tolist() for column in ("kind", "row", "solid", "light")), strict=True
    ):
        color = ir["surfaces"]["color"][solid] if solid >= 0 else ir["lights"]["color"][light]
        starts, ends = _outline(ir, PrimitiveKind(kind), row)
        yield Edges(starts, ends, _visible(np.asarray(color, float)))


def draw(ir: SceneIR, width: int | None = None, height: int | None = None) -> NDArray[np.float32]:
    """The wireframe picture of a scene: rows x columns x 3, 0..1, on black."""
    view = ir.scene.view
    columns, rows = width or view.width, height or view.height
    picture = np.zeros((rows, columns, 3), np.float32)
    depth = np.full((rows, columns), np.inf)
    for group in edges(ir):
        starts, ends = _before_the_eye(_to_camera(ir, group.starts), _to_camera(ir, group.ends))
        a, b = (_to_pixels(ir, points, columns, rows) for points in (starts, ends))
        _draw_lines(picture, depth, a, b, group.color)
    return picture


def _visible(color: Points) -> Points:
    brightest = float(color.max(initial=0.0))
    if brightest >= DARKEST:
        return color
    return color * (DARKEST / brightest) if brightest > 0 else _GREY


# --- outlines -----------------------------------------------------------------------------------------------------


def _outline(ir: SceneIR, kind: PrimitiveKind, row: int) -> tuple[Points, Points]:
    table = ir[PRIMITIVE_TABLE[kind]]
    if kind is PrimitiveKind.SPHERE:
        return _sphere(table, row)
    if kind in (PrimitiveKind.POLYGONS, PrimitiveKind.TERRAIN):
        return _mesh(ir, row)
    point, u, v = (table[column][row] for column in ("point", "u", "v"))
    if kind is PrimitiveKind.PLANE:
        return _grid(ir, point, u, v)
    corners = [point + v, point, point + u]
    if kind is PrimitiveKind.RECTANGLE:
        corners.append(point + u + v)
    return _closed(np.array(corners))


def _closed(corners: Points) -> tuple[Points, Points]:
    return corners, np.roll(corners, -1, axis=0)


def _sphere(table: Table, row: int) -> tuple[Points, Points]:
    """The equator, two parallels and four meridians."""
    centre, radius = table["center"][row], float(table["radius"][row])
    pole, x = table["pole"][row], table["equator"][row]
    y = np.cross(pole, x)
    angle = np.linspace(0, 2 * math.pi, CIRCLE_STEPS, endpoint=False)[:, None]
    circles: list[Points] = []
    for latitude in (-math.pi / 4, 0.0, math.pi / 4):
        around = np.cos(angle) * x + np.sin(angle) * y
        circles.append(centre + radius * (math.cos(latitude) * around + math.sin(latitude) * pole))
    for longitude in np.linspace(0, math.pi, 4, endpoint=False):
        side = math.cos(longitude) * x + math.sin(longitude) * y
        circles.append(centre + radius * (np.cos(angle) * side + np.sin(angle) * pole))
    starts, ends = zip(*(_closed(circle) for circle in circles), strict=True)
    return np.concatenate(starts), np.concatenate(ends)


def _mesh(ir: SceneIR, row: int) -> tuple[Points, Points]:
    """Every edge of the facets once."""
    mesh = {name: int(column[row]) for name, column in ir["meshes"].items()}
    facets = ir["facets"]["vertex"][mesh["first_facet"] : mesh["first_facet"] + mesh["facet_count"]]
    pairs = np.concatenate([facets[:, (0, 1)], facets[:, (1, 2)], facets[:, (2, 0)]])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    positions = ir["vertices"]["position"]
    return positions[pairs[:, 0]], positions[pairs[:, 1]]


def _grid(ir: SceneIR, point: Points, u: Points, v: Points) -> tuple[Points, Points]:
    """A square of grid lines in a plane, below whatever is in the scene and around the eye's target."""
    normal = np.cross(u, v)
    normal /= np.linalg.norm(normal)
    u = u / np.linalg.norm(u)
    v = np.cross(normal, u)
    scene = ir.scene
    near = np.array([scene.view.target])
    if scene.extent is not None:
        near = np.array([scene.extent.minimum, scene.extent.maximum])
    middle, reach = near.mean(axis=0), float(np.ptp(near, axis=0).max()) or 10.0
    middle = middle - normal * ((middle - point) @ normal)
    at = np.linspace(-reach, reach, PLANE_LINES + 1)[:, None]
    across, along = middle + at * u, middle + at * v
    starts = np.concatenate([across - reach * v, along - reach * u])
    ends = np.concatenate([across + reach * v, along + reach * u])
    return _split(starts, ends)


def _split(starts: Points, ends: Points) -> tuple[Points, Points]:
    """Long lines in pieces, so that the part before the eye is drawn where the rest is behind it."""
    at = np.linspace(0, 1, PLANE_LINES + 1)[:, None, None]
    points = starts + at * (ends - starts)
    return points[:-1].reshape(-1, 3), points[1:].reshape(-1, 3)


# --- projection ---------------------------------------------------------------------------------------------------


def _to_camera(ir: SceneIR, points: Points) -> Points:
    """Points as (right, up, ahead) of the eye."""
    view = ir.scene.view
    return (points - np.array(view.eye)) @ np.array([view.right, view.up, view.normal]).T


def _before_the_eye(starts: Points, ends: Points) -> tuple[Points, Points]:
    """The parts of lines that lie before the eye."""
    kept = np.maximum(starts[:, 2], ends[:, 2]) > NEAREST
    starts, ends = starts[kept], ends[kept]
    for a, b in ((starts, ends), (ends, starts)):
        behind = a[:, 2] < NEAREST
        share = ((NEAREST - a[behind, 2]) / (b[behind, 2] - a[behind, 2]))[:, None]
        a[behind] = a[behind] + share * (b[behind] - a[behind])
    return starts, ends


def _to_pixels(ir: SceneIR, points: Points, columns: int, rows: int) -> Points:
    """Column, row and distance ahead of points before the eye; thesis 3.2."""
    view = ir.scene.view
    half_height = rows / columns * view.aspect
    x = view.distance * points[:, 0] / points[:, 2]
    y = view.distance * points[:, 1] / points[:, 2]
    column = (x + 1) / 2 * (columns - 1)
    row = (1 - y / half_height) / 2 * (rows - 1)
    return np.stack([column, row, points[:, 2]], axis=1)


# --- drawing ------------------------------------------------------------------------------------------------------


def _draw_lines(picture: NDArray[np.float32], depth: Points, a: Points, b: Points, color: Points) -> None:
    """Lines between pixel positions, a pixel wide, where nothing nearer has been drawn."""
    rows, columns = depth.shape
    a, b = _within(a, b, columns, rows)
    if not len(a):
        return
    steps = np.ceil(np.abs(b - a)[:, :2].max(axis=1)).astype(np.int64) + 1
    line = np.repeat(np.arange(len(a)), steps)
    step = np.arange(len(line)) - np.repeat(np.cumsum(steps) - steps, steps)
    share = (step / np.maximum(steps[line] - 1, 1))[:, None]
    points = a[line] + share * (b[line] - a[line])
    x, y = np.rint(points[:, 0]).astype(np.int64), np.rint(points[:, 1]).astype(np.int64)
    inside = (x >= 0) & (x < columns) & (y >= 0) & (y < rows)
    x, y, ahead = x[inside], y[inside], points[inside, 2]
    nearer = ahead < depth[y, x]
    x, y, ahead = x[nearer], y[nearer], ahead[nearer]
    farthest_first = np.argsort(-ahead, kind="stable")
    x, y, ahead = x[farthest_first], y[farthest_first], ahead[farthest_first]
    depth[y, x] = ahead
    picture[y, x] = color


def _within(a: Points, b: Points, columns: int, rows: int) -> tuple[Points, Points]:
    """Lines cut to the picture (Liang and Barsky 1984), those outside left out."""
    delta = b - a
    low, high = np.zeros(len(a)), np.ones(len(a))
    for axis, size in ((0, columns), (1, rows)):
        for sign, limit in ((-1.0, 0.5), (1.0, size - 0.5)):
            p, q = sign * delta[:, axis], limit - sign * a[:, axis]
            with np.errstate(divide="ignore", invalid="ignore"):
                t = q / p
            low = np.where(p < 0, np.maximum(low, t), low)
            high = np.where(p > 0, np.minimum(high, t), high)
            low = np.where((p == 0) & (q < 0), 2.0, low)
    kept = low <= high
    a, delta = a[kept], delta[kept]
    return a + low[kept, None] * delta, a + high[kept, None] * delta
