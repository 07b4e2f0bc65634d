"""Axes along the edges of the box that holds the scene and its eye, with ticks at round numbers."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from m3d_render.view.ground import places_of_interest, round_down
from m3dc.ir import SceneIR

Points = NDArray[np.float64]

_TICKS = 4  # at least so many steps along an axis
_BEYOND = 0.05  # of its length: how far an axis's name stands from its end


class Axes(NamedTuple):
    """`lines` (3, 2, 3); `ticks` (n, 3), the points at round numbers; `labels` (m, 3), where the `texts` (m) stand:
    the numbers at the ticks, then the axes' names."""

    lines: Points
    ticks: Points
    labels: Points
    texts: list[str]


def axes(ir: SceneIR) -> Axes:
    """Axes that meet in the lowest corner on the eye's side. Lengths are metres where there is an atmosphere."""
    places = places_of_interest(ir)
    low, high = places.min(axis=0), places.max(axis=0)
    eye = np.array(ir.scene.view.eye)
    corner = low.copy()
    beyond = np.abs(eye - low) > np.abs(eye - high)
    corner[beyond] = high[beyond]
    corner[2] = low[2]
    unit = "" if ir.scene.mirage is None else ", m"
    lines: Points = np.tile(corner, (3, 2, 1))
    ticks: list[Points] = []
    texts: list[str] = []
    names: list[Points] = []
    for axis in range(3):
        lines[axis, :, axis] = corner[axis], low[axis] + high[axis] - corner[axis]
        name = lines[axis, 1].copy()
        name[axis] += _BEYOND * (name - corner)[axis]
        names.append(name)
        first, last = float(low[axis]), float(high[axis])
        step = round_down((last - first) / _TICKS)
        numbers = step * np.arange(math.ceil(first / step - 1e-9), math.floor(last / step + 1e-9) + 1)
        points = np.repeat(corner[None], len(numbers), axis=0)
        points[:, axis] = numbers
        ticks.append(points)
        texts += [f"{number:.6g}" for number in numbers.tolist()]
    return Axes(
        lines, np.concatenate(ticks), np.concatenate([*ticks, names]), [*texts, *(f"{name}{unit}" for name in "xyz")]
    )
