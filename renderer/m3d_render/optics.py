"""Ray paths through a scene's atmosphere, without a picture."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from m3d_render import _kernel
from m3d_render.rendering import SceneError
from m3dc.ir import SceneIR


@dataclass(frozen=True, slots=True)
class Paths:
    """Paths of rays that leave an eye at given angles.

    `heights[i, j]` is the height of ray i at distance `at[j]`, NaN beyond its end. A path ends at the `"ground"`
    (below the lowest layer), the `"top"` (above the highest, or the elevation limit), at the `"range"` or at the
    number of `"segments"` that the MIRAGE block allows; `end_points[i]` is where, (distance, height). `arcs` counts
    the parabolas of each.
    """

    angles: NDArray[np.float64]
    at: NDArray[np.float64]
    heights: NDArray[np.float64]
    ends: NDArray[np.str_]
    end_points: NDArray[np.float64]
    arcs: NDArray[np.uint32]


def trace_paths(
    ir: SceneIR,
    angles_rad: Iterable[float],
    eye_height: float | None = None,
    at: Iterable[float] | None = None,
    finer: int = 1,
) -> Paths:
    """Traces rays at angles above the horizontal, in radians, from a height (the VIEW's, if none is given).

    `at` are the horizontal distances whose heights are wanted; `finer` divides each interval of the temperature
    profile into so many layers. For every layer crossing of a ray see `trace_crossings`.
    """
    angles = np.atleast_1d(_numbers(angles_rad))
    distances = _numbers([] if at is None else at)
    try:
        ends, points, arcs, heights = _kernel.trace_paths(
            ir, _height(ir, eye_height), np.tan(angles), distances.tolist(), finer
        )
    except ValueError as error:
        raise SceneError(str(error)) from None
    return Paths(angles, distances, heights, np.array(_kernel.END_NAMES)[ends], points, arcs)


def trace_crossings(
    ir: SceneIR, angle_rad: float, eye_height: float | None = None, finer: int = 1
) -> NDArray[np.float64]:
    """Every layer crossing of one ray: rows of (distance, height), the eye first and the end last."""
    try:
        return _kernel.trace_crossings(ir, _height(ir, eye_height), float(np.tan(angle_rad)), finer)
    except ValueError as error:
        raise SceneError(str(error)) from None


def _numbers(values: Iterable[float]) -> NDArray[np.float64]:
    return np.asarray(values if isinstance(values, np.ndarray) else list(values), dtype=np.float64)


def _height(ir: SceneIR, eye_height: float | None) -> float:
    return float(ir.scene.view.eye[2] if eye_height is None else eye_height)
