"""The reference of exact_air.py itself, against what is known of the real atmosphere."""

from __future__ import annotations

import math

import numpy as np
import pytest
from exact_air import BETA, EARTH, EPSILON, GRAVITY, SEA_LEVEL, STANDARD, STANDARD_PROFILE, Air, Point

SECONDS = 180 / math.pi * 3600
MINUTES = 180 / math.pi * 60


def horizon(eye: float) -> Point:
    """Where the ray that grazes the sea reaches an eye, seen from where it grazes."""
    rising = Air([*[z for z in STANDARD.heights if z < eye], eye], STANDARD.indices[:1])
    return rising.trace(0.0, 0.0).end


@pytest.mark.parametrize(
    ("eye", "dip", "kilometres"), [(2, 2.4833, 5.5374), (100, 17.5660, 39.1500), (2800, 93.8181, 206.4617)]
)
def test_the_horizon(eye: float, dip: float, kilometres: float):
    seen = horizon(eye)
    assert seen.elevation * MINUTES == pytest.approx(dip, abs=5e-5)
    assert seen.distance / 1000 == pytest.approx(kilometres, abs=5e-5)


def test_what_the_horizon_hides():
    beyond = 443_000 - horizon(2800).distance
    assert STANDARD.trace(0.0, 0.0, [beyond]).heights[beyond] == pytest.approx(3683, abs=0.5)


def test_the_horizontal_refraction():
    assert STANDARD.refraction(0.0, 0.0) * SECONDS == pytest.approx(1970.2, abs=0.05)
    # At 45 degrees it follows from the index at the eye and the height of air as dense as there, p/(gρ) = T/(gβ).
    refractivity, share = STANDARD.indices[0](0.0)[0], 288.15 / (GRAVITY * BETA) / EARTH
    expected = refractivity * (1 - 2 * share + refractivity / 2)
    assert STANDARD.refraction(0.0, math.radians(45)) == pytest.approx(expected, rel=1e-5)


def test_a_level_ray_from_2_m():
    assert STANDARD.trace(2.0, 0.0, [100_000]).heights[100_000] == pytest.approx(655.4, abs=0.05)


@pytest.mark.parametrize(("temperature", "gradient"), [(0, -0.01), (15, -0.0065), (15, 0.0), (0, 0.05), (0, 0.113)])
def test_the_curvature_near_the_ground(temperature: float, gradient: float):
    """k = 503 p/T² (0.0343 + dT/dz), with p in hPa and T in K, is the share of the earth's curvature that rays have."""
    air = Air.of_profile([(0, temperature), (100, temperature + 100 * gradient)])
    kelvin = temperature + 273.15
    share = 503 * SEA_LEVEL / 100 / kelvin**2 * (0.0343 + gradient)
    refractivity, slope = air.indices[0](0.0)
    assert -EARTH * slope / (1 + refractivity) == pytest.approx(share, rel=0.012)


def test_a_ray_keeps_what_bouguer_says_it_keeps():
    """n r cos ψ is the same all along a ray. The integration knows nothing of that."""
    air = Air.of_profile([(0, 3), (1.8, 4.5), (2.4, 7.5), (5, 10), (20, 11), (400, 8)])
    for minutes in np.linspace(-3, 12, 16):
        ray = air.trace(2.1, minutes / MINUTES, farthest=60_000)
        kept: list[float] = []
        for here in [ray.start, *ray.points]:
            refractivity = air.refractivity(here.height)
            # Less 1, so that the differences keep their digits.
            lowered = -2 * math.sin(here.elevation / 2) ** 2
            kept.append((1 + refractivity) * (1 + here.height / EARTH) * (1 + lowered) - 1)
        np.testing.assert_allclose(kept, kept[0], atol=1e-14)


def test_a_profile_cut_finer_is_the_same_air():
    heights = sorted({*np.linspace(0, 84_000, 40), *(z for z, _ in STANDARD_PROFILE)})
    rows = np.array(STANDARD_PROFILE)
    temperatures: list[float] = np.interp(heights, rows[:, 0], rows[:, 1]).tolist()
    finer = Air.of_profile(list(zip(heights, temperatures, strict=True)))
    one, other = (air.trace(2.0, 0.001, [443_000]).heights[443_000] for air in (STANDARD, finer))
    assert one == pytest.approx(other, abs=1e-5)


def test_air_above_or_below_the_sea_has_the_pressure_of_its_height():
    for profile in ([(-50, 10), (300, 10)], [(100, 10), (300, 10)], [(-300, 10), (-100, 10)]):
        refractivity, _ = Air.of_profile(profile).indices[0](profile[1][0])
        pressure = SEA_LEVEL * math.exp(-BETA * GRAVITY * profile[1][0] / 283.15)
        assert refractivity == pytest.approx(EPSILON * BETA * pressure / 283.15, rel=1e-12)
