"""The camera of a wireframe: the scene's, or one above the scene; and its projection. Thesis 3.2."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from m3d_render.sight import half_height
from m3dc.ir import SceneIR, Triple, View

Points = NDArray[np.float64]

NEAREST = 1e-6  # scene units ahead of the eye: what is nearer is cut off
WIDE = 1000.0  # times the picture: what is farther beside it is cut off before it is projected
ABOVE_FOV = 5.0  # degrees: nearly a map
_MARGIN = 1.06


def above(ir: SceneIR, columns: int, rows: int, marked: Points) -> View:
    """A camera high above the middle of the scene's finite things and of `marked` points (n, 3), that looks down. If
    there is neither, it looks at the scene's eye and target.

    The direction of view is up or to the right in its picture, whichever shows all of it larger.
    """
    scene = ir.scene
    view = scene.view
    box = list(marked) if scene.extent is None else [*marked, scene.extent.minimum, scene.extent.maximum]
    box = box or [view.eye, view.target]
    low, high = np.min(box, axis=0), np.max(box, axis=0)
    ahead = np.array([*view.normal[:2], 0.0])
    if math.hypot(*ahead[:2]) < 1e-9:
        ahead = np.array([*view.up[:2], 0.0])
    # A map has its sides along the axes: of them the one that is nearest to the direction of view.
    along = int(np.abs(ahead[:2]).argmax())
    ahead = np.where(np.arange(3) == along, np.sign(ahead), 0.0)
    left = np.cross([0.0, 0.0, 1.0], ahead)
    spread = math.tan(math.radians(ABOVE_FOV / 2))
    half = np.maximum((high - low) / 2, 1e-9)

    def height(up: Points) -> float:
        upward = half[int(np.abs(up).argmax())]
        across = half[1 - int(np.abs(up[:2]).argmax())]
        # What is narrow and high, such as an observer above a plane, is seen with something around it.
        return float(max(across, upward * columns / rows, half[2])) * _MARGIN / spread

    up = min((ahead, left), key=height)
    middle = (low + high) / 2
    eye = np.array([middle[0], middle[1], high[2] + height(up)])
    normal = np.array([0.0, 0.0, -1.0])
    distance = 1 / spread
    return view._replace(
        eye=_triple(eye),
        target=_triple(middle),
        fov=ABOVE_FOV,
        tilt=0.0,
        aspect=1.0,
        normal=_triple(normal),
        general_up=_triple(up),
        right=_triple(np.cross(normal, up)),
        up=_triple(up),
        reference_point=_triple(eye + distance * normal),
        distance=distance,
    )


def _triple(vector: Points) -> Triple:
    return float(vector[0]), float(vector[1]), float(vector[2])


def to_camera(view: View, points: Points) -> Points:
    """Points as (right, up, ahead) of the eye."""
    return (points - np.array(view.eye)) @ np.array([view.right, view.up, view.normal]).T


def before_the_eye(view: View, starts: Points, ends: Points, columns: int, rows: int) -> tuple[Points, Points]:
    """The parts of lines, in the camera's coordinates, that lie before the eye and not far beside the picture: what is
    left is small enough in pixels to be cut to the picture exactly (`within`)."""
    right, up = WIDE / view.distance, WIDE / view.distance * half_height(view, columns, rows)
    planes = [(0.0, 0.0, 1.0, -NEAREST), (1.0, 0.0, right, 0.0), (-1.0, 0.0, right, 0.0)]
    planes += [(0.0, 1.0, up, 0.0), (0.0, -1.0, up, 0.0)]
    for *normal, offset in planes:
        a, b = starts @ normal + offset, ends @ normal + offset
        kept = np.maximum(a, b) > 0
        starts, ends, a, b = starts[kept], ends[kept], a[kept], b[kept]
        starts, ends = _cut(starts, ends, a, b), _cut(ends, starts, b, a)
    return starts, ends


def _cut(points: Points, others: Points, inside: Points, others_inside: Points) -> Points:
    """Points moved towards others where they are not `inside`, a signed distance."""
    outside = inside < 0
    share = (inside[outside] / (inside[outside] - others_inside[outside]))[:, None]
    moved = points.copy()
    moved[outside] += share * (others[outside] - points[outside])
    return moved


def to_pixels(view: View, points: Points, columns: int, rows: int) -> Points:
    """Column, row and nearness of points before the eye, in the camera's coordinates. Nearness is 1 over the distance
    ahead, which is linear along a line in the picture."""
    nearness = 1 / np.maximum(points[:, 2], NEAREST)
    x, y = view.distance * points[:, 0] * nearness, view.distance * points[:, 1] * nearness
    column = (x + 1) / 2 * (columns - 1)
    row = (1 - y / half_height(view, columns, rows)) / 2 * (rows - 1)
    return np.stack([column, row, nearness], axis=1)


def to_scene(view: View, pixels: Points, columns: int, rows: int) -> Points:
    """Points of the scene at columns, rows and nearnesses: what `to_camera` and `to_pixels` undo."""
    ahead = 1 / pixels[:, 2]
    right = (2 * pixels[:, 0] / max(columns - 1, 1) - 1) * ahead / view.distance
    up = (1 - 2 * pixels[:, 1] / max(rows - 1, 1)) * half_height(view, columns, rows) * ahead / view.distance
    return np.stack([right, up, ahead], axis=1) @ np.array([view.right, view.up, view.normal]) + np.array(view.eye)


def within(a: Points, b: Points, columns: int, rows: int) -> tuple[Points, Points]:
    """Lines between pixels cut to the picture (Liang and Barsky 1984), those outside left out."""
    delta = b - a
    low, high = np.zeros(len(a)), np.ones(len(a))
    for axis, size in ((0, columns), (1, rows)):
        for sign, limit in ((-1.0, 0.5), (1.0, size - 0.5)):
            p, q = sign * delta[:, axis], limit - sign * a[:, axis]
            with np.errstate(all="ignore"):
                t = q / p
            low = np.where(p < 0, np.maximum(low, t), low)
            high = np.where(p > 0, np.minimum(high, t), high)
            low = np.where((p == 0) & (q < 0), 2.0, low)
    kept = low <= high
    starts, ends = (_clipped(between(a[kept], b[kept], share[kept]), columns, rows) for share in (low, high))
    return starts, ends


def between(a: Points, b: Points, shares: NDArray[np.float64]) -> Points:
    """Points of the lines from a to b, at shares of their lengths. Of two positive nearnesses none becomes 0, not even
    where one is so small that it is lost beside the other."""
    return (1 - shares[:, None]) * a + shares[:, None] * b


def _clipped(points: Points, columns: int, rows: int) -> Points:
    """Points in the picture: where a line comes from so far that its numbers do not tell, at its edge."""
    points[:, :2] = points[:, :2].clip(-0.5, (columns - 0.5, rows - 0.5))
    return points
