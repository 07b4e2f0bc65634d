"""Triangles cut by a vertical plane."""

from __future__ import annotations

import numpy as np

from m3d_render.geometry.shape import Points
from m3d_render.geometry.view_plane import ViewPlane


def cut(corners: Points, plane: ViewPlane) -> Points:
    """The segments (n, 2, 2) in the plane that triangles (m, 3, 3) have in common with it (thesis 4.3)."""
    side = (corners - plane.eye) @ plane.normal
    met = (side.min(axis=1) <= 0) & (side.max(axis=1) >= 0)
    corners, side = corners[met], side[met]
    following, next_side = np.roll(corners, -1, axis=1), np.roll(side, -1, axis=1)
    # The edge of an open mesh may lie in the plane.
    lying = (side == 0) & (next_side == 0)
    edges = np.stack([corners[lying], following[lying]], axis=1)
    # A proper cut leaves through two edges; a corner in the plane counts to one side, so that they stay two.
    crossed = (side < 0) != (next_side < 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (side / (side - next_side))[..., None]
        points = corners + share * (following - corners)
    return plane.to_plane(np.concatenate([edges, points[crossed].reshape(-1, 2, 3)]))
