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


class Air:
    """The air of a scene, ready for any number of rays. Raises SceneError for a scene without a MIRAGE.

    `finer` divides each interval of the temperature profile into so many layers. Rays start at a height, the VIEW's if
    none is given.
    """

    def __init__(self, ir: SceneIR, finer: int = 1) -> None:
        self._eye_height = float(ir.scene.view.eye[2])
        try:
            self._kernel = _kernel.Air(m3ir.header(ir), dict(ir.tables), whole("finer", finer, 1, MOST_FINER))
        except ValueError as error:
            raise SceneError(str(error)) from None

    def paths(
        self, angles_rad: Iterable[float], eye_height: float | None = None, at: Iterable[float] | None = None
    ) -> Paths:
        """Rays at angles above the horizontal, in radians. `at` are the horizontal distances whose heights are wanted;
        for every layer crossing of a ray see `crossings`."""
        angles = _angles(angles_rad)
        distances = _numbers([] if at is None else at)
        try:
            ends, tips, arcs, heights = self._kernel.paths(self._height(eye_height), np.tan(angles), distances.tolist())
        except ValueError as error:
            raise SceneError(str(error)) from None
        return Paths(angles, distances, heights, np.array(_kernel.END_NAMES)[ends], tips[:, :2], tips[:, 2], arcs)

    def crossings(self, angle_rad: float, eye_height: float | None = None) -> NDArray[np.float64]:
        """Every layer crossing of one ray: rows of (distance, height), the eye first and the end last."""
        (angle,) = _angles([angle_rad])
        try:
            return self._kernel.crossings(self._height(eye_height), float(np.tan(angle)))
        except ValueError as error:
            raise SceneError(str(error)) from None

    def layers(self) -> AirLayers:
        """The layers that rays are traced through, up to the MIRAGE block's ELEVATION."""
        bottom, top, effective = self._kernel.layers().T.copy()
        return AirLayers(bottom, top, effective + EARTH_CURVATURE, effective)

    def _height(self, eye_height: float | None) -> float:
        return self._eye_height if eye_height is None else float(eye_height)


def trace_paths(
    ir: SceneIR,
    angles_rad: Iterable[float],
    eye_height: float | None = None,
    at: Iterable[float] | None = None,
    finer: int = 1,
) -> Paths:
    """`Air.paths` of a scene's air, which is built for this call alone."""
    return Air(ir, finer).paths(angles_rad, eye_height, at)


def trace_crossings(
    ir: SceneIR, angle_rad: float, eye_height: float | None = None, finer: int = 1
) -> NDArray[np.float64]:
    """`Air.crossings` of a scene's air, which is built for this call alone."""
    return Air(ir, finer).crossings(angle_rad, eye_height)


def air_layers(ir: SceneIR, finer: int = 1) -> AirLayers:
    """`Air.layers` of a scene's air; none without a MIRAGE."""
    return AirLayers(*np.zeros((4, 0))) if ir.scene.mirage is None else Air(ir, finer).layers()


def _angles(radians: Iterable[float]) -> NDArray[np.float64]:
    angles = np.atleast_1d(_numbers(radians))
    if not np.isfinite(angles).all():
        raise SceneError("an angle is no finite number")
    return angles


def _numbers(values: Iterable[float]) -> NDArray[np.float64]:
    return np.asarray(values if isinstance(values, np.ndarray) else list(values), dtype=np.float64)
