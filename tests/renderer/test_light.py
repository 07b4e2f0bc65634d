"""Light: sampled ambient light, FUZZ, what lights may be told, and mirrors in air that bends light."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any, Unpack

import numpy as np
import pytest
from scene_builder import BLACK, MERMAN_PROFILE, WHITE, Profile, SceneBuilder, from_sun

import m3d_render
from m3d_render import Picture, RenderOptions
from m3dc.ir import Ambient, LightKind, Triple, m3ir

AXIS, DIAGONAL = 0.515594, 0.490719
"""Mean of N.D over the thesis's random directions, for a normal along an axis of space and along a diagonal."""


def render(scene: SceneBuilder, **options: Unpack[RenderOptions]) -> Picture:
    return m3d_render.render(scene.build(), **options)


def middle(picture: Picture):
    return picture[picture.shape[0] // 2, picture.shape[1] // 2]


def sampled(samples: int, depth: int = 2, constant: float = 0.0):
    return Ambient(constant, WHITE, samples, depth)


def test_the_mean_cosine_of_the_random_directions():
    n = 200
    x, y, z = np.meshgrid(*[(np.arange(n) + 0.5) / n] * 3, indexing="ij")
    r = np.sqrt(x * x + y * y + z * z)
    signs = np.array(list(itertools.product([1, -1], repeat=2)))
    assert abs((z / r).mean() - AXIS) < 2e-5
    along_diagonal = np.mean([np.abs(z + a * x + b * y) / r for a, b in signs]) / math.sqrt(3)
    assert abs(along_diagonal - DIAGONAL) < 2e-5


# Furnaces


def test_a_white_sphere_in_constant_light_is_that_light():
    scene = SceneBuilder((10, 0, 0), (0, 0, 0), 14, 41, 41).set(ambient=Ambient(0.7, WHITE, 0, 0))
    scene.set(background=(0.7, 0.7, 0.7))
    scene.sphere((0, 0, 0), 1, scene.solid(ambient=1.0))
    np.testing.assert_allclose(render(scene), 0.7, rtol=1e-6)


@pytest.mark.parametrize(("toward", "factor"), [((10, 0, 0), AXIS), ((6, 6, 6), DIAGONAL)])
def test_sampled_light_converges_to_the_mean_cosine(toward: Triple, factor: float):
    """A disc of the sphere that looks along one direction, in a sky of 0.8 and white diffuse by three quarters."""
    scene = SceneBuilder(toward, (0, 0, 0), 0.5, 9, 9).set(ambient=sampled(4000), background=(0.8, 0.4, 0.2))
    scene.sphere((0, 0, 0), 1, scene.solid(specular=0.25, rough=0.0, hard=0.0, color=(1, 1, 0.5)))
    expected = np.array([0.8, 0.4, 0.1]) * 0.75 * factor
    picture = render(scene).reshape(-1, 3)
    assert len(np.unique(picture[:, 0])) > 40  # each pixel has its own directions
    np.testing.assert_allclose(picture.mean(axis=0), expected, rtol=2e-3)
    # The deviation of a mean of 4000 cosines, whose own is 0.29.
    assert 0.5 < picture[:, 0].std() / (0.8 * 0.75 * 0.29 / math.sqrt(4000)) < 1.5


def test_sampled_light_does_not_heed_the_surfaces_ambient_reflectance():
    def patch(**surface: Any):
        scene = SceneBuilder((10, 0, 0), (0, 0, 0), 1, 5, 5).set(ambient=sampled(16), background=WHITE)
        scene.sphere((0, 0, 0), 1, scene.solid(**surface))
        return render(scene)

    np.testing.assert_array_equal(patch(ambient=0.0), patch(ambient=1.0))


@pytest.mark.parametrize("samples", [1, 8])
def test_below_the_depth_the_constant_stands_for_sampled_light(samples: int):
    """Inside a closed box of surfaces that glow by constant ambient light alone each level adds its share."""

    def seen(depth: int):
        scene = SceneBuilder((0, 0, 0), (1, 0, 0), 20, 21, 21).set(ambient=sampled(samples, depth, 0.5))
        scene.sphere((0, 0, 0), 5, scene.solid(color=(0.8, 0.8, 0.8), ambient=1.0))
        return render(scene).mean()

    constant = 0.5 * 0.8
    assert seen(0) == seen(1) == pytest.approx(constant)
    # A sphere's inside has normals of all directions: over all the directions the mean cosine is a half.
    assert seen(2) == pytest.approx(constant * 0.8 * AXIS, rel=0.1)
    assert seen(3) == pytest.approx(constant * (0.8 * AXIS) * (0.8 * 0.5), rel=0.15)


def test_a_closed_room_sampled_without_end_still_ends():
    scene = SceneBuilder((0, 0, 0), (1, 0, 0), 20, 2, 2).set(ambient=sampled(1, 1_000_000_000, 0.5))
    scene.sphere((0, 0, 0), 5, scene.solid(color=WHITE, ambient=1.0))
    picture = render(scene)
    assert np.all((picture >= 0) & (picture <= 1))


def test_sample_rays_are_blocked_and_coloured_by_what_they_meet():
    def ground(wall_color: Triple | None):
        scene = SceneBuilder((0, 0, 10), (0.001, 0, 0), 1, 15, 15)
        scene.set(ambient=sampled(256, 2, 1.0), background=(0.5, 0.5, 0.5))
        scene.plane(((1, 0, 0), (0, 0, 0), (0, 1, 0)), scene.solid(ambient=1.0))
        if wall_color is not None:
            wall = scene.solid(color=wall_color, ambient=1.0)
            scene.rectangle(((0.5, -9, 9), (0.5, -9, 0), (0.5, 9, 0)), wall)
        return render(scene).mean(axis=(0, 1))

    open_sky, red, black = ground(None), ground((1, 0, 0)), ground(BLACK)
    np.testing.assert_allclose(open_sky, 0.5 * AXIS, rtol=0.01)
    assert np.all(black < 0.75 * open_sky)
    assert red[0] > 1.05 * open_sky[0]
    np.testing.assert_allclose(red[1:], black[1:], rtol=1e-6)


def test_sample_rays_do_not_see_lights():
    def sphere(lamp: bool):
        scene = SceneBuilder((10, 0, 0), (0, 0, 0), 1, 9, 9).set(ambient=sampled(64), background=(0.2, 0.2, 0.2))
        scene.sphere((0, 0, 0), 1, scene.solid())
        if lamp:
            bulb = scene.light(kind=LightKind.POINT, position=(50, 0, 0), direction=(1, 0, 0), exponent=1.0)
            scene.sphere((30, 0, 0), 15, bulb)
        return render(scene)

    np.testing.assert_array_equal(sphere(lamp=True), sphere(lamp=False))


def test_a_sky_sampled_all_around_a_white_wall():
    """Against the same integral of the CIE sky by a grid of directions of the cube."""
    scene = SceneBuilder((10, 0, 0.001), (0, 0, 0), 1, 9, 9).set(ambient=sampled(4000))
    scene.sky(0, 0, intensity=0.9, zenith_color=(0.2, 0.4, 0.8), horizon_color=(0.9, 0.8, 0.7), overcast=1.0)
    scene.rows["lights"][0]["intensity"] = 0.0
    scene.rectangle(((0, -2, 2), (0, -2, -2), (0, 2, -2)), scene.solid())
    n = 120
    grid = (np.arange(n) + 0.5) / n * 2 - 1
    x, y, z = np.meshgrid(np.abs(grid), grid, grid, indexing="ij")
    r = np.sqrt(x * x + y * y + z * z)
    sine = np.abs(z) / r
    share = np.arcsin(sine) / (math.pi / 2)
    luminance = 0.9 * (1 + 2 * sine) / 3
    colors = zip((0.2, 0.4, 0.8), (0.9, 0.8, 0.7), strict=True)
    expected = [(x / r * luminance * ((1 - share) * low + share * high)).mean() for high, low in colors]
    np.testing.assert_allclose(render(scene).mean(axis=(0, 1)), expected, rtol=5e-3)


def test_sampled_light_is_the_same_however_the_work_is_divided():
    scene = SceneBuilder((10, 0, 2), (0, 0, 0), 30, 40, 30).set(ambient=sampled(4, 3, 0.3), background=WHITE)
    scene.sphere((0, 0, 1), 1, scene.solid(color=(1, 0.5, 0.2), fuzz=0.3, specular=0.5, hard=0.5, rough=0.3))
    scene.plane(((1, 0, 0), (0, 0, 0), (0, 1, 0)), scene.solid(color=(0.5, 0.8, 0.5)))
    scene.light(direction=(-0.5, 0.3, -0.8))
    whole = render(scene, threads=1)
    assert render(scene, threads=3).tobytes() == whole.tobytes()
    assert render(scene, region=(5, 7, 20, 31)).tobytes() == whole[5:21, 7:32].tobytes()


# FUZZ


def test_fuzz_deviates_normals_more_the_larger_it_is():
    def lit(fuzz: float):
        scene = SceneBuilder((10, 0, 0), (0, 0, 0), 4, 61, 61).set(ambient=Ambient(0.0, WHITE, 0, 0))
        scene.light(direction=(-1, 0, 0))
        scene.rectangle(((0, -9, 9), (0, -9, -9), (0, 9, -9)), scene.solid(fuzz=fuzz))
        return render(scene)[..., 0]

    np.testing.assert_allclose(lit(0.0), 1.0, rtol=1e-3)
    deviations = [lit(fuzz).std() for fuzz in (0.05, 0.2, 0.5, 1.0)]
    assert deviations == sorted(deviations)
    assert deviations[0] < 0.01
    # N' = (1 + a, b, c)/|...| with a, b and c within ± fuzz: the mean cosine, by the same numbers on a grid.
    for fuzz in (0.2, 0.7):
        a, b, c = np.meshgrid(*[((np.arange(80) + 0.5) / 40 - 1) * fuzz] * 3, indexing="ij")
        expected = ((1 + a) / np.sqrt((1 + a) ** 2 + b**2 + c**2)).mean()
        assert lit(fuzz).mean() == pytest.approx(expected, rel=0.01)


def test_fuzz_blurs_a_mirror():
    def seen(fuzz: float):
        scene = SceneBuilder((10, 0, 0), (0, 0, 0), 40, 61, 61).set(ambient=Ambient(0.0, WHITE, 0, 0), depth=2)
        scene.plane(((0, 0, 1), (0, 0, 0), (0, 1, 0)), scene.solid(specular=1.0, hard=1.0, rough=0.0, fuzz=fuzz))
        scene.sky(0, 0, overcast=1.0)
        scene.rows["lights"][0]["intensity"] = 0.0
        picture = render(scene)[..., 2]
        return np.abs(np.diff(picture, axis=1)).mean()

    assert seen(0.0) < 0.002 < 0.02 < seen(0.3)


# Lights


def lit_sphere(**light: Any):
    scene = SceneBuilder((10, 0, 0), (0, 0, 0), 14, 41, 41).set(ambient=Ambient(0.0, WHITE, 0, 0))
    scene.light(direction=(-1, 0.3, -0.5), **light)
    scene.sphere((0, 0, 0), 1, scene.solid(color=(0.5, 0.1, 0.1), specular=0.6, rough=0.2, hard=0.0))
    scene.sphere((3, -0.9, 1.5), 0.5, scene.solid(color=(0, 1, 0)))
    return scene


def test_nospecular_takes_the_highlight_and_nothing_else():
    with_it, without = (render(lit_sphere(highlights=on)) for on in (True, False))
    assert np.all(with_it >= without)
    assert (with_it - without).max() > 0.3
    assert without[..., 0].max() <= 0.5 * 0.4 + 1e-6  # k_d O_d


def test_noshadows_lights_what_is_behind_something():
    plain = render(lit_sphere(), shadows=False)
    np.testing.assert_array_equal(render(lit_sphere(shadows=False), shadows=True), plain)
    assert not np.array_equal(render(lit_sphere(), shadows=True), plain)


def test_an_overcast_sky_does_not_dim_the_sun():
    def ground(overcast: float):
        scene = SceneBuilder((0, 0, 10), (0.001, 0, 0), 5, 3, 3).set(ambient=Ambient(0.0, WHITE, 0, 0))
        scene.sky(30, 40, overcast=overcast)
        scene.plane(((1, 0, 0), (0, 0, 0), (0, 1, 0)), scene.solid())
        return render(scene)

    np.testing.assert_allclose(ground(1.0), math.cos(math.radians(40)), rtol=1e-3)
    np.testing.assert_array_equal(ground(0.0), ground(1.0))


@pytest.mark.parametrize("rough", [0.1, 0.3, 0.7, 1.0])
def test_a_highlight_adds_no_more_light_than_there_is(rough: float):
    """k_s O_s (N.L) of a white light, from all sides: the facet term is at most one, its divisor keeps the rest."""
    worst = 0.0
    for zenith in (0, 30, 60, 85):
        scene = SceneBuilder((0, 0, 10), (0.001, 0, 0), 50, 31, 31).set(ambient=Ambient(0.0, WHITE, 0, 0))
        scene.light(direction=from_sun(0, zenith))
        surface = {"specular": 1.0, "rough": rough, "hard": 0.0, "ambient": 0.0, "color": BLACK}
        scene.plane(((1, 0, 0), (0, 0, 0), (0, 1, 0)), scene.solid(**surface))
        worst = max(worst, render(scene, normalize=False).max())
    assert worst <= 1.0


# Mirrors in bent light


def mirage_mirror(profile: Profile, height: float = 0.0):
    """A mirror as ground under the merman's eye, a wall far away."""
    scene = SceneBuilder((500, 0, 2.1), (0, 0, 0.0), 2.0, 24, 90).set(ambient=Ambient(1.0, WHITE, 0, 0), depth=2)
    scene.mirage(profile, segments=400)
    mirror = scene.solid(specular=1.0, hard=1.0, rough=0.0, ambient=0.0)
    scene.plane(((0, 0, height), (0, 1, height), (-1, 0, height)), mirror)
    for z in range(16):
        stripe = scene.solid(color=(1.0, (z + 1) / 16, 0), ambient=1.0)
        scene.rectangle(((-900, -99, z + 1), (-900, -99, z), (-900, 99, z)), stripe)
    return scene


def test_reflections_are_refracted_only_if_asked():
    scene = mirage_mirror(MERMAN_PROFILE)
    plain, bent = render(scene), render(scene, refract_reflections=True)
    assert not np.array_equal(plain, bent)
    asked, not_asked = (render(scene, straight=True, refract_reflections=on) for on in (True, False))
    np.testing.assert_array_equal(asked, not_asked)


def test_the_scene_may_ask_for_refracted_reflections(tmp_path: Path):
    scene = mirage_mirror(MERMAN_PROFILE)
    plain, bent = render(scene), render(scene, refract_reflections=True)
    m3ir.write(scene.set(refract_reflections=True).build(), tmp_path / "asks.m3ir")
    asks = m3ir.read(tmp_path / "asks.m3ir")
    np.testing.assert_array_equal(m3d_render.render(asks), bent)
    np.testing.assert_array_equal(m3d_render.render(asks, refract_reflections=None), bent)
    np.testing.assert_array_equal(m3d_render.render(asks, refract_reflections=False), plain)


def test_a_mirror_ray_bends_as_an_eye_ray_from_there_would():
    """What a mirror at the ground shows is what an eye at its points sees, by the traced paths."""
    from m3d_render.optics import trace_paths

    scene = mirage_mirror(MERMAN_PROFILE)
    ir = scene.build()
    seen = m3d_render.prepare(ir).render(refract_reflections=True, aov=["position", "primitive"])
    on_mirror = seen.layers["primitive"][:, 12] == 0
    rows = np.flatnonzero(on_mirror & (seen.layers["position"][:, 12, 0] > -700))
    assert len(rows) > 20
    checked = 0
    for row in rows.tolist():
        point = seen.layers["position"][row, 12].astype(float)
        # The eye's ray is a plane curve in x and z: its slope where it comes down, mirrored, goes on.
        view = np.array(scene.scene.view.eye)
        start = trace_paths(
            ir, [math.atan2(*_direction(scene, 12, row)[[2, 0]] * [1, -1])], at=[view[0] - point[0] - 0.01]
        )
        slope = (0.0 - start.heights[0, 0]) / 0.01
        onward = trace_paths(ir, [math.atan(-slope)], eye_height=0.0, at=[point[0] + 900])
        height = onward.heights[0, 0]
        if np.isnan(height) or height > 15.5 or abs(height - round(height)) < 0.1:
            continue
        assert seen.picture[row, 12, 1] == pytest.approx((math.floor(height) + 1) / 16, abs=1e-6), row
        checked += 1
    assert checked >= 5


def _direction(scene: SceneBuilder, x: int, y: int):
    view = scene.scene.view
    point = (
        np.array(view.reference_point)
        + (2 * x / (view.width - 1) - 1) * np.array(view.right)
        + (1 - 2 * y / (view.height - 1)) * view.height / view.width * view.aspect * np.array(view.up)
    )
    return point - np.array(view.eye)


def test_outside_of_the_layers_mirror_rays_are_straight():
    high = SceneBuilder((0, 0, 2), (10, 0, 40), 20, 20, 20).set(ambient=Ambient(1.0, WHITE, 0, 0), depth=2)
    high.mirage([(0.0, 10.0), (5.0, 13.0), (20.0, 15.0)])
    high.sphere((10, 0, 40), 4, high.solid(specular=1.0, hard=1.0, rough=0.0, ambient=0.0))
    high.sky(0, 50)
    np.testing.assert_array_equal(render(high), render(high, refract_reflections=True))


@pytest.mark.parametrize("seed", range(3))
def test_without_curvature_refracted_reflections_are_the_straight_ones(seed: int):
    """Every kind of mirror, in air that bends nothing: layers of no curvature, found for the middle of each."""
    rng = np.random.default_rng(seed)
    scene = SceneBuilder((60, 0, 6), (0, 0, 4), 30, 60, 45).set(ambient=Ambient(1.0, WHITE, 0, 0), depth=5)
    mirror = {"specular": 1.0, "hard": 0.8, "rough": 0.0, "ambient": 0.3}
    scene.plane(((0, 0, 0), (0, 1, 0), (-1, 0, 0)), scene.solid(color=(0.2, 0.3, 0.2), **mirror))
    for _ in range(12):
        x, y, z = rng.uniform((-20, -15, 1), (30, 15, 9))
        scene.sphere((x, y, z), rng.uniform(0.5, 2), scene.solid(color=rng.uniform(0, 1, 3), **mirror))
        corners = np.array([x, y, z]) + rng.uniform(-4, 4, (3, 3))
        scene.rectangle(corners, scene.solid(color=rng.uniform(0, 1, 3), **mirror))
        scene.triangle(corners + rng.uniform(-9, 9, 3), scene.solid(color=rng.uniform(0, 1, 3), **mirror))
    scene.sky(0, 50)
    scene.mirage(flat_air([-30.0, 0.0, 2.0, 5.0, 30.0]), segments=300)
    straight = render(scene, straight=True)
    bent = render(scene, refract_reflections=True)
    different = np.abs(bent - straight).max(axis=2) > 1e-3
    assert different.mean() < 0.002, different.sum()  # grazed edges alone


def flat_air(heights: list[float]):
    """A profile whose curvature at each layer's middle is the earth's, so that rays are straight lines."""
    from test_render import zero_curvature_profile

    return zero_curvature_profile(heights)
