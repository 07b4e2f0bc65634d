"""The fan of rays from the eye, in the vertical plane of view: where they go, and where they cross. Thesis 6.1.

Where neighbouring rays cross, what stands beyond is seen upside down, and what stands there is seen more than once.
"""

# matplotlib leaves some types of its own open.
# pyright: reportUnknownMemberType=false
from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from m3d_render.geometry import ViewPlane
from m3d_render.optics import air_layers, trace_paths
from m3d_render.plot.section import Cut, section
from m3d_render.sight import things_distance, view_angles
from m3dc.ir import SceneIR

if TYPE_CHECKING:
    from matplotlib.axes import Axes

RAYS = 41
"""How many rays a fan has that is not told."""

STEPS = 800
"""Distances at which the height of a ray is known, but for the first."""
_BEYOND = 1.25  # of the distance of things: how far a fan reaches that is not told


@dataclass(frozen=True, slots=True)
class RayFan:
    """Rays from an eye at height `eye`, m, and what they pass.

    `heights[i, j]`, m, is the ray of `angles[i]`, rad above the horizontal, at the distance `distances[j]`, m; NaN
    beyond where it ended at the ground. `bent[i]` is the distance up to which the air bends it, and `ends[i]` why no
    farther; it goes on straight from there. `crossings` (n, 2) are (distance, height) where neighbouring rays cross,
    and `crossing_angles` the middle of their angles, rad. `boundaries` are the heights between layers of the air, m.
    """

    eye: float
    angles: NDArray[np.float64]
    distances: NDArray[np.float64]
    heights: NDArray[np.float64]
    bent: NDArray[np.float64]
    ends: NDArray[np.str_]
    crossings: NDArray[np.float64]
    crossing_angles: NDArray[np.float64]
    boundaries: NDArray[np.float64]
    cuts: list[Cut]


def straight_on(
    angles: NDArray[np.float64], eye: float, ir: SceneIR, at: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.str_]]:
    """Heights of rays at distances, where the air bends them no longer too: (heights, bent, ends), as in RayFan."""
    if ir.scene.mirage is None:
        heights = eye + np.tan(angles)[:, None] * at
        return heights, np.zeros(len(angles)), np.full(len(angles), "range")
    paths = trace_paths(ir, angles, at=at)
    r, z = paths.end_points.T[:, :, None]
    beyond = z + paths.end_slopes[:, None] * (at - r)
    goes_on = (paths.ends != "ground")[:, None] & np.isnan(paths.heights)
    return np.where(goes_on, beyond, paths.heights), paths.end_points[:, 0], paths.ends


def ray_fan(
    ir: SceneIR, angles_rad: Iterable[float] | None = None, reach: float | None = None, turn_deg: float = 0.0
) -> RayFan:
    """Rays at angles above the horizontal (by default RAYS over the picture's height), as far as `reach`, m (by
    default a quarter beyond what is looked at), in the plane of view turned so many degrees to the right.

    Raises SceneError where the eye is outside of the temperature profile.
    """
    angles = np.linspace(*view_angles(ir), RAYS) if angles_rad is None else np.fromiter(angles_rad, np.float64)
    eye = ir.scene.view.eye[2]
    if reach is None:
        reach = _BEYOND * things_distance(ir) or 1.0
    distances = np.linspace(0, reach, STEPS + 1)
    heights, bent, ends = straight_on(angles, eye, ir, distances)
    crossings, crossing_angles = _crossings(angles, distances, heights)
    layers = air_layers(ir)
    boundaries = np.append(layers.bottom, layers.top[-1:])
    cuts = section(ir, ViewPlane.of(ir, turn_deg))
    return RayFan(eye, angles, distances, heights, bent, ends, crossings, crossing_angles, boundaries, cuts)


def _crossings(
    angles: NDArray[np.float64], distances: NDArray[np.float64], heights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where each ray crosses the next: their height difference changes its sign between two distances."""
    apart = np.diff(heights, axis=0)
    # All rays meet in the eye, which is no crossing.
    ray, step = np.nonzero(apart[:, 1:-1] * apart[:, 2:] < 0)
    step += 1
    before, after = apart[ray, step], apart[ray, step + 1]
    share = before / (before - after)
    low, high = heights[ray, step], heights[ray, step + 1]
    points = np.stack([distances[step] + share * np.diff(distances)[step], low + share * (high - low)], axis=1)
    return points, (angles[ray] + angles[ray + 1]) / 2


def table(fan: RayFan) -> tuple[list[str], list[NDArray[np.generic]]]:
    """Columns: a row a ray and distance, its last with the reason it ended; then a row a crossing, and the two ends
    of every line of a solid in section."""
    ray, step = np.nonzero(~np.isnan(fan.heights))
    last = np.append(np.diff(ray) > 0, np.full(min(len(ray), 1), True))
    minutes = np.degrees(fan.angles) * 60
    within = fan.bent[ray] <= fan.distances[-1]
    lines = [(cut.solid, cut.segments.reshape(-1, 2)) for cut in fan.cuts]
    solids = np.concatenate([np.full(len(points), solid) for solid, points in [*lines, (0, np.zeros((0, 2)))]])
    points = np.concatenate([*(points for _, points in lines), np.zeros((0, 2))])
    kinds = np.repeat(["ray", "crossing", "solid"], [len(ray), len(fan.crossings), len(points)])
    blank = np.full(len(points), math.nan)
    columns: list[NDArray[np.generic]] = [
        kinds,
        np.concatenate([ray, np.arange(len(fan.crossings)), solids.astype(np.int64)]),
        np.concatenate([minutes[ray], np.degrees(fan.crossing_angles) * 60, blank]),
        np.concatenate([fan.distances[step], fan.crossings[:, 0], points[:, 0]]),
        np.concatenate([fan.heights[ray, step], fan.crossings[:, 1], points[:, 1]]),
        np.concatenate([np.where(last & within, fan.ends[ray], ""), np.full(len(kinds) - len(ray), "")]),
    ]
    return ["kind", "number", "angle_arcmin", "r_m", "z_m", "end"], columns


def height_range(fan: RayFan) -> tuple[float, float]:
    """The heights worth drawing, m: the ground, the eye, things in section and crossings, with some room above."""
    reach = fan.distances[-1]
    points = [cut.segments.reshape(-1, 2) for cut in fan.cuts] + [fan.crossings]
    heights = np.concatenate([part[(part[:, 0] >= 0) & (part[:, 0] <= reach), 1] for part in points])
    levels = [cut.level for cut in fan.cuts if cut.level is not None]
    low = min([fan.eye, *levels, *fan.boundaries[:1], heights.min(initial=fan.eye)])
    high = max([fan.eye, *levels, heights.max(initial=fan.eye)])
    room = (high - low) or 1.0
    return low - 0.08 * room, high + 0.35 * room


def draw_fan(fan: RayFan, axes: Axes, heights: tuple[float, float] | None = None) -> None:
    """Draws the fan: rays (dashed where the air bends them no longer), crossings as circles, layers as light lines,
    solids in section and the ground, all with labels for a legend. `heights` are the lowest and highest shown, m."""
    low, high = height_range(fan) if heights is None else heights
    unit, metres = ("km", 1000.0) if fan.distances[-1] >= 1000 else ("m", 1.0)
    distances = fan.distances / metres
    reach = distances[-1]
    air = len(fan.boundaries) > 0
    if air:
        axes.hlines(fan.boundaries, 0, reach, colors="0.8", linewidths=0.4, label="layers of the air")
    for i, ray in enumerate(fan.heights):
        bent = fan.distances <= (fan.bent[i] if air else math.inf)
        axes.plot(distances[bent], ray[bent], "k", linewidth=0.5, label="" if i else "rays")
        # From the last bent point on, so that there is no gap.
        straight = ~bent | np.append(~bent[1:], False)
        if not bent.all():
            axes.plot(distances[straight], ray[straight], "k", linewidth=0.4, linestyle=(0, (6, 3)))
    levels = [cut.level for cut in fan.cuts if cut.level is not None]
    if levels:
        axes.fill_between(
            [0, reach],
            [max(levels)] * 2,
            low,
            facecolor="0.85",
            edgecolor="0.3",
            hatch="///",
            zorder=2.5,
            label="ground",
        )
    label = "solids in section"
    for cut in fan.cuts:
        if len(cut.segments):
            _draw_cut(cut, metres, axes, label)
            label = ""
    if len(fan.crossings):
        axes.plot(
            fan.crossings[:, 0] / metres,
            fan.crossings[:, 1],
            "o",
            zorder=4,
            markersize=3.5,
            markerfacecolor="w",
            markeredgecolor="k",
            markeredgewidth=0.7,
            label="neighbouring rays cross",
        )
    axes.set(xlabel=f"distance, {unit}", ylabel="height, m", xlim=(0, reach), ylim=(low, high))


def _draw_cut(cut: Cut, metres: float, axes: Axes, label: str) -> None:
    points = cut.segments / (metres, 1)
    if cut.filled:
        axes.fill(
            points[:, 0, 0], points[:, 0, 1], facecolor="0.6", edgecolor="k", linewidth=1.2, zorder=3, label=label
        )
        return
    for i, segment in enumerate(points):
        axes.plot(
            segment[:, 0], segment[:, 1], "k", linewidth=2.5, solid_capstyle="butt", zorder=3, label="" if i else label
        )
