"""Light rays around the round earth, by integrating the equation of the ray: what the kernel is held to.

Nothing here is shared with the renderer but the constants of the air. The earth is a sphere, the air depends on the
height alone, and a ray is followed by its elevation angle ψ above the local horizontal, at any angle:

    dz/ds = sin ψ    dx/ds = cos ψ / (1 + z/R)    dψ/ds = cos ψ (1/(R + z) + n'/n)

s is the length of the ray, x the distance along the earth's surface. Where the gradient of the index jumps, the
integration begins anew: it never steps over a kink. It begins anew where a ray is level, too, so that the height only
rises or only falls in between, and no boundary is passed twice within a step.

>>> STANDARD.refraction(0.0, 0.0) * 3600 * 180 / math.pi  # the setting sun's, from sea level
1970.1597...
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Self

import numpy as np
from array_types import Floats
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

EPSILON, BETA, GRAVITY, EARTH, SEA_LEVEL, CELSIUS = 226e-6, 3.48e-3, 9.80665, 6_371_000.0, 101_325.0, 273.15

Index = Callable[[float], tuple[float, float]]
"""Refractivity n - 1 at a height in metres, and its derivative."""


@dataclass(frozen=True)
class Point:
    """Where a ray is: its distance along the surface, height, and elevation angle above the local horizontal."""

    distance: float
    height: float
    elevation: float


@dataclass(frozen=True)
class Air:
    """Air in shells, smooth within each: `indices[i]` holds from `heights[i]` to `heights[i + 1]`."""

    heights: Sequence[float]
    indices: Sequence[Index]
    radius: float = EARTH

    @classmethod
    def of_profile(cls, profile: Sequence[tuple[float, float]], radius: float = EARTH) -> Self:
        """The thesis's air (2.1): temperatures in °C at heights, linear between, and 101325 Pa at z = 0."""
        heights = [z for z, _ in profile]
        temperatures = [celsius + CELSIUS for _, celsius in profile]
        gradients: list[float] = (np.diff(temperatures) / np.diff(heights)).tolist()
        # The pressure at each height but for a factor, which that at sea level then gives.
        pressures = [1.0]
        for i, gradient in enumerate(gradients):
            pressures.append(pressures[-1] * _falls(temperatures[i], gradient, heights[i + 1] - heights[i]))
        at_zero = min(max(bisect.bisect_right(heights, 0.0) - 1, 0), len(gradients) - 1)
        below_zero = -heights[at_zero]
        gradient = gradients[at_zero] if heights[0] <= 0 <= heights[-1] else 0.0
        scale = SEA_LEVEL / (pressures[at_zero] * _falls(temperatures[at_zero], gradient, below_zero))
        shells = zip(heights, temperatures, gradients, pressures, strict=False)
        return cls(heights, [_linear(z, t, gradient, p * scale) for z, t, gradient, p in shells], radius)

    @classmethod
    def smooth(cls, index: Index, low: float, high: float, radius: float = EARTH) -> Self:
        """One shell without a kink."""
        return cls([low, high], [index], radius)

    def trace(self, height: float, elevation: float, distances: Sequence[float] = (), farthest: float | None = None):
        """The ray from a height at an elevation angle, to the farthest distance, or to where it leaves the air."""
        if farthest is None:
            farthest = max(distances, default=math.inf)
        ray = Ray(Point(0.0, height, elevation), dict.fromkeys(distances))
        shell = self._shell(height, elevation)
        while shell is not None and ray.end.distance < farthest:
            shell = self._cross(shell, ray, farthest)
        return ray

    def refraction(self, height: float, elevation: float) -> float:
        """Apparent less true altitude of what a ray leads to: by how much it has turned at the end of the air."""
        end = self.trace(height, elevation).end
        return elevation - (end.elevation - end.distance / self.radius)

    def refractivity(self, z: float) -> float:
        """n - 1 at a height within the air."""
        shell = min(max(bisect.bisect_right(self.heights, z) - 1, 0), len(self.indices) - 1)
        return self.indices[shell](z)[0]

    def _turning(self, shell: int, z: float) -> float:
        """dψ/ds of a level ray."""
        refractivity, slope = self.indices[shell](z)
        return 1 / (self.radius + z) + slope / (1 + refractivity)

    def _shell(self, z: float, elevation: float) -> int | None:
        """The shell that a ray at this height goes into."""
        above = bisect.bisect_right(self.heights, z) - 1
        if above >= 0 and z == self.heights[above]:
            # On a boundary: as the ray points, or as it is turned.
            above -= not self._rises(min(above, len(self.indices) - 1), Point(0.0, z, elevation))
        return above if 0 <= above < len(self.indices) else None

    def _cross(self, shell: int, ray: Ray, farthest: float) -> int | None:
        """Follows a ray through a shell, and returns the next one."""
        low, high = self.heights[shell], self.heights[shell + 1]
        radius, index = self.radius, self.indices[shell]

        def equation(_: float, y: Floats):
            _, z, psi = y.tolist()
            refractivity, slope = index(z)
            cosine = math.cos(psi)
            return [cosine / (1 + z / radius), math.sin(psi), cosine * (1 / (radius + z) + slope / (1 + refractivity))]

        start = ray.end
        rises = self._rises(shell, start)
        ahead = _Passing(1, high, 1) if rises else _Passing(1, low, -1)
        ends = [ahead, _Passing(2, 0.0, -1 if rises else 1)]
        if math.isfinite(farthest):
            ends.append(_Passing(0, farthest, 1))
        step = solve_ivp(
            equation, (0.0, 1e9), [start.distance, start.height, start.elevation], method="DOP853", rtol=1e-13,
            atol=[1e-9, 1e-11, 1e-16], events=ends, dense_output=True,
        )  # fmt: skip
        assert step.status == 1, "a ray that never leaves"
        assert step.t_events is not None
        assert step.sol is not None
        way, length, then = step.sol, float(step.t[-1]), shell
        turns = len(step.t_events[1]) > 0
        if len(step.t_events[0]) > 0 or (turns and (way(length)[1] > high or way(length)[1] < low)):
            # Where it turned just beyond the boundary, within the same step, that was not noticed.
            length = brentq(lambda s: ahead(s, way(s)), 0.0, length, xtol=1e-12) if turns else length
            turns, then = False, shell + 1 if rises else shell - 1
        x, z, psi = way(length).tolist()
        for distance in ray.heights:
            if start.distance <= distance <= x:
                ray.heights[distance] = _height_at(way, length, distance)
        ray.points.append(Point(x, z if then == shell else ahead.value, 0.0 if turns else psi))
        return then if 0 <= then < len(self.indices) else None

    def _rises(self, shell: int, at: Point) -> bool:
        """Whether a ray goes up from here, or from a level start is turned up."""
        return at.elevation > 0 or (at.elevation == 0 and self._turning(shell, at.height) > 0)


@dataclass
class Ray:
    start: Point
    heights: dict[float, float | None]
    """At the distances asked for; None where it does not come so far."""
    points: list[Point] = field(default_factory=list)
    """Where it passed from one shell into the next or was level, and its end."""

    @property
    def end(self) -> Point:
        return self.points[-1] if self.points else self.start


@dataclass(frozen=True)
class _Passing:
    """An event of `solve_ivp`, which ends there: a number that passes a value downward (-1) or upward (1)."""

    which: int
    value: float
    direction: float
    terminal: bool = True

    def __call__(self, _: float, y: Floats) -> float:
        return y[self.which] - self.value


def _height_at(solution: Callable[[float], Floats], length: float, distance: float) -> float:
    """The height where a ray, known by its length, has come to a distance: which grows with the length."""
    low, high = 0.0, length
    s = min(length, max(0.0, distance - float(solution(0.0)[0])))
    for _ in range(60):
        x, z, psi = solution(s).tolist()
        if x < distance:
            low = s
        else:
            high = s
        step = (distance - x) * (1 + z / EARTH) / math.cos(psi)
        if abs(step) < 1e-9:
            return z + math.sin(psi) * step
        s = s + step if low < s + step < high else (low + high) / 2
    return float(solution(s)[1])


def _falls(temperature: float, gradient: float, height: float) -> float:
    """The pressure at a height above where the temperature is this, as a share of that there."""
    if gradient == 0:
        return math.exp(-BETA * GRAVITY * height / temperature)
    return (1 + gradient * height / temperature) ** (-BETA * GRAVITY / gradient)


def _linear(bottom: float, temperature: float, gradient: float, pressure: float) -> Index:
    """εβp/T (thesis eq. 2.2) where the temperature grows linearly with height."""

    def index(z: float) -> tuple[float, float]:
        t = temperature + gradient * (z - bottom)
        refractivity = EPSILON * BETA * pressure * _falls(temperature, gradient, z - bottom) / t
        return refractivity, -refractivity * (gradient + BETA * GRAVITY) / t

    return index


STANDARD_PROFILE = [
    (0.0, 15.0), (11_000.0, -56.5), (20_000.0, -56.5), (32_000.0, -44.5), (47_000.0, -2.5), (51_000.0, -2.5),
    (71_000.0, -58.5), (84_852.0, -86.204),
]  # fmt: skip
"""The standard atmosphere of 1976, which is linear between these heights."""

STANDARD = Air.of_profile(STANDARD_PROFILE)
