"""Every texture and every parameter of textures, in numbers.

A scene shows one surface under even light, so that a pixel is the surface's colour there; or under one light alone, so
that it is the cosine of the normal's angle to it. The noise is measured through SPOTTED, and everything made of it is
compared with its formula.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache
from typing import Any, NotRequired, TypedDict

import numpy as np
import pytest
from array_types import Floats

import m3d_render
import m3dc
from m3d_language.table import LANGUAGE
from m3d_render import Picture
from m3dc.ir import SceneIR, Triple

BLACK_TO_WHITE = "COLOR < 1, 1, 1 >"
SIZE = 40
FOV = 2 * math.degrees(math.atan(0.1))
"""At a distance of 40, a view of 8 x 8."""
OVERHEAD = "FROM < 0.3, 0.2, 40 > TO < 0.3, 0.2, 0 >"
ASIDE = "FROM < 40, 0.2, 0.3 > TO < 0, 0.2, 0.3 >"

PLATE = "RECTANGLE { VERTEX1 < -9, 9, 0.37 > VERTEX2 < -9, -9, 0.37 > VERTEX3 < 9, -9, 0.37 > }"
BALL = "SPHERE { RADIUS 3 }"
OCTAVES = 6
SHIFT = np.array([0.37, 0.71, 0.53])


def compiled(text: str) -> SceneIR:
    result = m3dc.compile(text)
    assert result.ok, result.diagnostics
    return result.ir


def picture(
    texture: str,
    *,
    shape: str = PLATE,
    view: str = OVERHEAD,
    color: str = "0, 0, 0",
    light: str = "",
    solid: str = "",
    more: str = "",
) -> Picture:
    """The picture of a shape with these textures: under even light, or under the one given alone."""
    ambient = 0 if light else 1
    return m3d_render.render(
        compiled(
            f"""
            SCENE {{
                AMBIENT {{ INTENSITY 1 COLOR < 1, 1, 1 > }} BACKGROUND < 0, 0, 0 >
                VIEW {{ {view} FOV {FOV} WIDTH {SIZE} HEIGHT {SIZE} }}
            }}
            {light} {more}
            SOLID {{
                {shape} {solid}
                SURFACE {{ COLOR < {color} > SPECULAR 0 AMBIENT {ambient} TEXTURE {{ {texture} }} }}
            }}
            """
        )
    )


def value(texture: str, **scene: str) -> Floats:
    """The texture's value t: how much of white there is."""
    return picture(texture, **scene)[..., 0].astype(float)


def rays(view: str = OVERHEAD) -> tuple[np.ndarray, np.ndarray]:
    """The eye, and the directions of the pixels (thesis 3.2)."""
    text = f"SCENE {{ VIEW {{ {view} FOV {FOV} WIDTH {SIZE} HEIGHT {SIZE} }} }} SOLID {{ {BALL} }}"
    said = compiled(text).scene.view
    across = np.linspace(-1, 1, SIZE)
    points = (
        np.array(said.reference_point)
        + across[None, :, None] * np.array(said.right)
        - across[:, None, None] * np.array(said.up)
    )
    directions = points - np.array(said.eye)
    return np.array(said.eye), directions / np.linalg.norm(directions, axis=-1, keepdims=True)


def on_plate(height: float = 0.37) -> Floats:
    """Where the pixels' rays meet the plate."""
    eye, directions = rays()
    return eye + directions * ((height - eye[2]) / directions[..., 2:])


def on_ball(view: str = OVERHEAD, radius: float = 3.0) -> Floats:
    """Where the pixels' rays meet the ball; NaN beside it."""
    eye, directions = rays(view)
    along = -(directions @ eye)
    with np.errstate(invalid="ignore"):
        half = np.sqrt(radius**2 - (eye @ eye - along**2))
    return eye + directions * (along - half)[..., None]


def transform(scale: Iterable[float] = (1.0, 1.0, 1.0), move: Iterable[float] = (0.0, 0.0, 0.0)) -> str:
    """A TRANSFORM whose inverse takes a point P to (P - move) / scale."""
    vectors = ["< " + ", ".join(f"{x:.17g}" for x in vector) + " >" for vector in (scale, move)]
    return f"TRANSFORM {{ SCALE {vectors[0]} TRANSLATE {vectors[1]} }}"


@cache
def noise(
    factors: tuple[float, ...] = (1.0, 1.0, 1.0),
    shift: tuple[float, ...] = (0.0, 0.0, 0.0),
    shape: str = PLATE,
    view: str = OVERHEAD,
) -> Floats:
    """The noise at `factors` times the pixels' points plus `shift`, by inverting the cubic of SPOTTED."""
    scale = 1 / np.array(factors)
    t = value(f"SPOTTED {{ {BLACK_TO_WHITE} {transform(scale, -np.array(shift) * scale)} }}", shape=shape, view=view)
    # 3s² - 2s³ = t has the root s = 1/2 - sin(asin(1 - 2t)/3) in 0..1.
    return 0.5 - np.sin(np.arcsin(1 - 2 * t) / 3)


def octave(i: int, factors: tuple[float, ...] = (1.0, 1.0, 1.0), **scene: str) -> Floats:
    """Signed noise of the i-th octave."""
    return 2 * noise(tuple(2.0**i * np.array(factors)), tuple(i * SHIFT), **scene) - 1


def turbulence(factors: tuple[float, ...] = (1.0, 1.0, 1.0)) -> Floats:
    return np.sum([abs(octave(i, factors)) / 2**i for i in range(OCTAVES)], axis=0)


def fractal(factors: tuple[float, ...] = (1.0, 1.0, 1.0), **scene: str) -> Floats:
    octaves = np.sum([octave(i, factors, **scene) / 2**i for i in range(OCTAVES)], axis=0)
    return octaves / (2 - 2 / 2**OCTAVES)


def squeezed(t: Floats, amount: float) -> Floats:
    return np.maximum(0, 1 - (1 - t) * (1 + amount))


def cubic(s: Floats) -> Floats:
    return s * s * (3 - 2 * s)


def close(found: Floats, expected: Floats, tolerance: float = 2e-4) -> None:
    assert np.ptp(expected) > 0.2, "nothing is to be seen"
    np.testing.assert_allclose(found, expected, atol=tolerance)


# The noise


def test_the_noise_fills_its_range_and_is_smooth():
    values = noise()
    assert values.min() < 0.2
    assert values.max() > 0.8
    assert abs(values.mean() - 0.5) < 0.1
    # 8 units over 40 pixels: the steepest slope of the cubic is 3/2 a unit.
    assert abs(np.diff(values, axis=0)).max() < 1.5 * 8 / (SIZE - 1) + 1e-3


def test_lattice_values_are_those_of_the_table():
    """A picture whose pixels fall on lattice points shows multiples of 1/255."""
    view = "FROM < 0, 0, 40 > TO < 0, 0, 0 >"
    scale = 8 / (SIZE - 1)
    move = (-4, -4, 0)
    flat = PLATE.replace("0.37", "0")
    t = value(f"SPOTTED {{ {BLACK_TO_WHITE} {transform((scale, scale, 1), move)} }}", shape=flat, view=view)
    numbers = 255 * (0.5 - np.sin(np.arcsin(1 - 2 * t) / 3))
    # Near 0 and 1 the cubic is flat and its inverse is not known so well.
    inner = (numbers > 2) & (numbers < 253)
    np.testing.assert_allclose(numbers[inner], np.rint(numbers[inner]), atol=5e-3)
    assert len(np.unique(np.rint(numbers))) > 200


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_the_noise_repeats_after_4096(axis: int):
    def moved(by: float):
        return value(f"SPOTTED {{ {BLACK_TO_WHITE} {transform(move=by * np.eye(3)[axis])} }}")

    np.testing.assert_allclose(moved(4096), moved(0), atol=1e-6)
    np.testing.assert_allclose(moved(-8192), moved(0), atol=1e-6)
    assert abs(moved(2048) - moved(0)).max() > 0.5


# Each texture by its formula


@pytest.mark.parametrize(("amount", "squeeze"), [(0, 0), (0, 2), (0.7, 0), (1.5, 0.5)])
def test_wood(amount: float, squeeze: float):
    t = value(f"WOOD {{ {BLACK_TO_WHITE} TURBULENCE {amount} SQUEEZE {squeeze} }}")
    points = on_plate()
    radius = np.hypot(points[..., 0], points[..., 1]) + amount / 2 * (fractal((1, 1, 1 / 6)) if amount else 0)
    late = squeezed(radius % 1, squeeze)
    expected = np.where(late <= 5 / 6, cubic(late * 6 / 5), cubic((1 - late) * 6))
    # A ring ends steeply: the noise as measured is not as exact as that.
    close(t, expected, 2e-2 if amount else 1e-4)


@pytest.mark.parametrize(("amount", "squeeze"), [(0, 0), (0, 2), (0.3, 0), (1, 1)])
def test_marble(amount: float, squeeze: float):
    t = value(f"MARBLE {{ {BLACK_TO_WHITE} TURBULENCE {amount} SQUEEZE {squeeze} }}")
    y = on_plate()[..., 1] + amount * (turbulence() if amount else 0)
    expected = 0.5 - 0.5 * np.cos(np.pi * squeezed(1 - 2 * abs(y - np.rint(y)), squeeze))
    close(t, expected, 1e-2 if amount else 1e-4)


@pytest.mark.parametrize("scale", [0.4, 1.7, 3])
def test_spotted(scale: float):
    t = value(f"SPOTTED {{ {BLACK_TO_WHITE} SCALE {scale} }}")
    close(t, cubic(np.clip(scale * noise(), 0, 1)), 1e-3)


@pytest.mark.parametrize("amount", [0.5, 1, 3])
def test_granite(amount: float):
    t = value(f"GRANITE {{ {BLACK_TO_WHITE} TURBULENCE {amount} }}")
    close(t, np.clip(amount * turbulence((4, 4, 4)) / 2, 0, 1), 2e-3)


def test_granite_without_turbulence_is_not_there():
    assert value(f"GRANITE {{ {BLACK_TO_WHITE} TURBULENCE 0 }}").max() == 0


@pytest.mark.parametrize(("amount", "squeeze"), [(0, 0), (1, 0), (0.5, 1.5)])
def test_clouds(amount: float, squeeze: float):
    t = value(f"CLOUDS {{ {BLACK_TO_WHITE} TURBULENCE {amount} SQUEEZE {squeeze} }}")
    flat = (1, 1, 3)
    cover = 0.5 + octave(0, flat) + amount * sum(octave(i, flat) / 2**i for i in range(1, OCTAVES))
    close(t, cubic(squeezed(np.clip(cover, 0, 1), squeeze)), 5e-3)


def test_clouds_are_flat():
    """Along z they change three times as fast as along y."""
    wall = "RECTANGLE { VERTEX1 < 0, -9, 9 > VERTEX2 < 0, -9, -9 > VERTEX3 < 0, 9, -9 > }"
    t = value(f"CLOUDS {{ {BLACK_TO_WHITE} TURBULENCE 0 SQUEEZE 0 }}", shape=wall, view=ASIDE)
    across, up = abs(np.diff(t, axis=1)).mean(), abs(np.diff(t, axis=0)).mean()
    assert 2 < up / across < 4


def snow(elevation: float = 0.7, slope: float = 90.0, scale: float = 0.0, amount: float = 0.0, more: str = "") -> str:
    return f"SNOW {{ ELEVATION {elevation} SLOPE {slope} SCALE {scale} TURBULENCE {amount} {more} }}"


@pytest.mark.parametrize(
    ("elevation", "slope", "scale", "amount"),
    [(0.7, 90, 0, 0), (0.55, 30, 0, 0), (0.9, 70, 0.4, 0), (0.7, 80, 0.1, 0.5)],
)
@pytest.mark.parametrize("view", [OVERHEAD, ASIDE])
def test_snow(elevation: float, slope: float, scale: float, amount: float, view: str):
    t = value(snow(elevation, slope, scale, amount), shape=BALL, view=view)
    points = on_ball(view)
    normal_z = points[..., 2] / 3
    line = elevation - scale * (1 - normal_z)
    if amount:
        line = line + amount / 2 * fractal(shape=BALL, view=view)
    share = (points[..., 2] + 3) / 6
    expected = (share >= line) & (normal_z >= math.cos(math.radians(slope)))
    # At the ball's rim the noise was not measured exactly, and at the snow's edge no pixel can be sure.
    sure = (abs(share - line) > 2e-3) & np.isfinite(share)
    assert expected[sure].any()
    assert not expected[sure].all()
    np.testing.assert_array_equal(t[sure] > 0.5, expected[sure])


def test_no_snow_below_its_elevation_nor_on_steep_slopes():
    assert value(snow(0.0), shape=BALL).max() == 1
    assert value(snow(0.0, slope=0.0), shape=BALL).mean() < 0.01
    higher = f"SOLID {{ SPHERE {{ CENTER < 0, 90, 30 > }} SURFACE {{ TEXTURE {{ {snow(0.0)} }} }} }}"
    assert value(snow(0.2), shape=BALL, more=higher).max() == 0
    # A plane does not count among the extents of the scene.
    plane = "SOLID { PLANE { VERTEX1 < 0, 1, -90 > VERTEX2 < 0, 0, -90 > VERTEX3 < 1, 0, -90 > } }"
    np.testing.assert_array_equal(value(snow(), shape=BALL, more=plane) > 0.5, value(snow(), shape=BALL) > 0.5)
    assert value(snow(0.0), shape="PLANE { }").max() == 0


def test_snow_lies_on_the_upper_side_alone():
    view = "FROM < 0, 0, -40 > TO < 0, 0, 0 >"
    above = "SOLID { SPHERE { CENTER < 0, 0, -60 > } }"
    assert value(snow(0.0), more=above).min() == 1
    assert value(snow(0.0), more=above, view=view).max() == 0


def test_snow_keeps_off_bumps_before_it():
    ripples = "RIPPLES { WAVE { CENTER < 0, 0, 0.37 > AMPLITUDE 1 FREQ 2 } }"
    below = "SOLID { SPHERE { CENTER < 0, 0, -60 > } }"
    after = value(ripples + snow(0.0, slope=45.0), more=below)
    assert 0.2 < after.mean() < 0.8
    assert value(snow(0.0, slope=45.0) + ripples, more=below).min() == 1


@pytest.mark.parametrize("amount", [0, 0.5])
def test_gradient(amount: float):
    t = value(f"GRADIENT {{ {BLACK_TO_WHITE} TURBULENCE {amount} }}", shape=BALL, view=ASIDE)
    points = on_ball(ASIDE)
    expected = (points[..., 2] + 3) / 6
    if amount:
        expected = expected + amount / 2 * fractal(shape=BALL, view=ASIDE)
    hit = np.isfinite(expected)
    close(t[hit], np.clip(expected, 0, 1)[hit], 2e-3)


def test_gradient_has_the_colors_of_its_ranges():
    ranges = "0 0.25 < 1, 0, 0 > < 1, 0, 0 > 0.5 0.75 < 0, 1, 0 > < 0, 0, 1 >"
    shown = picture(f"GRADIENT {{ TURBULENCE 0 COLORS {{ {ranges} }} }}", shape=BALL, view=ASIDE, color="1, 1, 1")
    share = (on_ball(ASIDE)[..., 2] + 3) / 6
    np.testing.assert_allclose(shown[share < 0.249], np.broadcast_to([1, 0, 0], shown[share < 0.249].shape))
    gap = ((share > 0.251) & (share < 0.499)) | (share > 0.751)
    np.testing.assert_allclose(shown[gap], 1.0)
    within = (share > 0.501) & (share < 0.749)
    u = 4 * (share[within] - 0.5)
    np.testing.assert_allclose(shown[within], np.stack([0 * u, 1 - u, u], axis=-1), atol=1e-5)


# Normals


LIGHTS = np.array([(0.0, 0.0, 1.0), (0.5, 0.0, 0.9), (0.0, 0.5, 0.9)])


def normals(texture: str, **scene: str) -> Floats:
    """The normals, by the cosines under three lights. No normal may be turned away from one of them."""
    shown: list[Floats] = []
    for direction in LIGHTS:
        toward = ", ".join(str(-x) for x in direction)
        source = f"LIGHT {{ SOURCE {{ INFINITE DIRECTION < {toward} > }} }}"
        shown.append(picture(texture, light=source, color="1, 1, 1", **scene)[..., 0].astype(float))
    units: Floats = LIGHTS / np.linalg.norm(LIGHTS, axis=1, keepdims=True)
    return np.stack(shown, axis=-1) @ np.linalg.inv(units).T


def raised(gradient: Floats) -> Floats:
    """Normals of a horizontal plate raised by a height of this gradient."""
    normal = np.stack([-gradient[..., 0], -gradient[..., 1], np.ones(gradient.shape[:-1])], axis=-1)
    return normal / np.linalg.norm(normal, axis=-1, keepdims=True)


def wave_gradient(
    points: Floats, center: Triple, amplitude: float, freq: float, phase: float = 0.0, damp: float = 0.0
) -> Floats:
    """Of A e^(-damp d) sin d, d = |P - C| freq + phase."""
    away = points - np.array(center)
    r = np.linalg.norm(away, axis=-1, keepdims=True)
    d = r * freq + phase
    return amplitude * np.exp(-damp * d) * (np.cos(d) - damp * np.sin(d)) * freq * away / r


class Wave(TypedDict):
    """What a WAVE says."""

    center: Triple
    amplitude: float
    freq: float
    phase: NotRequired[float]
    damp: NotRequired[float]


WAVES: list[Wave] = [
    {"center": (1.0, -2.0, 0.37), "amplitude": 0.1, "freq": 3.0},
    {"center": (0.0, 0.0, 5.0), "amplitude": 0.15, "freq": 2.0, "phase": 1.3},
    {"center": (-3.0, 1.0, 0.0), "amplitude": 0.3, "freq": 1.5, "phase": 0.4, "damp": 0.1},
]


def wave(center: Triple, amplitude: float, freq: float, phase: float = 0.0, damp: float = 0.0) -> str:
    x, y, z = center
    return f"WAVE {{ CENTER < {x}, {y}, {z} > AMPLITUDE {amplitude} FREQ {freq} PHASE {phase} DAMP {damp} }}"


@pytest.mark.parametrize("chosen", [WAVES[:1], WAVES[1:2], WAVES[2:], WAVES])
@pytest.mark.parametrize("keyword", ["RIPPLES", "WAVES"])
def test_ripples_and_waves_are_the_derivative_of_their_height(chosen: list[Wave], keyword: str):
    found = normals(f"{keyword} {{ {' '.join(wave(**source) for source in chosen)} }}")
    factor = 1.0 if keyword == "RIPPLES" else None
    gradient = sum(
        (wave_gradient(on_plate(), **source) * (factor or 1 / source["freq"]) for source in chosen), np.zeros(3)
    )
    assert np.linalg.norm(gradient, axis=-1).max() > 0.05
    np.testing.assert_allclose(found, raised(gradient), atol=1e-5)


def test_a_texture_that_is_scaled_keeps_its_slopes():
    found = normals(f"RIPPLES {{ {wave(**WAVES[0])} {transform((0.5, 0.5, 0.5))} }}")
    np.testing.assert_allclose(found, raised(wave_gradient(2 * on_plate(), **WAVES[0])), atol=1e-5)
    # Scaled along one axis: the height h(x/2, y) has half the slope along x.
    found = normals(f"RIPPLES {{ {wave(**WAVES[0])} {transform((2, 1, 1))} }}")
    gradient = wave_gradient(on_plate() / np.array([2, 1, 1]), **WAVES[0]) / np.array([2, 1, 1])
    np.testing.assert_allclose(found, raised(gradient), atol=1e-5)


def test_waves_without_a_source_are_not_there():
    np.testing.assert_allclose(normals("WAVES { }")[..., 2], 1, atol=1e-6)


def test_a_ball_ripples_all_around():
    """The normal loses what of the slope is along it."""
    found = normals(f"RIPPLES {{ {wave((0, 0, 9), 0.05, 4)} }}", shape=BALL)
    points = on_ball()
    outward = points / 3
    gradient = wave_gradient(points, (0, 0, 9), 0.05, 4)
    expected = outward - gradient + (gradient * outward).sum(-1, keepdims=True) * outward
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    top = (outward[..., 2] > 0.8) & (expected[..., 2] > 0.8)
    assert top.sum() > 200
    np.testing.assert_allclose(found[top], expected[top], atol=1e-5)


def bump_height(scale: float, squeeze: float, amount: float, dx: float, dy: float) -> Floats:
    """h = SCALE t² / (1 + SQUEEZE), at the pixels' points moved a little."""
    n = noise(shift=(dx, dy, 0))
    for i in range(1, 4):
        shift = i * SHIFT + 2**i * np.array([dx, dy, 0])
        n = n + amount * (noise((2.0**i,) * 3, tuple(shift)) - 0.5) / 4**i
    return scale * squeezed(n, squeeze) ** 2 / (1 + squeeze)


@pytest.mark.parametrize(("scale", "squeeze", "amount"), [(0.3, 0, 0), (0.2, 0, 1), (0.2, 1, 0.5)])
def test_bumps_are_the_derivative_of_their_height(scale: float, squeeze: float, amount: float):
    found = normals(f"BUMPS {{ SCALE {scale} SQUEEZE {squeeze} TURBULENCE {amount} }}")
    step = 5e-3
    along_x = bump_height(scale, squeeze, amount, step, 0) - bump_height(scale, squeeze, amount, -step, 0)
    along_y = bump_height(scale, squeeze, amount, 0, step) - bump_height(scale, squeeze, amount, 0, -step)
    gradient = np.stack([along_x, along_y], axis=-1) / (2 * step)
    assert abs(gradient).max() > 0.1
    assert np.quantile(abs(found - raised(gradient)), 0.99) < 5e-3


def test_bumps_are_painted_by_height():
    ranges = "0.5 1 < 1, 1, 1 > < 1, 1, 1 >"
    painted = value(f"BUMPS {{ SQUEEZE 0 TURBULENCE 0 COLORS {{ {ranges} }} }}")
    sure = abs(noise() - 0.5) > 1e-3
    np.testing.assert_array_equal(painted[sure] > 0.5, noise()[sure] > 0.5)
    assert value("BUMPS { COLOR < 1, 1, 1 > }").max() == 0


def test_a_mirror_ray_is_not_thrown_into_the_surface():
    """Seen at a grazing angle, waves on a mirror show what is above it, never what is below."""
    scene = """
        SCENE {{
            AMBIENT {{ INTENSITY 0 }} BACKGROUND < 0, 0, 1 >
            VIEW {{ FROM < 40, 0, 2 > TO < 0, 0, 0 > FOV 4 WIDTH 40 HEIGHT 40 }}
        }}
        SOLID {{ PLANE {{ }} SURFACE {{ SPECULAR 1 HARD 1 TEXTURE {{ {texture} }} }} }}
        SOLID {{ RECTANGLE {{ VERTEX1 < -900, 900, -9 > VERTEX2 < -900, -900, -9 > VERTEX3 < 900, -900, -9 > }}
                 SURFACE {{ COLOR < 1, 0, 0 > AMBIENT 1 }} }}
        LIGHT {{ SOURCE {{ INFINITE DIRECTION < 0, 0, 1 > }} }}
    """
    for texture in ("BUMPS { SCALE 3 }", f"RIPPLES {{ {wave((0, 0, 0), 0.3, 2)} }}"):
        shown = m3d_render.render(compiled(scene.format(texture=texture)))
        assert shown[..., 0].max() == 0
        assert shown[..., 2].min() == 1


# What all textures share


COLORED = ["WOOD", "MARBLE", "SPOTTED", "GRANITE", "CLOUDS"]


@pytest.mark.parametrize("keyword", COLORED)
def test_colors_are_looked_up_by_the_value_and_gaps_keep_the_surface(keyword: str):
    t = value(f"{keyword} {{ {BLACK_TO_WHITE} }}")
    ranges = "0 0.2 < 1, 0, 0 > < 0, 1, 0 > 0.4 0.6 < 0, 0, 1 > < 0, 1, 1 >"
    shown = picture(f"{keyword} {{ COLORS {{ {ranges} }} }}", color="0.5, 0.5, 0.5")
    u, v = t / 0.2, (t - 0.4) / 0.2
    expected = np.full((*t.shape, 3), 0.5)
    first, second = t < 0.2, (t >= 0.4) & (t < 0.6)
    expected[first] = np.stack([1 - u, u, 0 * u], axis=-1)[first]
    expected[second] = np.stack([0 * v, v, 0 * v + 1], axis=-1)[second]
    sure = (abs(t[..., None] - [0.2, 0.4, 0.6]) > 1e-6).all(axis=-1)
    assert first.any()
    assert second.any()
    assert not (first | second).all()
    np.testing.assert_allclose(shown[sure], expected[sure], atol=1e-5)


def test_the_last_range_holds_its_end_if_that_is_one():
    full = "SPOTTED { SCALE 1000000 COLORS { 0 0.5 < 0, 1, 0 > < 0, 1, 0 > 0.5 %s < 1, 0, 0 > < 1, 0, 0 > } }"
    np.testing.assert_array_equal(picture(full % 1, color="0, 0, 1")[3, 3], [1, 0, 0])
    np.testing.assert_array_equal(picture(full % 0.99, color="0, 0, 1")[3, 3], [0, 0, 1])


def test_textures_apply_in_order():
    checker, spotted = "CHECKER { COLOR < 1, 0, 0 > }", "SPOTTED { COLOR < 0, 0, 1 > }"
    board, spots = picture(checker)[..., 0], picture(spotted)[..., 2]
    both = picture(checker + spotted)
    np.testing.assert_allclose(both[..., 2], spots, atol=1e-6)
    np.testing.assert_allclose(both[..., 0], board * (1 - spots), atol=1e-6)
    np.testing.assert_allclose(picture(spotted + checker)[..., 2], spots * (1 - board), atol=1e-6)


def test_normal_textures_add_up():
    first, second = (f"RIPPLES {{ {wave(**source)} }}" for source in WAVES[:2])
    together = normals(first + second)
    assert abs(together - normals(first)).max() > 0.05
    assert abs(together - normals(second)).max() > 0.05


SPACE = ["WOOD", "MARBLE", "SPOTTED", "GRANITE", "CLOUDS", "CHECKER", "BUMPS", "WAVES", "RIPPLES"]
SUN = "LIGHT { SOURCE { INFINITE DIRECTION < -0.4, -0.5, -1 > } }"


def body(keyword: str) -> str:
    """Statements that make a texture visible."""
    if keyword in ("WAVES", "RIPPLES"):
        return wave((0.5, 0.5, 0.0), 0.2, 2.0)
    return {"BUMPS": "SCALE 0.5", "SNOW": "ELEVATION 0.7 SLOPE 85 SCALE 0.1", "GRADIENT": BLACK_TO_WHITE}.get(
        keyword, BLACK_TO_WHITE
    )


def look(keyword: str, statements: str, **scene: str) -> Picture:
    if keyword in ("BUMPS", "WAVES", "RIPPLES"):
        scene = {"light": SUN, "color": "0.8, 0.7, 0.6", **scene}
    return picture(f"{keyword} {{ {statements} }}", **scene)


@pytest.mark.parametrize("keyword", SPACE)
def test_local_textures_track_their_object(keyword: str):
    moved = OVERHEAD.replace("0.3, 0.2", "7.64, -5.21")
    solid = "TRANSFORM { TRANSLATE < 7.34, -5.41, 0 > }"
    here = look(keyword, f"LOCAL {body(keyword)}")
    tracked = look(keyword, f"LOCAL {body(keyword)}", solid=solid, view=moved)
    assert np.quantile(abs(tracked - here), 0.99) < 1e-4
    # In the scene, the texture stays where it is, with or without LOCAL where the object has not moved.
    np.testing.assert_array_equal(look(keyword, body(keyword)), here)
    assert abs(look(keyword, body(keyword), solid=solid, view=moved) - here).max() > 0.05


@pytest.mark.parametrize("keyword", ["SNOW", "GRADIENT"])
def test_local_and_transform_move_the_randomness_of_what_goes_by_elevation(keyword: str):
    def ball(statements: str, solid: str = ""):
        return picture(f"{keyword} {{ {body(keyword)} {statements} }}", shape=BALL, view=ASIDE, solid=solid)

    quarter = "TRANSFORM { ROTX 90 }"
    plain = ball("TURBULENCE 0")
    np.testing.assert_allclose(ball("TURBULENCE 0 LOCAL", quarter), plain, atol=1e-6)
    np.testing.assert_array_equal(ball("TURBULENCE 0 TRANSFORM { SCALE < 3, 3, 3 > TRANSZ 9 }"), plain)
    rough = ball("TURBULENCE 0.5")
    assert abs(rough - plain).max() > 0.1
    assert abs(ball("TURBULENCE 0.5 LOCAL", quarter) - rough).max() > 0.1
    assert abs(ball("TURBULENCE 0.5 TRANSFORM { TRANSZ 9 }") - rough).max() > 0.1


@pytest.mark.parametrize("keyword", SPACE)
def test_a_transform_takes_the_texture_along(keyword: str):
    """Turned by a quarter about z, a texture is what it was, seen from an eye turned alike."""
    there = "FROM < 0.001, 0, 40 > TO < 0, 0, 0 >"
    turned = "FROM < 0, 0.001, 40 > TO < 0, 0, 0 >"
    sun = SUN.replace("-0.4, -0.5", "0, 0")
    scene = {"light": sun} if keyword in ("BUMPS", "WAVES", "RIPPLES") else {}
    before = look(keyword, body(keyword), view=there, **scene)
    after = look(keyword, f"{body(keyword)} TRANSFORM {{ ROTZ 90 }}", view=turned, **scene)
    assert np.quantile(abs(before - after), 0.99) < 1e-4
    assert abs(look(keyword, f"{body(keyword)} TRANSFORM {{ ROTZ 90 }}", view=there, **scene) - before).max() > 0.01


PARAMETERS = {
    "LOCAL": ("", "LOCAL"),
    "COLOR": ("COLOR < 0.9, 0.2, 0.1 >", "COLOR < 0.1, 0.2, 0.9 >"),
    "COLORS": ("", "COLORS { 0 0.5 < 1, 0, 0 > < 0, 1, 0 > 0.5 1 < 0, 0, 1 > < 1, 1, 0 > }"),
    "TURBULENCE": ("TURBULENCE 0.2", "TURBULENCE 0.6"),
    "SQUEEZE": ("SQUEEZE 0", "SQUEEZE 1.5"),
    "SCALE": ("SCALE 0.2", "SCALE 0.7"),
    "SLOPE": ("SLOPE 30", "SLOPE 60"),
    "ELEVATION": ("ELEVATION 0.6", "ELEVATION 0.8"),
    "TRANSFORM": ("", "TRANSFORM { SCALE < 0.6, 0.7, 0.8 > TRANSX 0.4 }"),
    "WAVE": ("", wave(**WAVES[0])),
}
SILENT = {("BUMPS", "COLOR")}
"""What the language has and nothing says what it does: docs/decisions.md."""


@pytest.mark.parametrize(
    ("keyword", "statement"),
    [
        (keyword, statement)
        for keyword in LANGUAGE.blocks["TEXTURE"].holds
        for statement in LANGUAGE.blocks[keyword].uses
        if (keyword, statement) not in SILENT
    ],
)
def test_every_statement_changes_the_picture(keyword: str, statement: str):
    rest = "" if statement == "WAVE" else body(keyword)
    scene = {"shape": BALL, "view": "FROM < 28, 0, 28 > TO < 0, 0, 0 >", "solid": "TRANSFORM { ROTX 70 ROTZ 40 }"}
    without, with_it = (look(keyword, f"{rest} {text}", **scene) for text in PARAMETERS[statement])
    assert np.count_nonzero(abs(without - with_it).max(axis=-1) > 0.02) > 10


# Input that makes no sense


@pytest.mark.parametrize("amount", ["-1e300", "-3", "0", "1e18", "1e300"])
@pytest.mark.parametrize("keyword", LANGUAGE.blocks["TEXTURE"].holds)
def test_wild_amounts_are_survived(keyword: str, amount: str):
    uses = LANGUAGE.blocks[keyword].uses
    statements = " ".join(
        f"{name} {amount}" for name in ("TURBULENCE", "SQUEEZE", "SCALE", "ELEVATION") if name in uses
    )
    if "WAVE" in uses:
        statements = f"WAVE {{ AMPLITUDE {amount} FREQ {amount} PHASE {amount} DAMP {amount} }}"
    far = f"TRANSFORM {{ TRANSLATE < {amount}, 0, {amount} > }}" if "TRANSFORM" in uses else ""
    text = f"""
        SCENE {{ VIEW {{ {OVERHEAD} WIDTH 9 HEIGHT 9 }} }} {SUN}
        SOLID {{ {BALL} SURFACE {{ TEXTURE {{ {keyword} {{ {statements} {far} }} }} }} }}
    """
    shown = m3d_render.render(m3dc.compile(text).ir)
    assert np.all((shown >= 0) & (shown <= 1))


# Surfaces in a step


FLOOR = "PLANE { VERTEX1 < 0, 1, 0 > VERTEX2 < 0, 0, 0 > VERTEX3 < 1, 0, 0 > }"
AIR = "MIRAGE { DISTANCE 300 PROFILE { -1 5 0.5 6 2 9 30 8 } }"
GRAZING = "FROM < 30.1, 0.2, 1.3 > TO < 0.3, 0.4, 0 >"
TURN = "ROTATE < 31, 47, -123 > TRANSLATE < 3.3, -1.7, 0.9 >"
PAINT = "CHECKER { COLOR < 1, 1, 1 > %s }"


def checkered(
    texture: str,
    *,
    shape: str = FLOOR,
    view: str = GRAZING,
    scene: str = "",
    solid: str = "",
    more: str = "",
    samples: int = 1,
) -> Picture:
    """Where a floor has the texture's colour, if none of it is speckled."""
    text = f"""
        SCENE {{
            AMBIENT {{ INTENSITY 1 COLOR < 1, 1, 1 > }} BACKGROUND < 0.5, 0.5, 0.5 > DEPTH 4 {scene}
            VIEW {{ {view} FOV 20 WIDTH 90 HEIGHT 60 }}
        }}
        {more}
        SOLID {{
            {shape} {solid}
            SURFACE {{ COLOR < 0, 0, 0 > SPECULAR 0 AMBIENT 1 TEXTURE {{ {texture} }} }}
        }}
        """
    return m3d_render.render(compiled(text), samples=samples, refract_reflections=True)


MIRROR = """SOLID { SPHERE { CENTER < 0, 0, 2 > RADIUS 2 }
    SURFACE { SPECULAR 1 HARD 1 AMBIENT 0 COLOR < 0, 0, 0 > } }"""


@pytest.mark.parametrize(
    "scene",
    [
        {},
        {"view": "FROM < 3000.1, 0.2, 400.3 > TO < 0.3, 0.4, 0 >"},
        {"scene": AIR},
        {"more": MIRROR},
        {"scene": AIR, "more": MIRROR},
        {"shape": "RECTANGLE { VERTEX1 < -9, 9, 0 > VERTEX2 < -9, -9, 0 > VERTEX3 < 9, -9, 0 > }"},
        {"shape": "TRIANGLE { VERTEX1 < -9, 9, 0 > VERTEX2 < -9, -9, 0 > VERTEX3 < 9, -9, 0 > }", "scene": AIR},
        {"shape": "POLYGONS { VERTICES { 3 < -9, 9, 0 > < -9, -9, 0 > < 9, -9, 0 > } FACETS { 1 0 1 2 } }"},
        {"samples": 3},
    ],
)
def test_a_floor_between_two_layers_of_cubes_is_of_the_upper_one(scene: dict[str, Any]):
    """As if the cubes were let down by half a cube."""
    found = checkered(PAINT % "", **scene)
    lower = checkered(PAINT % "TRANSFORM { TRANSZ -0.5 }", **scene)
    assert 0.2 < found.mean() < 0.8
    np.testing.assert_array_equal(found, lower)
    other = checkered(PAINT % "TRANSFORM { TRANSZ 0.5 }", **scene)
    assert (found != other).any()


@pytest.mark.parametrize("scene", [{}, {"scene": AIR}, {"more": MIRROR}])
@pytest.mark.parametrize("step", ["", "TRANSLATE < 0, 0, 7 >", "SCALE < 0.3, 2, 0.7 >"])
def test_the_same_of_cubes_that_are_turned_with_the_floor(scene: dict[str, Any], step: str):
    local = f"LOCAL TRANSFORM {{ {step} %s }}"
    solid = f"TRANSFORM {{ {TURN} }}"
    view = "FROM < 22, 9, 14 > TO < 3.4, -1.6, 0.95 >"
    for where, turned in (("LOCAL", solid), ("", solid), ("", "")):
        texture = local if where else f"TRANSFORM {{ {step} %s {TURN if turned else ''} }}"
        found = checkered(PAINT % (texture % ""), view=view, solid=turned, **scene)
        lower = checkered(PAINT % (texture % "TRANSZ -0.35"), view=view, solid=turned, **scene)
        # A floor turned about a far point may be off by what its corners are rounded to, along its edges alone.
        assert (found != lower).any(axis=-1).mean() < 0.002, (where, turned)


RANGES = "COLORS { 0 0.5 < 1, 0, 0 > < 1, 0, 0 > 0.5 1 < 0, 0, 1 > < 0, 0, 1 > }"


@pytest.mark.parametrize(
    ("texture", "color"),
    [
        (f"MARBLE {{ TURBULENCE 0 SQUEEZE 0 {RANGES} }}", (0, 0, 1)),
        (f"GRADIENT {{ TURBULENCE 0 {RANGES} }}", (0, 0, 1)),
        ("SNOW { TURBULENCE 0 SCALE 0 ELEVATION 0.5 COLOR < 0, 1, 0 > }", (0, 1, 0)),
        ("SNOW { TURBULENCE 0 SCALE 0 ELEVATION 0.5 SLOPE 0 COLOR < 0, 1, 0 > }", (0, 1, 0)),
    ],
)
@pytest.mark.parametrize("scene", [{}, {"scene": AIR}])
def test_a_floor_at_a_step_of_any_texture_is_of_one_colour(texture: str, color: Triple, scene: dict[str, Any]):
    """At y = 0.25 of MARBLE, and half the scene's height of the others, which go by elevation: it is 0 to 0.2."""
    if "MARBLE" in texture:
        texture = texture.replace("{", "{ TRANSFORM { ROTX 90 TRANSZ -0.15 }", 1)
    floor = "RECTANGLE { VERTEX1 < -90, 90, 0.1 > VERTEX2 < -90, -90, 0.1 > VERTEX3 < 90, -90, 0.1 > }"
    ends = " ".join(f"SOLID {{ SPHERE {{ CENTER < -900, 0, {z} > RADIUS 0.01 }} }}" for z in (0.01, 0.19))
    found = checkered(texture, shape=floor, view="FROM < 30.1, 0.2, 9.3 > TO < 0.3, 0.4, 0 >", more=ends, **scene)
    np.testing.assert_allclose(found, np.broadcast_to(color, found.shape))
