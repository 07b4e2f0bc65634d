"""How much air bends light, between two points of a temperature profile (thesis 2.1 and 2.2).

The renderer's kernel computes the same in `crates/kernel/src/optics/atmosphere.rs`. It is not asked, because a fault of
native code would end the server, and to start the process that draws takes longer than a hover may. `test_air.py` holds
the two together.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

# ε of η = 1 + εβp/T (thesis eq. 2.2), and β of ρ = βp/T, kg K/J.
_EPSILON, _BETA = 226e-6, 3.48e-3
_GRAVITY = 9.80665  # m/s²
_SEA_LEVEL_PRESSURE = 101_325.0  # Pa, at height 0
_CELSIUS = 273.15  # 0 °C in K

EARTH_CURVATURE = 1 / 6_371_000.0
"""1/R, 1/m."""


class Layer(NamedTuple):
    """The air between two points of a profile: heights in m, `gradient` dT/dz in K/m, and the `curvature` of a level
    ray in its middle, 1/m, positive where it is concave toward the earth."""

    bottom: float
    top: float
    gradient: float
    curvature: float


class Air:
    """The air of a temperature profile: `heights` in m, `temperatures` in degrees Celsius. Temperature is linear
    between the points and constant beyond them; pressure is hydrostatic. Raises ValueError where the heights do not
    increase, or a temperature is not above absolute zero."""

    def __init__(self, heights: Sequence[float], temperatures: Sequence[float]) -> None:
        self._points = [(z, celsius + _CELSIUS) for z, celsius in zip(heights, temperatures, strict=True)]
        if any(low[0] >= high[0] for low, high in pairwise(self._points)):
            raise ValueError("the heights do not increase")
        if any(kelvin <= 0 for _, kelvin in self._points):
            raise ValueError("a temperature is not above absolute zero")

    def layer(self, number: int) -> Layer:
        """The layer between point `number` and the next."""
        (bottom, low), (top, high) = self._points[number : number + 2]
        gradient = (high - low) / (top - bottom)
        middle = 0.5 * (bottom + top)
        return Layer(bottom, top, gradient, _curvature(gradient, self._pressure(middle), self._temperature(middle)))

    def _temperature(self, height: float) -> float:
        """In K."""
        first, last = self._points[0], self._points[-1]
        if height <= first[0]:
            return first[1]
        for (z0, t0), (z1, t1) in pairwise(self._points):
            if height < z1:
                return t0 + (t1 - t0) * ((height - z0) / (z1 - z0))
        return last[1]

    def _pressure(self, height: float) -> float:
        """In Pa, from sea level through every point of the profile in between."""
        low, high = sorted((0.0, height))
        stops = [low, *(z for z, _ in self._points if low < z < high), high]
        ratio = sum(_log_ratio(self._temperature(z0), self._temperature(z1), z1 - z0) for z0, z1 in pairwise(stops))
        return _SEA_LEVEL_PRESSURE * math.exp(math.copysign(1.0, height) * ratio)


def _log_ratio(t0: float, t1: float, height: float) -> float:
    """ln(p₁/p₀) over a height in which temperature runs linearly from t0 to t1."""
    rise = (t1 - t0) / t0
    mean = 1.0 if abs(rise) < 1e-12 else math.log1p(rise) / rise
    return -_BETA * _GRAVITY * height / t0 * mean


def _curvature(gradient: float, pressure: float, temperature: float) -> float:
    """κ of a horizontal ray, κ = εβp (dT/dz + βg) / (ηT²): thesis eq. 2.3 with pressure for its second ρ."""
    eta = 1.0 + _EPSILON * _BETA * pressure / temperature
    return _EPSILON * _BETA * pressure * (gradient + _BETA * _GRAVITY) / (eta * temperature * temperature)
