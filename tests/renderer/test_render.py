"""What pictures show, on scenes whose answer is known."""

from __future__ import annotations

import copy
import itertools
import math
import threading
from collections.abc import Callable
from typing import Any, Unpack

import numpy as np
import pytest
from array_types import Floats
from scene_builder import BLACK, MERMAN_PROFILE, WHITE, SceneBuilder, from_sun, merman, unit

import m3d_render
from m3d_render import Picture, RenderOptions
from m3d_render.picture import to_bytes
from m3dc.ir import TABLES, Ambient, Haze, LightKind, SceneIR, TextureKind, Triple

EARTH, EPSILON, BETA, GRAVITY = 6_371_000.0, 226e-6, 3.48e-3, 9.80665


def render(scene: SceneBuilder, **options: Unpack[RenderOptions]) -> Picture:
    return m3d_render.render(scene.build(), **options)


def bright(scene: SceneBuilder):
    """Full ambient light of white: what is lit by it alone shows its colour."""
    return scene.set(ambient=Ambient(1.0, WHITE, 0, 0))


def pixel_directions(scene: SceneBuilder):
    """Directions of all pixels, by the formulas of section 3.2."""
    view = scene.scene.view
    u = np.arange(view.width) / (view.width - 1)
    v = np.arange(view.height) / (view.height - 1)
    right, up = np.array(view.right), np.array(view.up)
    point = (
        np.array(view.reference_point)
        + (2 * u - 1)[None, :, None] * right
        + (1 - 2 * v)[:, None, None] * (view.height / view.width) * view.aspect * up
    )
    direction = point - np.array(view.eye)
    return direction / np.linalg.norm(direction, axis=-1, keepdims=True)


# Geometry


def test_a_spheres_silhouette_is_where_geometry_says():
    scene = bright(SceneBuilder((10, 2, 3), (0, 0.5, 0), 20, 101, 67, aspect=1.1, tilt=20))
    center, radius = np.array([0.3, 0.2, -0.4]), 1.1
    scene.sphere(center, radius, scene.solid(ambient=1.0))
    to_center = center - np.array(scene.scene.view.eye)
    along = pixel_directions(scene) @ to_center
    distance = np.sqrt(to_center @ to_center - along**2)
    np.testing.assert_array_equal(render(scene)[..., 0] > 0.5, distance < radius)


@pytest.mark.parametrize("up", [1, -1])
def test_looking_straight_up_and_down(up: int):
    scene = bright(SceneBuilder((0, 0, 0), (0, 0, up), 40, 11, 11))
    scene.sphere((up * 2.5, 0, 10 * up), 0.5, scene.solid(color=(1, 0, 0), ambient=1.0))
    scene.sphere((0, 2.5, 10 * up), 0.5, scene.solid(color=(0, 1, 0), ambient=1.0))
    picture = render(scene)
    upward, right = np.argwhere(picture[..., 0] > 0.5), np.argwhere(picture[..., 1] > 0.5)
    assert upward[:, 0].max() < 5
    assert np.all(abs(upward[:, 1] - 5) <= 1)
    # VR = VPN x UP: with X up, +Y is on the right looking up, and on the right looking down with -X up.
    assert np.all(abs(right[:, 0] - 5) <= 1)
    assert right[:, 1].min() > 5


def test_facets_rectangles_and_triangles_are_hit_like_the_formula():
    rng = np.random.default_rng(5)
    scene = bright(SceneBuilder((10, 0, 0), (0, 0, 0), 40, 60, 60))
    origin, directions = np.array([10.0, 0, 0]), pixel_directions(scene).reshape(-1, 3)
    nearest = np.full(len(directions), np.inf)
    expected = np.zeros((len(directions), 3))
    for i in range(60):
        p, u, v = rng.uniform(-3, 3, 3), rng.uniform(-2, 2, 3), rng.uniform(-2, 2, 3)
        color = rng.uniform(0.1, 1, 3)
        owner = scene.solid(color=color, ambient=1.0)
        corners = (p + v, p, p + u)
        if i % 3 == 0:
            scene.rectangle(corners, owner)
        elif i % 3 == 1:
            scene.triangle(corners, owner)
        else:
            scene.mesh(corners, [(0, 1, 2)], owner)
        normal = np.cross(u, v)
        to = p - origin
        with np.errstate(all="ignore"):
            t = (to @ normal) / (directions @ normal)
            a = -np.einsum("ij,ij->i", directions, np.broadcast_to(np.cross(to, v), directions.shape)) / (
                directions @ normal
            )
            b = -(directions @ np.cross(u, to)) / (directions @ normal)
        inside = (t > 0) & (a >= 0) & (b >= 0) & (((a <= 1) & (b <= 1)) if i % 3 == 0 else (a + b <= 1))
        closer = inside & (t < nearest)
        nearest[closer], expected[closer] = t[closer], color
    np.testing.assert_allclose(render(scene).reshape(-1, 3), expected, atol=1e-6)


def test_no_ray_slips_between_facets():
    rng = np.random.default_rng(7)
    n = 24
    grid = [(0.0, -4 + 8 * i / n, -4 + 8 * j / n) for i in range(n + 1) for j in range(n + 1)]
    vertices = np.array(grid) + rng.uniform(-0.1, 0.1, (len(grid), 3))
    facets: list[tuple[int, int, int]] = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1
            facets += [(a, b, c), (a, c, d)]
    profile = [(-50.0, 10.0), (-1.0, 10.2), (-0.3, 9.0), (0.2, 10.0), (1.0, 8.0), (50.0, 7.0)]
    scene = bright(SceneBuilder((400, 0, 0), (0, 0, 0), 0.8, 301, 301)).mirage(profile)
    scene.mesh(vertices, facets, scene.solid(ambient=1.0))
    for straight in (True, False):
        assert render(scene, straight=straight).min() == 1.0


def test_a_pixel_through_corners_and_edges_hits_once():
    # 33x33 pixels of a view along -X meet the grid's lines and corners exactly.
    scene = bright(SceneBuilder((10, 0, 0), (0, 0, 0), 45, 33, 33))
    vertices = [(0, y, z) for y in range(-4, 5) for z in range(-4, 5)]
    facets: list[tuple[int, int, int]] = []
    for i in range(8):
        for j in range(8):
            a = 9 * i + j
            facets += [(a, a + 9, a + 10), (a, a + 10, a + 1)]
    scene.mesh(vertices, facets, scene.solid(ambient=1.0))
    directions = pixel_directions(scene)
    hit = directions * (10 / -directions[..., 0])[..., None]
    inside = (abs(hit[..., 1]) < 4 - 1e-9) & (abs(hit[..., 2]) < 4 - 1e-9)
    assert np.all(render(scene)[inside] == 1.0)


# Light


def test_furnace():
    """A white diffuse sphere under constant ambient light shows that light."""
    scene = SceneBuilder().set(ambient=Ambient(0.7, WHITE, 0, 0), background=(0.7, 0.7, 0.7))
    scene.sphere((0, 0, 0), 2, scene.solid(ambient=1.0))
    np.testing.assert_allclose(render(scene), 0.7, atol=1e-7)


def lit_plate(light: dict[str, Any], shadows: bool = False, **surface: Any):
    """A plate in the YZ plane seen from +X; the middle pixel of 3x3 shows its origin."""
    scene = SceneBuilder((10, 0, 0), (0, 0, 0), 20, 3, 3).set(ambient=Ambient(0.0, WHITE, 0, 0), shadows=shadows)
    scene.light(**light)
    scene.rectangle(((0, -5, 5), (0, -5, -5), (0, 5, -5)), scene.solid(**{"ambient": 0.0, **surface}))
    return scene


def middle(picture: Picture):
    return picture[picture.shape[0] // 2, picture.shape[1] // 2]


def test_lambert_and_both_sides():
    light = {"direction": tuple(unit((-1, 0, -1))), "intensity": 0.8, "color": (1, 0.5, 0)}
    expected = 0.8 * math.sqrt(0.5) * np.array([1, 0.5, 0]) * [0.5, 1, 1]
    np.testing.assert_allclose(middle(render(lit_plate(light, color=(0.5, 1, 1)))), expected, rtol=1e-6)
    behind = {**light, "direction": tuple(unit((1, 0, -1)))}
    np.testing.assert_array_equal(middle(render(lit_plate(behind))), 0)


@pytest.mark.parametrize(
    ("columns", "expected"),
    [
        ({}, 1.0),
        ({"attenuation": 1.0}, 1 / 5),
        ({"attenuation": 2.0}, 1 / 25),
        ({"direction": (-1.0, 0.0, 0.0), "exponent": 3.0}, 1.0),
        ({"direction": tuple(unit((-1, 1, 0))), "exponent": 2.0}, 0.5),
        ({"direction": tuple(unit((-1, 1, 0))), "angle": 44.0}, 0.0),
        ({"direction": tuple(unit((-1, 1, 0))), "angle": 46.0}, 1.0),
        ({"direction": (1.0, 0.0, 0.0), "exponent": 1.0}, 0.0),
        ({"direction": (1.0, 0.0, 0.0)}, 1.0),
    ],
)
def test_point_lights(columns: dict[str, Any], expected: float):
    light = {"kind": LightKind.POINT, "position": (4.0, 0.0, 0.0), **columns}
    np.testing.assert_allclose(middle(render(lit_plate(light))), expected, rtol=1e-6)


def test_highlight_at_normal_incidence():
    """Light, viewer and normal in one line: D' and G are 1, so (N.L)(k_d O_d + k_s O_s) = k_d O_d + k_s O_sF."""
    color = np.array([0.2, 0.4, 0.6])
    light = {"direction": (-1.0, 0.0, 0.0), "intensity": 0.5}
    for metallic in (0.0, 0.5, 1.0):
        scene = lit_plate(light, color=color, specular=0.6, rough=0.3, hard=0.0, metallic=metallic, refindex=1.4)
        specular = (1 - metallic) * np.ones(3) + metallic * color
        np.testing.assert_allclose(middle(render(scene)), 0.5 * (0.4 * color + 0.6 * specular), rtol=1e-6)
        scene.rows["lights"][0]["highlights"] = False
        np.testing.assert_allclose(middle(render(scene)), 0.5 * 0.4 * color, rtol=1e-6)


def test_shadows_by_solids_alone_and_only_if_asked():
    light = {"direction": (-1.0, 0.0, 0.0)}

    def scene(shadows: bool = True):
        made = lit_plate(light, shadows=shadows)
        # Beside the line of sight, in the light of the middle.
        made.rows["lights"][0]["direction"] = tuple(unit((-1, 0.5, 0)))
        made.sphere((2, -1, 0), 0.3, made.solid())
        return made

    def lit_by_one_without_shadows():
        made = scene()
        made.rows["lights"][0]["shadows"] = False
        return made

    full = middle(render(scene(shadows=False)))[0]
    assert full > 0.8
    assert middle(render(scene()))[0] == 0
    assert middle(render(scene(shadows=False), shadows=True))[0] == 0
    assert middle(render(scene(), shadows=False))[0] == full
    assert middle(render(lit_by_one_without_shadows()))[0] == full
    lamp = lit_plate(light, shadows=True)
    lamp.rows["lights"][0]["direction"] = tuple(unit((-1, 0.5, 0)))
    lamp.sphere((2, -1, 0), 0.3, ("light", 0))
    assert middle(render(lamp))[0] == full


def test_a_point_light_is_not_shadowed_from_behind_it():
    scene = lit_plate({"kind": LightKind.POINT, "position": (4.0, 0.0, 0.0)}, shadows=True)
    scene.sphere((6, 3, 0), 0.5, scene.solid())
    scene.sphere((5, 0, 0), 0.1, ("light", 0))
    assert middle(render(scene))[0] == 1.0  # the lamp itself is in front: its colour
    scene = lit_plate({"kind": LightKind.POINT, "position": (4.0, 1.0, 0.0)}, shadows=True)
    scene.sphere((8, 2, 0), 0.5, scene.solid())
    assert middle(render(scene))[0] > 0.9


def test_a_convex_shape_does_not_shadow_its_lit_side():
    scene = SceneBuilder((1e4, 0, 0), (0, 0, 0), 1.5, 101, 101).set(shadows=True)
    scene.light(direction=from_sun(20, 50))
    scene.sphere((0, 0, 0), 100, scene.solid(ambient=0.0))
    np.testing.assert_array_equal(render(scene), render(scene, shadows=False))


def test_visible_lights_show_their_colour_unshaded():
    scene = SceneBuilder()
    light = scene.light(color=(0.5, 0.25, 1.0), intensity=0.5)
    scene.sphere((0, 0, 0), 1, light)
    np.testing.assert_allclose(middle(render(scene)), [0.25, 0.125, 0.5], rtol=1e-6)


# Mirrors


def mirror_facing_a_wall(depth: int):
    """The eye looks at a mirror, which shows a wall behind the eye."""
    scene = bright(SceneBuilder((5, 0, 0), (0, 0, 0), 10, 3, 3)).set(depth=depth)
    mirror = scene.solid(specular=1.0, hard=0.5, ambient=0.0, rough=0.0)
    scene.rectangle(((0, -1, 1), (0, -1, -1), (0, 1, -1)), mirror)
    scene.plane(((10, -1, 1), (10, -1, -1), (10, 1, -1)), scene.solid(color=(0.2, 0.4, 0.8), ambient=1.0))
    return scene


def test_mirrors_to_the_depth():
    np.testing.assert_allclose(middle(render(mirror_facing_a_wall(2))), [0.1, 0.2, 0.4], rtol=1e-6)
    np.testing.assert_allclose(middle(render(mirror_facing_a_wall(1))), [0.5, 0.5, 0.5], rtol=1e-6)
    np.testing.assert_allclose(middle(render(mirror_facing_a_wall(1), depth=2)), [0.1, 0.2, 0.4], rtol=1e-6)


def test_two_mirrors_add_a_geometric_series():
    scene = SceneBuilder((5, 0, 0), (0, 0, 0), 10, 3, 3).set(depth=6, ambient=Ambient(1.0, WHITE, 0, 0))
    mirror = {"specular": 1.0, "hard": 0.5, "ambient": 0.25, "rough": 0.0}
    for x in (0, 10):
        scene.rectangle(((x, -9, 9), (x, -9, -9), (x, 9, -9)), scene.solid(**mirror))
    # Level n adds 0.25 * 0.5^(n-1); beyond level 6 comes the ambient light, 0.5^6.
    expected = 0.25 * sum(0.5**n for n in range(6)) + 0.5**6
    np.testing.assert_allclose(middle(render(scene)), expected, rtol=1e-6)


def cie_sky(direction: Floats, sun: Floats, intensity: float, zenith: Triple, horizon: Triple, overcast: float):
    """The sky's colour toward unit vectors, written out from the CIE formulas."""
    sine = np.abs(direction[..., 2])
    up = direction * [1, 1, 0] + np.stack([0 * sine, 0 * sine, sine], -1)
    gamma, z0 = np.arccos(np.clip(up @ sun, -1, 1)), math.acos(sun[2])
    with np.errstate(divide="ignore"):
        clear = (0.91 + 10 * np.exp(-3 * gamma) + 0.45 * np.cos(gamma) ** 2) * (1 - np.exp(-0.32 / sine))
    clear /= (0.91 + 10 * math.exp(-3 * z0) + 0.45 * math.cos(z0) ** 2) * (1 - math.exp(-0.32))
    luminance = (1 - overcast) * clear + overcast * (1 + 2 * sine) / 3
    share = (np.arcsin(sine) / (math.pi / 2))[..., None]
    return intensity * luminance[..., None] * ((1 - share) * np.array(horizon) + share * np.array(zenith))


def test_the_sky_and_a_mirror_of_it():
    zenith, horizon = (0.1, 0.1, 0.3), (0.3, 0.35, 0.4)
    scene = SceneBuilder((0, 0, 0), (1, 0, 0.2), 90, 31, 31)
    scene.sky(30, 40, intensity=0.5, zenith_color=zenith, horizon_color=horizon, overcast=0.25)
    sun = -np.array(from_sun(30, 40))
    directions = pixel_directions(scene)
    expected = cie_sky(directions, sun, 0.5, zenith, horizon, 0.25)
    np.testing.assert_allclose(render(scene), np.clip(expected, 0, 1), atol=1e-6)
    scene.rows["lights"][0]["intensity"] = 0.0
    mirror = scene.solid(specular=1.0, hard=1.0, ambient=0.0)
    scene.plane(((5, 0, 1), (5, 0, 0), (5, 1, 0)), mirror)
    facing = directions[..., 0] > 0
    expected = cie_sky(directions * [-1, 1, 1], sun, 0.5, zenith, horizon, 0.25)
    np.testing.assert_allclose(render(scene)[facing], np.clip(expected, 0, 1)[facing], atol=1e-6)


# Air


def test_haze_fades_with_distance_and_is_the_background():
    scene = bright(SceneBuilder((10, 0, 0), (0, 0, 0), 20, 3, 3))
    scene.set(haze=Haze(True, 0.5, (1, 1, 0), 0.1), background=(1, 0, 0))
    np.testing.assert_allclose(middle(render(scene)), [0.5, 0.5, 0], rtol=1e-6)
    scene.plane(((0, 0, 1), (0, 0, 0), (0, 1, 0)), scene.solid(color=(0, 1, 1), ambient=1.0))
    left = math.exp(-1)
    expected = left * np.array([0, 1, 1]) + (1 - left) * np.array([0.5, 0.5, 0])
    np.testing.assert_allclose(middle(render(scene)), expected, rtol=1e-6)
    scene.set(haze=Haze(False, 1.0, WHITE, 0.0))
    scene.rows["primitives"].clear()
    np.testing.assert_allclose(middle(render(scene)), [1, 0, 0])


def test_haze_along_a_curve_is_as_along_the_straight_ray():
    scene = bright(SceneBuilder((500, 0, 2), (0, 0, 1.9), 0.6, 9, 9))
    scene.set(haze=Haze(True, 0.5, (1, 1, 0), 0.002))
    scene.mirage([(0, 10.0), (5, 10.5), (20, 10.2)])
    scene.plane(((0, 0, 1), (0, 0, 0), (0, 1, 0)), scene.solid(color=(0, 1, 1), ambient=1.0))
    np.testing.assert_allclose(render(scene), render(scene, straight=True), atol=1e-5)


def zero_curvature_profile(heights: list[float], temperature: float = 15.0):
    """Temperatures for which every layer's curvature at its middle is the earth's: solved layer by layer."""
    profile = [(heights[0], temperature)]
    p, t = 101_325.0, temperature + 273.15
    for low, high in itertools.pairwise(heights):
        gradient = 0.0
        for _ in range(60):
            height = (high - low) / 2
            middle_t = t + gradient * height
            middle_p = p * (
                (middle_t / t) ** (-BETA * GRAVITY / gradient) if gradient else math.exp(-BETA * GRAVITY * height / t)
            )
            eta = 1 + EPSILON * BETA * middle_p / middle_t
            gradient = eta * middle_t**2 / (EPSILON * BETA * middle_p * EARTH) - BETA * GRAVITY
        top = t + gradient * (high - low)
        p *= (top / t) ** (-BETA * GRAVITY / gradient)
        t = top
        profile.append((high, t - 273.15))
    return profile


def test_without_curvature_a_mirage_is_the_straight_picture():
    scene = merman(200, 125)
    scene.rows["profile"].clear()
    scene.mirage(zero_curvature_profile([0.0, 1.0, 2.0, 2.5, 3.0, 5.0, 10.0, 20.0]), segments=300)
    ir = scene.build()
    bent, straight = m3d_render.render(ir), m3d_render.render(ir, straight=True)
    np.testing.assert_array_equal(to_bytes(bent), to_bytes(straight))


def seen_through_the_merman_air(make: Callable[[SceneBuilder], object]):
    """Pictures, straight and bent, of shapes at 1.4 km in the merman scene's view; they show their own colour."""
    scene = bright(SceneBuilder((1, 0, 2.1), (0, 0, 2.1001), 1.5, 320, 200, aspect=1.2))
    scene.mirage(MERMAN_PROFILE, segments=300)
    make(scene)
    return render(scene, straight=True), render(scene)


def test_the_ground_rises_to_a_wall():
    ground = ((0, 0, 0), (0, 1, 0), (-1, 0, 0))
    straight, bent = seen_through_the_merman_air(lambda scene: scene.plane(ground, scene.solid(ambient=1.0)))
    horizons = [int(np.argmax(picture[:, 20, 0] > 0)) for picture in (straight, bent)]
    assert 99 <= horizons[0] <= 102
    assert horizons[1] < 75
    assert np.all(bent[horizons[1] :] == 1.0)  # no sky through the ground


def test_the_rectangle_is_stretched_and_its_middle_inverted():
    def rectangle(scene: SceneBuilder):
        blend = (TextureKind.VBLEND, {"ranges": [(0.0, 1.0, (0.1, 0, 0), (1, 0, 0))]})
        solid = scene.solid(ambient=1.0, textures=[blend])
        scene.rectangle(((-1400, -2, 1), (-1400, -2, 0), (-1400, 2, 0)), solid)

    straight, bent = (picture[:, 160, 0] for picture in seen_through_the_merman_air(rectangle))
    assert np.count_nonzero(bent) > 3 * np.count_nonzero(straight)
    rows = np.flatnonzero(bent)
    assert len(rows) == rows[-1] - rows[0] + 1
    signs = np.sign(np.diff(bent[rows]))
    # From the top: downward, then upward again (the inverted part), then downward to the foot.
    assert [sign for i, sign in enumerate(signs) if i == 0 or sign != signs[i - 1]] == [-1, 1, -1]


def test_the_lower_right_sphere_is_a_mushroom():
    def sphere(scene: SceneBuilder):
        scene.sphere((-1400, 7, 2), 2, scene.solid(ambient=1.0))

    straight, bent = (picture[..., 0] for picture in seen_through_the_merman_air(sphere))
    widths = [np.count_nonzero(row) for row in bent if row.any()]
    waist = min(widths[5:-5])
    at = widths.index(waist, 5)
    assert max(widths[:at]) > 2 * waist  # the cap
    assert max(widths[at:]) > 1.5 * waist  # the foot
    # No distortion to the sides.
    columns = [np.flatnonzero(picture.any(axis=0)) for picture in (straight, bent)]
    assert abs(columns[0][0] - columns[1][0]) <= 1
    assert abs(columns[0][-1] - columns[1][-1]) <= 1


def test_an_observer_outside_of_the_profile_is_refused_unless_rays_are_straight():
    scene = SceneBuilder((0, 0, 50), (1, 0, 50), width=2, height=2).mirage([(0, 1), (5, 2), (10, 3)])
    with pytest.raises(m3d_render.SceneError, match="outside of the temperature profile, 0 to 10"):
        render(scene)
    render(scene, straight=True)


def test_vertical_views_through_a_mirage_are_straight():
    scene = merman(21, 21)
    scene.sphere((1, 0, -3), 0.2, scene.solid(color=(1, 0, 0)))
    down = SceneBuilder((1, 0, 2.1), (1, 0, 0), 1e-5, 21, 21)
    scene.set(view=down.scene.view)
    np.testing.assert_array_equal(render(scene), render(scene, straight=True))


# Textures


def test_checker_in_the_world_and_local():
    moved = np.eye(4)
    moved[3, 1] = -1.0  # the inverse of an object moved along +Y

    def plate(**columns: Any):
        scene = bright(SceneBuilder((10, 0.25, 0.25), (0, 0.25, 0.25), 20, 3, 3))
        solid = scene.solid(
            color=(1, 0, 0), ambient=1.0, textures=[(TextureKind.CHECKER, {"color": (0, 0, 1), **columns})]
        )
        scene.rows["solids"][0]["inverse"] = moved
        scene.rectangle(((0.5, -5, 5), (0.5, -5, -5), (0.5, 5, -5)), solid)
        return middle(render(scene))

    np.testing.assert_allclose(plate(), [1, 0, 0])
    np.testing.assert_allclose(plate(local=True), [0, 0, 1])
    np.testing.assert_allclose(plate(inverse=np.diag([1, 1, 1, 1.0]) + np.eye(4)[[3]].T @ [[1, 0, 0, 0]]), [0, 0, 1])


def test_blends_run_along_u_and_v():
    red, blue = (1, 0, 0), (0, 0, 1)

    def rectangle(kind: TextureKind, row: int, column: int, **columns: Any):
        scene = bright(SceneBuilder((10, 0, 0), (0, 0, 0), 2 * math.degrees(math.atan(0.1)), 5, 5))
        texture = (kind, {"color": blue, **columns})
        solid = scene.solid(color=red, ambient=1.0, textures=[texture])
        # P is the lower left as seen; U to the right, V up; half as large again as the view.
        scene.rectangle(((0, -2, 2), (0, -2, -2), (0, 2, -2)), solid)
        return render(scene)[row, column]

    np.testing.assert_allclose(rectangle(TextureKind.UBLEND, 2, 2), [0, 1, 0], atol=1e-6)
    np.testing.assert_allclose(rectangle(TextureKind.UBLEND, 2, 0), [1, 1, 0], atol=1e-6)
    np.testing.assert_allclose(rectangle(TextureKind.VBLEND, 0, 2), [0, 1, 1], atol=1e-6)
    ranges = [(0.2, 0.3, BLACK, WHITE), (0.4, 0.6, (0, 1, 0), (0, 0, 1))]
    np.testing.assert_allclose(rectangle(TextureKind.UBLEND, 2, 0, ranges=ranges), [0.5] * 3, atol=1e-6)
    np.testing.assert_allclose(rectangle(TextureKind.UBLEND, 2, 2, ranges=ranges), [0, 0.5, 0.5], atol=1e-6)
    np.testing.assert_allclose(rectangle(TextureKind.UBLEND, 2, 4, ranges=ranges), red, atol=1e-6)


def test_phong_normals_are_interpolated():
    """A flat facet whose corners have a sphere's normals is lit like the sphere."""
    scene = SceneBuilder((10, 0, 0), (0, 0, 0), 20, 3, 3).set(ambient=Ambient(0.0, WHITE, 0, 0))
    scene.light(direction=(-1.0, 0.0, 0.0))
    corners = [(0, -3, -1), (0, 3, -1), (0, 0, 2)]
    tilted = unit((1, 0, 1))
    scene.mesh(corners, [(0, 1, 2)], scene.solid(ambient=0.0), normals=[tilted] * 3)
    np.testing.assert_allclose(middle(render(scene)), math.sqrt(0.5), rtol=1e-6)


# The picture as a whole


def test_the_same_picture_from_any_number_of_threads():
    ir = merman(97, 61).build()
    pictures = [m3d_render.render(ir, threads=n, shadows=True) for n in (1, 2, 3, 8)]
    assert all(picture.tobytes() == pictures[0].tobytes() for picture in pictures)


def test_a_region_is_a_part_of_the_whole():
    scene = merman(64, 40)
    whole = render(scene)
    view = scene.scene.view._replace(top=10, left=5, bottom=29, right_edge=40)
    scene.set(view=view)
    assert render(scene).tobytes() == whole[10:30, 5:41].tobytes()
    assert render(scene, width=64).tobytes() == whole.tobytes()
    outside = view._replace(bottom=500, right_edge=900)
    assert render(scene.set(view=outside)).tobytes() == whole[10:, 5:].tobytes()


def test_log_scale():
    scene = SceneBuilder(width=1, height=1).set(background=(0.1, 0.5, 3.0))
    expected = np.log1p(9 * np.array([0.1, 0.5, 1.0])) / math.log(10)
    np.testing.assert_allclose(render(scene, log_scale=9.0)[0, 0], expected, rtol=1e-6)
    np.testing.assert_allclose(render(scene, log_scale=1.0)[0, 0], [0.1, 0.5, 1.0], rtol=1e-6)


def test_width_and_height():
    assert render(SceneBuilder(), width=7).shape == (32, 7, 3)
    assert render(SceneBuilder(), height=1, width=1).shape == (1, 1, 3)
    impossible: list[RenderOptions] = [{"width": 0}, {"height": 65_536}, {"depth": 0}, {"threads": 0}]
    for wrong in impossible:
        with pytest.raises(m3d_render.SceneError):
            render(SceneBuilder(), **wrong)


def test_progress_and_cancel():
    ir = merman(1600, 1000).build()
    seen: list[tuple[int, int]] = []
    m3d_render.render(ir, width=80, height=50, progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (50, 50)
    assert seen == sorted(seen)
    asked = threading.Event()
    asked.set()
    with pytest.raises(m3d_render.Cancelled):
        m3d_render.render(ir, width=8000, height=5000, cancel=asked.is_set)
    with pytest.raises(ZeroDivisionError):
        m3d_render.render(ir, width=8000, height=5000, cancel=lambda: 1 / 0)


# Input that makes no sense


def garbage(value: float):
    """Something of every kind with a value among its numbers."""
    scene = merman(24, 16)
    owner = scene.solid(color=(1, 1, 1))
    scene.sphere((value, 0, 0), 1, owner)
    scene.sphere((-1400, 0, 3), value, owner)
    scene.sphere((0, 0, 0), 1, owner, pole=(value, 0, 0))
    scene.plane(((value, 0, 0), (0, 0, 0), (0, 1, 0)), owner)
    scene.rectangle(((-1400, value, 0), (0, value, 0), (value, 1, 1)), owner)
    scene.triangle(((-1400, value, 0), (-1400, 0, 0), (-1400, 1, 1)), owner)
    scene.mesh([(value, 0, 0), (-1400, 1, 1), (-1400, 2, 1)], [(0, 1, 2), (0, 0, 0), (1, 1, 2)], owner,
               normals=[(value, 0, 0)] * 3)  # fmt: skip
    scene.light(kind=LightKind.POINT, position=(value, 0, 0), attenuation=value, exponent=value)
    scene.light(direction=(value, 0, 0))
    return scene


@pytest.mark.parametrize("value", [1e20, -1e38, 1e75, 5e-324, 0.0])
def test_garbage_geometry_is_survived(value: float):
    for straight in (True, False):
        picture = render(garbage(value), straight=straight, shadows=True)
        assert np.all((picture >= 0) & (picture <= 1))


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e76, 1e300])
@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
def test_geometry_beyond_arithmetic_is_refused(value: float):
    """In words, where it stands: left out of the picture nobody would miss it."""
    with pytest.raises(m3d_render.SceneError, match="finite" if not math.isfinite(value) else "up to 1e75"):
        render(garbage(value))


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e300])
def test_views_beyond_arithmetic_are_refused(value: float):
    scene = merman(8, 8)
    for name in ("right", "normal"):
        broken = scene.scene.view._replace(**{name: (value, 0.0, 0.0)})
        with pytest.raises(m3d_render.SceneError, match=name):
            render(scene.set(view=broken))


def numbers_of(ir: SceneIR):
    """Every column of numbers that has a row."""
    return [
        (table, column)
        for table, columns in TABLES.items()
        for column, (dtype, *_) in columns.items()
        if dtype == "f8" and len(ir[table][column])
    ]


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_any_number_that_is_none_is_refused_or_not_used(value: float):
    """What the renderer reads is checked when it is read."""
    unused = {"normal", "transform"}
    ir = merman(6, 4).build()
    for table, column in numbers_of(ir):
        broken = copy.deepcopy(ir)
        broken[table][column][0] = value
        try:
            m3d_render.prepare(broken)
        except m3d_render.SceneError as refused:
            assert "finite" in str(refused) or "more than" in str(refused), (table, column)  # noqa: PT017
        else:
            allowed = column in unused or table in ("solids", "lights", "primitives") or column == "beckmann"
            assert allowed, (table, column)
            picture = m3d_render.render(broken)
            assert np.all((picture >= 0) & (picture <= 1))


def test_rows_that_belong_to_more_than_one_are_refused():
    """A small file could make endless work of them."""
    scene = SceneBuilder()
    row = scene.solid()
    scene.mesh([(0, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2)] * 3, row)
    scene.rows["primitives"] *= 2
    with pytest.raises(m3d_render.SceneError, match="rows of facets belong to more than one"):
        render(scene)


def test_a_damaged_ir_is_refused():
    ir = merman(4, 4).build()
    for table, column, value in [
        ("primitives", "row", 99),
        ("primitives", "kind", 17),
        ("primitives", "solid", 99),
        ("surfaces", "first_texture", -1),
        ("surfaces", "texture_count", 1000),
        ("textures", "kind", 17),
        ("textures", "wave_count", 3),
        ("textures", "wave_count", 2**31 - 1),
        ("surfaces", "first_texture", 2**31 - 1),
    ]:
        broken = copy.deepcopy(ir)
        broken[table][column][0] = value
        with pytest.raises(m3d_render.SceneError, match="damaged scene"):
            m3d_render.render(broken)
    broken = copy.deepcopy(ir)
    del broken["spheres"]["radius"]
    with pytest.raises(m3d_render.SceneError, match=r"spheres\.radius"):
        m3d_render.render(broken)


@pytest.mark.parametrize("axes", [(), (2,), (1,) * 40], ids=["none", "one more", "forty more"])
def test_a_column_of_another_shape_is_refused(axes: tuple[int, ...]):
    """An array may have more axes than the kernel can read: up to 64."""
    ir = merman(4, 4).build()
    column = ir["spheres"]["radius"]
    shape = (*column.shape, *axes) if axes else ()
    ir["spheres"]["radius"] = np.ones(shape)
    with pytest.raises(m3d_render.SceneError, match=r"damaged scene: spheres"):
        m3d_render.render(ir)


def test_columns_may_lie_in_memory_as_they_like():
    ir = merman(6, 4).build()
    expected = m3d_render.render(ir).tobytes()
    for columns in ir.tables.values():
        for name, column in columns.items():
            spread = np.zeros((2 * len(column), *column.shape[1:]), column.dtype)[::2]
            spread[:] = column
            columns[name] = spread
    assert m3d_render.render(ir).tobytes() == expected
