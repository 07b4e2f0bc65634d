"""The transfer characteristic: at which angle each height at a distance is seen.

Through air that does not bend rays it is a straight line. Where it runs backward, things are seen upside down; where
it is steep they are stretched (towering), where it is flat compressed (stooping). A height that it passes three times
is seen three times. The curve is what a picture's column shows of a ruler at that distance.
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

from m3d_render.plot.rays import straight_on
from m3d_render.sight import things_distance, view_angles
from m3dc.ir import SceneIR

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ANGLES = 2001
"""How many angles a transfer characteristic has that is not told."""
TOWERING, STOOPING = 1.5, 1 / 1.5
"""Vertical magnifications above and below which things count as stretched and as compressed."""


@dataclass(frozen=True, slots=True)
class Transfer:
    """What is seen at each angle, at several distances.

    `heights[i, j]`, m, is what the ray of `angles[j]`, rad above the horizontal, meets at `distances[i]`, m; NaN
    where it ended at the ground before. `ends[j]` is why the air bends the ray no farther than `bent[j]`, m.
    `magnification[i, j]` is dθ/dz over that of straight rays: below 0 where the picture is upside down. `eye` is the
    height of the eye, m.
    """

    eye: float
    distances: NDArray[np.float64]
    angles: NDArray[np.float64]
    heights: NDArray[np.float64]
    magnification: NDArray[np.float64]
    bent: NDArray[np.float64]
    ends: NDArray[np.str_]

    def kinds(self, i: int) -> NDArray[np.str_]:
        """For each angle what becomes of things at distance i: `inverted`, `towering`, `stooping`, `plain`, or
        `missed` where the ray ended at the ground before."""
        magnification = self.magnification[i]
        kinds = np.select(
            [np.isnan(self.heights[i]), magnification < 0, magnification > TOWERING, magnification < STOOPING],
            ["missed", "inverted", "towering", "stooping"],
            "plain",
        )
        return np.asarray(kinds, np.str_)

    def zones(self, i: int) -> list[Zone]:
        """Runs of angles of one kind at distance i, from the lowest. Each begins midway between two angles."""
        kinds = self.kinds(i)
        starts = np.flatnonzero(np.append(True, kinds[1:] != kinds[:-1]))
        stops = np.append(starts[1:], len(kinds))
        edges = np.concatenate([self.angles[:1], (self.angles[1:] + self.angles[:-1]) / 2, self.angles[-1:]])
        return [
            Zone(str(kinds[start]), float(edges[start]), float(edges[stop]), slice(int(start), int(stop)))
            for start, stop in zip(starts, stops, strict=True)
        ]


@dataclass(frozen=True, slots=True)
class Zone:
    """A run of angles, rad, from `low` to `high`, with one kind of picture; `part` is where it is in the arrays."""

    kind: str
    low: float
    high: float
    part: slice


def transfer_characteristic(
    ir: SceneIR, distances: Iterable[float] | None = None, angles_rad: Iterable[float] | None = None
) -> Transfer:
    """What is seen of heights at distances, m (by default that of what is looked at), at increasing angles above the
    horizontal (by default ANGLES over the picture's height).

    A ray that has left the profile by its top, or has reached a limit of MIRAGE, goes on straight, as in a picture.
    Raises SceneError where the eye is outside of the temperature profile, ValueError for angles that do not increase.
    """
    at = np.array([things_distance(ir)] if distances is None else list(distances), np.float64)
    angles = np.linspace(*view_angles(ir), ANGLES) if angles_rad is None else np.fromiter(angles_rad, np.float64)
    if len(angles) < 2 or not (np.diff(angles) > 0).all():
        raise ValueError("a transfer characteristic needs at least two angles, and they must increase")
    eye = ir.scene.view.eye[2]
    heights, bent, ends = straight_on(angles, eye, ir, at)
    heights = heights.T.copy()
    straight = at[:, None] / np.cos(angles) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):
        magnification = straight / np.gradient(heights, angles, axis=1)
    return Transfer(eye, at, angles, heights, magnification, bent, ends)


def table(found: Transfer) -> tuple[list[str], list[NDArray[np.generic]]]:
    """Columns: a row a distance and angle; `end` is why a ray that met nothing at the distance ended before."""
    count = len(found.distances)
    missed = np.isnan(found.heights)
    return ["distance_m", "angle_arcmin", "z_m", "magnification", "zone", "end"], [
        np.repeat(found.distances, len(found.angles)),
        np.tile(np.degrees(found.angles) * 60, count),
        found.heights.ravel(),
        np.where(missed, math.nan, found.magnification).ravel(),
        np.concatenate([found.kinds(i) for i in range(count)]),
        np.where(missed, found.ends, "").ravel(),
    ]


_BANDS: dict[str, dict[str, object]] = {
    "inverted": {"facecolor": "none", "edgecolor": "0.55", "hatch": "////", "label": "inverted"},
    "towering": {"facecolor": "0.82", "edgecolor": "none", "label": f"stretched, over {TOWERING:.2g} times"},
    "stooping": {"facecolor": "none", "edgecolor": "0.7", "hatch": "..", "label": f"compressed, under {STOOPING:.2g}"},
    "missed": {"facecolor": "0.9", "edgecolor": "0.3", "hatch": "xx", "label": "the ray ends at the ground before"},
}
_LINES = {"inverted": {"linestyle": (0, (4, 1.5)), "linewidth": 1.6}}


def draw_transfer(found: Transfer, i: int, axes: Axes, heights: tuple[float, float] | None = None) -> None:
    """Draws the characteristic at distance i, with its zones; a thin line is what straight rays would show. All
    have labels for a legend. `heights` are the lowest and highest shown, m."""
    minutes = np.degrees(found.angles) * 60
    named: set[str] = set()
    for zone in found.zones(i):
        low, high = (math.degrees(angle) * 60 for angle in (zone.low, zone.high))
        if zone.kind in _BANDS:
            style = dict(_BANDS[zone.kind])
            label = style.pop("label")
            axes.axhspan(low, high, linewidth=0, label="" if zone.kind in named else str(label), **style)  # pyright: ignore[reportArgumentType]
            named.add(zone.kind)
        # One point more on each side, so that the pieces meet.
        part = slice(max(zone.part.start - 1, 0), zone.part.stop)
        line = _LINES.get(zone.kind, {"linestyle": "-", "linewidth": 1.0})
        axes.plot(found.heights[i, part], minutes[part], "k", **line)  # pyright: ignore[reportArgumentType]
    straight = found.eye + found.distances[i] * np.tan(found.angles)
    axes.plot(straight, minutes, color="0.4", linewidth=0.7, linestyle=":", label="straight rays")
    met = found.heights[i][~np.isnan(found.heights[i])]
    low, high = (float(met.min(initial=found.eye)), float(met.max(initial=found.eye))) if heights is None else heights
    room = 0.0 if heights else 0.03 * ((high - low) or 1.0)
    axes.set(xlabel="height, m", ylabel="angle above the horizontal, arcmin", ylim=(minutes[0], minutes[-1]))
    axes.set(xlim=(low - room, high + room), title=f"at {found.distances[i]:g} m")
    axes.axhline(0, color="0.5", linewidth=0.5)
