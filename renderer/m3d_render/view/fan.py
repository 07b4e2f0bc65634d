"""The rays from the eye over the picture's height, as curves in the scene."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3d_render.geometry import ViewPlane
from m3d_render.optics import trace_paths
from m3d_render.sight import things_distance, view_angles
from m3dc.ir import SceneIR

Points = NDArray[np.float64]

RAYS = 25
MOST_RAYS = 10_000

_STEPS = 600
_BEYOND = 1.15  # of the distance of what is looked at


class Fan(NamedTuple):
    """Rays at `angles` (n), rad above the horizontal. `curves[i]` (k, 3) are points along ray i, from the eye."""

    angles: Points
    curves: list[Points]


def fan(ir: SceneIR, count: int = RAYS) -> Fan:
    """So many rays in the vertical plane of view, from the picture's lower edge to its upper one, to somewhat beyond
    what is looked at. The air bends them as far as MIRAGE says, then they are straight; they end at the ground of the
    air, and go through things.

    Raises SceneError where the eye is outside of the temperature profile.
    """
    angles = np.linspace(*view_angles(ir), count)
    plane = ViewPlane.of(ir)
    reach = _BEYOND * things_distance(ir) or 1.0

    def in_scene(distances: Points, heights: Points) -> Points:
        points = plane.eye + distances[:, None] * plane.along
        points[:, 2] = heights
        return points

    if ir.scene.mirage is None:
        ends = np.array([0.0, reach])
        eye = float(plane.eye[2])
        return Fan(angles, [in_scene(ends, eye + slope * ends) for slope in np.tan(angles)])
    at = np.linspace(0, reach, _STEPS + 1)
    paths = trace_paths(ir, angles, at=at)
    curves: list[Points] = []
    for heights, end, (r, z), slope in zip(paths.heights, paths.ends, paths.end_points, paths.end_slopes, strict=True):
        bent = ~np.isnan(heights)
        distances, heights = at[bent], heights[bent]
        if r < reach:
            distances, heights = np.append(distances, r), np.append(heights, z)
            if end != "ground":
                distances, heights = np.append(distances, reach), np.append(heights, z + slope * (reach - r))
        curves.append(in_scene(distances, heights))
    return Fan(angles, curves)
