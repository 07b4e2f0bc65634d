"""Parts of a picture, its values' range, several samples a pixel, and what it can hold beside colours."""

from __future__ import annotations

import itertools
import math
from typing import Unpack

import numpy as np
import pytest
from array_types import Floats
from numpy.typing import NDArray
from scene_builder import BLACK, MERMAN_PROFILE, WHITE, SceneBuilder, merman

import m3d_render
from m3d_render import Picture, RenderOptions
from m3d_render.optics import trace_crossings, trace_paths
from m3d_render.rendering import LAYERS
from m3dc.ir import Ambient, LightKind


def render(scene: SceneBuilder, **options: Unpack[RenderOptions]) -> Picture:
    return m3d_render.render(scene.build(), **options)


def bright(scene: SceneBuilder):
    return scene.set(ambient=Ambient(1.0, WHITE, 0, 0))


def directions(scene: SceneBuilder) -> Floats:
    view = scene.scene.view
    u, v = np.arange(view.width) / (view.width - 1), np.arange(view.height) / (view.height - 1)
    point = (
        np.array(view.reference_point)
        + (2 * u - 1)[None, :, None] * np.array(view.right)
        + (1 - 2 * v)[:, None, None] * (view.height / view.width) * view.aspect * np.array(view.up)
    )
    direction = point - np.array(view.eye)
    return direction / np.linalg.norm(direction, axis=-1, keepdims=True)


# Parts


def test_regions_and_rows_are_parts_of_the_whole():
    ir = merman(64, 40).build()
    whole = m3d_render.render(ir)
    assert m3d_render.render(ir, region=(3, 5, 17, 40)).tobytes() == whole[3:18, 5:41].tobytes()
    assert m3d_render.render(ir, region=m3d_render.Region(3, 5, 900, 900)).tobytes() == whole[3:, 5:].tobytes()
    assert m3d_render.render(ir, rows=(7, 7)).tobytes() == whole[7:8].tobytes()
    larger = m3d_render.render(ir, width=100, height=60)
    assert m3d_render.render(ir, width=100, height=60, rows=(20, 30)).tobytes() == larger[20:31].tobytes()
    rendering = m3d_render.prepare(ir).render(region=(3, 5, 17, 900))
    assert rendering.region == m3d_render.Region(3, 5, 17, 63)
    assert (rendering.width, rendering.height) == (64, 40)


@pytest.mark.parametrize(
    "options",
    [{"rows": (5, 4)}, {"rows": (40, 50)}, {"region": (0, 64, 5, 70)}, {"region": (-1, 0, 5, 5)},
     {"rows": (0, 1), "region": (0, 0, 1, 1)}, {"samples": 0}, {"samples": 10**9}],
)  # fmt: skip
def test_parts_that_are_none_are_refused(options: RenderOptions):
    with pytest.raises(m3d_render.SceneError):
        render(merman(64, 40), **options)


def test_an_option_that_does_not_exist_is_refused():
    with pytest.raises(TypeError, match="widht"):
        render(SceneBuilder(), widht=3)  # pyright: ignore[reportCallIssue]  it must be refused
    with pytest.raises(TypeError, match="shade"):
        m3d_render.prepare(SceneBuilder().build()).render(aov=["depth", "shade"])


# Values


def test_normalised_values_are_divided_by_the_largest():
    scene = SceneBuilder((10, 0, 0), (0, 0, 0), 30, 21, 21).set(ambient=Ambient(1.0, WHITE, 0, 0))
    scene.set(background=(0.5, 0.25, 0.0))
    lamp = scene.light(kind=LightKind.POINT, position=(0, 0, 0), intensity=4.0, color=(1.0, 0.5, 0.25))
    scene.sphere((0, 0, 0), 1, lamp)
    picture = render(scene, normalize=True)
    np.testing.assert_allclose(picture[10, 10], [1, 0.5, 0.25], rtol=1e-6)
    np.testing.assert_allclose(picture[0, 0], [0.125, 0.0625, 0], rtol=1e-6)
    scaled = np.log1p(9 * np.array([0.125, 0.0625, 0])) / math.log(10)
    np.testing.assert_allclose(render(scene, normalize=True, log_scale=9.0)[0, 0], scaled, rtol=1e-6)
    # A dark picture is brightened, a black one stays.
    np.testing.assert_allclose(render(SceneBuilder().set(background=(0.1, 0.2, 0)), normalize=True)[0, 0], [0.5, 1, 0])
    assert render(SceneBuilder(), normalize=True).max() == 0


# Samples


def half_plane(width: int, height: int, tilt: float = 0.0):
    """White below an edge through the middle, black above."""
    scene = bright(SceneBuilder((10, 0, 0), (0, 0, 0), 5, width, height, tilt=tilt))
    scene.rectangle(((0, -90, 0), (0, -90, -90), (0, 90, -90)), scene.solid(ambient=1.0))
    return scene


def test_an_edge_becomes_the_filters_step():
    """Pixels beside an edge hold the integral of the Blackman-Harris filter, three pixels wide."""
    picture = render(half_plane(5, 101), samples=1024)[..., 0]
    a = [0.35875, 0.48829, 0.14128, 0.01168]

    def below(x: NDArray[np.int64]):  # share of the filter's weight below an offset
        t = np.clip(x / 3 + 0.5, 0, 1)
        wave = [np.sin(2 * np.pi * k * t) / (2 * np.pi * k) for k in (1, 2, 3)]
        return (a[0] * t - a[1] * wave[0] + a[2] * wave[1] - a[3] * wave[2]) / a[0]

    rows = np.arange(101) - 50
    np.testing.assert_allclose(picture, np.broadcast_to(below(rows)[:, None], (101, 5)), atol=0.01)


def test_more_samples_are_nearer_to_many():
    scene = half_plane(60, 45, tilt=17)
    many = render(scene, samples=1024)
    errors = [np.sqrt(((render(scene, samples=n) - many) ** 2).mean()) for n in (1, 4, 16, 64)]
    assert all(second < 0.6 * first for first, second in itertools.pairwise(errors)), errors


def test_samples_of_a_constant_are_that_constant():
    picture = render(SceneBuilder().set(background=(0.3, 0.5, 0.7)), samples=7)
    np.testing.assert_allclose(picture, np.broadcast_to([0.3, 0.5, 0.7], picture.shape), rtol=1e-6)
    assert render(SceneBuilder(width=1, height=1).set(background=WHITE), samples=5).shape == (1, 1, 3)


def test_one_sample_is_the_default():
    scene = merman(40, 30)
    assert render(scene, samples=1).tobytes() == render(scene).tobytes()


# Extra outputs


def test_layers_of_a_sphere_before_a_plane():
    scene = bright(SceneBuilder((10, 2, 3), (0, 0.5, 0), 30, 41, 31, aspect=1.1, tilt=20))
    center, radius = np.array([0.3, 0.2, -0.4]), 1.1
    scene.plane(((-5, 1, 0), (-5, 0, 0), (-5, 0, 1)), scene.solid())
    scene.triangle(((0, 90, 90), (0, 91, 90), (0, 90, 91)), scene.solid())  # out of sight
    scene.sphere(center, radius, scene.solid())
    layers = (
        m3d_render.prepare(scene.build())
        .render(aov=["depth", "normal", "position", "solid", "primitive", "uv", "path"])
        .layers
    )
    eye, d = np.array(scene.scene.view.eye), directions(scene)
    along = d @ (center - eye)
    distance_squared = (center - eye) @ (center - eye) - along**2
    on_sphere = distance_squared < radius**2
    t = np.where(on_sphere, along - np.sqrt(np.maximum(radius**2 - distance_squared, 0)), (-5 - eye[0]) / d[..., 0])
    point = eye + t[..., None] * d
    np.testing.assert_allclose(layers["position"], point, rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(layers["depth"], (point - eye) @ np.array(scene.scene.view.normal), rtol=1e-6)
    np.testing.assert_allclose(layers["path"][..., 0], t, rtol=1e-6)
    assert not layers["path"][..., 1].any()
    normal = np.where(on_sphere[..., None], (point - center) / radius, [1.0, 0.0, 0.0])
    np.testing.assert_allclose(layers["normal"], normal, atol=1e-6)
    np.testing.assert_array_equal(layers["primitive"], np.where(on_sphere, 2, 0))
    np.testing.assert_array_equal(layers["solid"], np.where(on_sphere, 2, 0))
    unit = (point - center) / radius
    v = (np.arctan2(unit[..., 1], unit[..., 0]) / (2 * np.pi)) % 1
    expected = np.stack([np.arccos(np.clip(unit[..., 2], -1, 1)) / np.pi, v], axis=-1)
    np.testing.assert_allclose(layers["uv"][on_sphere], expected[on_sphere], atol=1e-5)
    assert np.all(layers["uv"][~on_sphere] == -1)


def test_layers_where_nothing_and_where_a_light_is_met():
    scene = SceneBuilder((10, 0, 0), (0, 0, 0), 30, 21, 21)
    scene.sphere((0, 0, 0), 1, scene.light(kind=LightKind.POINT))
    layers = m3d_render.prepare(scene.build()).render(aov=list(LAYERS)).layers
    corner = {name: values[0, 0].tolist() for name, values in layers.items()}
    assert corner == {
        "depth": math.inf, "normal": [0, 0, 0], "position": [0, 0, 0], "solid": -1, "primitive": -1, "uv": [-1, -1],
        "path": [math.inf, 0],
    }  # fmt: skip
    assert (layers["solid"][10, 10], layers["primitive"][10, 10], layers["depth"][10, 10]) == (-1, 0, 9)


def test_the_path_of_a_bent_ray():
    """Its length by fine steps along the path that `trace_paths` gives; its arcs by the crossings before the hit."""
    scene = SceneBuilder((500, 0, 2.1), (0, 0, 2.1), 0.4, 9, 41).mirage(MERMAN_PROFILE, segments=400)
    scene.rectangle(((-500, -99, 99), (-500, -99, -99), (-500, 99, -99)), scene.solid())
    ir = scene.build()
    layers = m3d_render.prepare(ir).render(aov=["path", "position"]).layers
    checked = 0
    for row in range(0, 41, 2):
        direction = directions(scene)[row, 4]
        angle = math.atan2(direction[2], -direction[0])
        r = np.linspace(0, 1000, 20_001)
        heights = trace_paths(ir, [angle], at=r).heights[0]
        if np.isnan(heights[-1]):
            continue  # it has reached the ground, and goes on straight
        checked += 1
        assert layers["position"][row, 4, 2] == pytest.approx(heights[-1], abs=1e-5)
        length = np.hypot(np.diff(r), np.diff(heights)).sum()
        assert layers["path"][row, 4, 0] == pytest.approx(length, rel=1e-7)
        crossings = trace_crossings(ir, angle)
        assert layers["path"][row, 4, 1] == np.searchsorted(crossings[1:, 0], 1000) + 1
    assert checked >= 8


def test_layers_do_not_change_the_picture_nor_the_samples_them():
    ir = merman(40, 30).build()
    prepared = m3d_render.prepare(ir)
    plain, with_layers = prepared.render(), prepared.render(aov=["path", "depth"])
    assert with_layers.picture.tobytes() == plain.picture.tobytes()
    assert list(with_layers.layers) == ["path", "depth"]
    sampled = prepared.render(aov=["path", "depth"], samples=3)
    assert sampled.layers["path"].tobytes() == with_layers.layers["path"].tobytes()
    assert sampled.picture.tobytes() == prepared.render(samples=3).picture.tobytes()
    part = prepared.render(aov=["depth"], region=(5, 6, 10, 20))
    assert part.layers["depth"].tobytes() == with_layers.layers["depth"][5:11, 6:21].tobytes()


def test_black_stays_black():
    scene = SceneBuilder().set(background=BLACK)
    assert render(scene, samples=4, normalize=True).max() == 0
