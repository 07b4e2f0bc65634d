"""Ray paths through a scene's atmosphere, without a picture."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from m3d_render import _kernel
from m3d_render.rendering import MOST_FINER, SceneError, whole
from m3dc.ir import SceneIR, m3ir


@dataclass(frozen=True, slots=True)
class Paths:
    """Paths of rays that leave an eye at given angles.

    `heights[i, j]` is the height of ray i at distance `at[j]`, NaN beyond its end. A path ends at the `"ground"`
    (below the lowest layer), the `"top"` (above the highest, or the elevation limit), at the `"range"` or at the
    number of `"segments"` that the MIRAGE block allows; `end_points[i]` is where, (distance, height), and
    `end_slopes[i]` its dz/dr there, with which a ray goes on straight. `arcs` counts the parabolas of each.
    """

    angles: NDArray[np.float64]
    at: NDArray[np.float64]
    heights: NDArray[np.float64]
    ends: NDArray[np.str_]
    end_points: NDArray[np.float64]
    end_slopes: NDArray[np.float64]
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
    angles = _angles(angles_rad)
    distances = _numbers([] if at is None else at)
    try:
        ends, tips, arcs, heights = _air(ir, finer).paths(_height(ir, eye_height), np.tan(angles), distances.tolist())
    except ValueError as error:
        raise SceneError(str(error)) from None
    return Paths(angles, distances, heights, np.array(_kernel.END_NAMES)[ends], tips[:, :2], tips[:, 2], arcs)


@dataclass(frozen=True, slots=True)
class AirLayers:
    """The layers of a scene's air, from the lowest, one or more an interval of the temperature profile.

    `bottom` and `top` in m. `curvature` is that of a level ray, 1/m, positive where it is concave toward the earth
    (thesis eq. 2.3); `effective` the same over an earth that is drawn flat, less 1/R.
    """

    bottom: NDArray[np.float64]
    top: NDArray[np.float64]
    curvature: NDArray[np.float64]
    effective: NDArray[np.float64]


EARTH_CURVATURE: float = 1 / _kernel.EARTH_RADIUS
"""1/R, 1/m."""


def air_layers(ir: SceneIR, finer: int = 1) -> AirLayers:
    """The layers that rays are traced through, up to the MIRAGE block's ELEVATION; none without a MIRAGE."""
    if ir.scene.mirage is None:
        return AirLayers(*np.zeros((4, 0)))
    try:
        bottom, top, effective = _air(ir, finer).layers().T.copy()
    except ValueError as error:
        raise SceneError(str(error)) from None
    return AirLayers(bottom, top, effective + EARTH_CURVATURE, effective)


def trace_crossings(
    ir: SceneIR, angle_rad: float, eye_height: float | None = None, finer: int = 1
) -> NDArray[np.float64]:
    """Every layer crossing of one ray: rows of (distance, height), the eye first and the end last."""
    (angle,) = _angles([angle_rad])
    try:
        return _air(ir, finer).crossings(_height(ir, eye_height), float(np.tan(angle)))
    except ValueError as error:
        raise SceneError(str(error)) from None


def _angles(radians: Iterable[float]) -> NDArray[np.float64]:
    angles = np.atleast_1d(_numbers(radians))
    if not np.isfinite(angles).all():
        raise SceneError("an angle is no finite number")
    return angles


def _air(ir: SceneIR, finer: int) -> _kernel.Air:
    """The kernel's air of a scene. Raises ValueError where it has none."""
    return _kernel.Air(m3ir.header(ir), dict(ir.tables), whole("finer", finer, 1, MOST_FINER))


def _numbers(values: Iterable[float]) -> NDArray[np.float64]:
    return np.asarray(values if isinstance(values, np.ndarray) else list(values), dtype=np.float64)


def _height(ir: SceneIR, eye_height: float | None) -> float:
    return float(ir.scene.view.eye[2] if eye_height is None else eye_height)
