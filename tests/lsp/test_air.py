"""What the server says of the air is what the kernel bends rays by; and the server's process never loads the kernel."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

import m3dc
from m3d_lsp.air import EARTH_CURVATURE, Air
from m3d_render import optics

HEIGHTS = st.lists(st.integers(-4000, 90_000), min_size=3, max_size=30, unique=True).map(sorted)
TEMPERATURES = st.lists(st.floats(-80, 60, allow_subnormal=False), min_size=30, max_size=30)


def test_the_earth() -> None:
    assert pytest.approx(optics.EARTH_CURVATURE, rel=1e-15) == EARTH_CURVATURE


@given(HEIGHTS, TEMPERATURES)
def test_every_layer_is_the_kernels(tenths: list[int], temperatures: list[float]) -> None:
    heights = [tenth / 10 for tenth in tenths]
    points = list(zip(heights, temperatures, strict=False))
    profile = " ".join(f"{height!r} {celsius!r}" for height, celsius in points)
    eye = (points[0][0] + points[1][0]) / 2
    scene = f"SCENE {{ VIEW {{ FROM < 0, 0, {eye!r} > }} MIRAGE {{ ELEVATION 1e20 PROFILE {{ {profile} }} }} }}"
    layers = optics.air_layers(m3dc.compile(scene).ir)
    air = Air([height for height, _ in points], [celsius for _, celsius in points])
    assert len(layers.curvature) == len(points) - 1
    for number, (low, high) in enumerate(pairwise(points)):
        layer = air.layer(number)
        assert (layer.bottom, layer.top) == (low[0], high[0]) == (layers.bottom[number], layers.top[number])
        assert layer.gradient == pytest.approx((high[1] - low[1]) / (high[0] - low[0]), rel=1e-9, abs=1e-12)
        assert layer.curvature == pytest.approx(layers.curvature[number], rel=1e-9, abs=1e-18)


@pytest.mark.parametrize(
    ("heights", "temperatures", "says"),
    [([0, 1, 1], [1, 2, 3], "do not increase"), ([0, 1, 2], [1, -273.15, 3], "absolute zero")],
)
def test_what_is_no_profile(heights: list[float], temperatures: list[float], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        Air(heights, temperatures)
