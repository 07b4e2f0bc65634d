"""The data of figures: the profile, the fan of rays and what they pass, the transfer characteristic."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scene_builder import MERMAN_PROFILE, SceneBuilder, merman

import m3dc
from m3d_render import plot, prepare
from m3d_render.optics import EARTH_CURVATURE, trace_paths
from m3d_render.rendering import SceneError
from m3d_render.sight import view_angles
from m3dc.ir import PrimitiveKind, SceneIR, TextureKind

MILLIMETRE = 1e-3
RULER = 20.0  # m


def ruler_scene(distance: float, rows: int = 401):
    """The merman's air and observer, and a ruler at a distance whose brightness is the height / RULER."""
    scene = SceneBuilder((1, 0, 2.1), (0, 0, 2.1), 1.5, 3, rows, aspect=1.2 * 200 / 320 * 3 / rows)
    scene.set(ambient=scene.scene.ambient._replace(intensity=1.0, color=(1.0, 1.0, 1.0)))
    scene.mirage(MERMAN_PROFILE, segments=300, elevation=100.0)
    stripes = (TextureKind.VBLEND, {"color": (1.0, 1.0, 1.0)})
    wall = scene.solid(color=(0.0, 0.0, 0.0), ambient=1.0, diffuse=0.0, textures=[stripes])
    x = 1 - distance
    scene.rectangle(((x, -9, RULER), (x, -9, 0), (x, 9, 0)), wall)
    ground = scene.solid(color=(0.0, 0.0, 0.0), ambient=0.0, diffuse=0.0)
    scene.plane(((0, 0, 0), (0, 1, 0), (-1, 0, 0)), ground)
    return scene.build()


def row_angles(ir: SceneIR):
    """Angles above the horizontal of the rows of a level view's pixels, the lowest first."""
    view = ir.scene.view
    v = np.arange(view.height) / (view.height - 1)
    half_height = view.height / view.width * view.aspect
    return np.arctan((1 - 2 * v) * half_height / view.distance)[::-1]


@pytest.mark.parametrize("distance", [700.0, 1400.0])
def test_the_transfer_characteristic_is_what_a_rendered_ruler_shows(distance: float):
    ir = ruler_scene(distance)
    rendering = prepare(ir).render(aov=["position"])
    position = rendering.layers["position"][::-1, 1].astype(float)
    seen = rendering.picture[::-1, 1, 0].astype(float) * RULER
    found = plot.transfer_characteristic(ir, [distance], row_angles(ir))
    heights = found.heights[0]
    on_ruler = position[:, 0] == np.float32(1 - distance)
    assert on_ruler.sum() > 180
    np.testing.assert_array_equal(np.isnan(heights), ~on_ruler)
    np.testing.assert_allclose(heights[on_ruler], position[on_ruler, 2], atol=0.01 * MILLIMETRE)
    np.testing.assert_allclose(heights[on_ruler], seen[on_ruler], atol=0.1 * MILLIMETRE)
    # The ground before the ruler is what the other rays meet.
    assert set(found.ends[~on_ruler]) == {"ground"}


def test_rays_that_have_left_the_air_go_on_straight():
    ir = ruler_scene(1400.0)
    steep = [math.radians(1), math.radians(1.5)]
    found = plot.transfer_characteristic(ir, [1400.0], steep)
    paths = trace_paths(ir, steep)
    assert set(paths.ends) == {"top"}
    r, z = paths.end_points.T
    np.testing.assert_allclose(found.heights[0], z + paths.end_slopes * (1400 - r))
    np.testing.assert_allclose(found.bent, r)


def test_zones_of_the_merman_at_1400_m():
    found = plot.transfer_characteristic(merman().build(), [1400.0])
    zones = found.zones(0)
    kinds = [zone.kind for zone in zones]
    assert kinds[0] == "missed", "the ground before"
    assert {"inverted", "towering", "stooping", "plain"} <= set(kinds)
    # They follow one another over all angles.
    assert (zones[0].low, zones[-1].high) == (found.angles[0], found.angles[-1])
    assert all(a.high == b.low for a, b in pairwise(zones))
    for zone in zones:
        apart = np.diff(found.heights[0, zone.part])
        if zone.kind == "inverted" and len(apart) > 2:
            assert (apart[1:-1] < 0).all()


def test_air_that_does_not_bend_shows_things_as_they_are():
    ir = m3dc.compile("SCENE { VIEW { FROM <0,0,2> TO <1000,0,2> FOV 2 } }").ir
    found = plot.transfer_characteristic(ir)
    assert found.distances.tolist() == [1000.0]
    np.testing.assert_allclose(found.heights[0], 2 + 1000 * np.tan(found.angles))
    np.testing.assert_allclose(found.magnification, 1, rtol=1e-3)
    assert [zone.kind for zone in found.zones(0)] == ["plain"]


def test_angles_of_a_characteristic_must_increase():
    with pytest.raises(ValueError, match="must increase"):
        plot.transfer_characteristic(merman().build(), [1400.0], [0.01, 0.0])


def test_a_fan_is_the_traced_rays_over_the_pictures_height():
    ir = merman().build()
    fan = plot.ray_fan(ir, reach=1500.0)
    half = math.atan(200 / 320 * 1.2 * math.tan(math.radians(0.75)))
    tilt = math.atan2(0.0001, 1)
    np.testing.assert_allclose(fan.angles[[0, -1]], [tilt - half, tilt + half], rtol=1e-9)
    traced = trace_paths(ir, fan.angles, at=fan.distances)
    kept = ~np.isnan(traced.heights)
    np.testing.assert_array_equal(fan.heights[kept], traced.heights[kept])
    assert np.isnan(fan.heights[fan.ends == "ground", -1]).any()
    assert not np.isnan(fan.heights[fan.ends == "top"]).any()
    np.testing.assert_allclose(fan.boundaries, [z for z, _ in MERMAN_PROFILE])


def test_crossings_are_where_two_rays_are_at_one_height():
    ir = merman().build()
    angles = np.radians(np.arange(0, 8, 0.5) / 60)
    fan = plot.ray_fan(ir, angles, 1500.0)
    assert len(fan.crossings) >= 3
    for (r, z), angle in zip(fan.crossings.tolist(), fan.crossing_angles, strict=True):
        i = int(np.searchsorted(angles, float(angle))) - 1
        first, second = trace_paths(ir, angles[i : i + 2], at=[r]).heights[:, 0].tolist()
        assert first == pytest.approx(second, abs=MILLIMETRE)
        assert z == pytest.approx(first, abs=MILLIMETRE)
    straight = SceneBuilder((0, 0, 2), (1, 0, 2)).build()
    assert len(plot.ray_fan(straight).crossings) == 0


SOLIDS = """
SCENE {{ VIEW {{ FROM < 100, 0, 2 > TO < 0, 0, {up} > }} }}
SOLID {{ SPHERE {{ CENTER < 0, 3, 5 > RADIUS 5 }} }}
SOLID {{ RECTANGLE {{ VERTEX1 < 50, -1, 4 > VERTEX2 < 50, -1, 1 > VERTEX3 < 50, 1, 1 > }} }}
SOLID {{ TRIANGLE {{ VERTEX1 < 20, 0, 6 > VERTEX2 < 20, -1, 0 > VERTEX3 < 20, 1, 0 > }} }}
SOLID {{ PLANE {{ }} }}
SOLID {{ POLYGONS {{ VERTICES {{ 4 <0,0,1> <1,-1,0> <1,1,0> <-1,0,0> }} FACETS {{ 2 0 1 2 0 2 3 }} }} }}
SOLID {{ SPHERE {{ CENTER < 150, 0, 2 > }} }}
SOLID {{ SPHERE {{ CENTER < 0, 30, 2 > }} }}
"""


def test_solids_in_section():
    ir = m3dc.compile(SOLIDS.format(up=2)).ir
    cuts = plot.section(ir, plot.ViewPlane.of(ir))
    assert [cut.solid for cut in cuts] == [0, 1, 2, 3, 4], "neither the one behind the eye nor the one aside"
    ball, wall, triangle, plane, mesh = cuts
    np.testing.assert_allclose(np.linalg.norm(ball.segments[:, 0] - (100, 5), axis=1), 4)
    np.testing.assert_allclose(wall.segments[:, :, 0], 50)
    assert (wall.segments[:, :, 1].min(), wall.segments[:, :, 1].max()) == (1, 4)
    np.testing.assert_allclose(np.sort(triangle.segments[0], axis=0), [[80, 0], [80, 6]])
    assert (plane.kind, plane.level, len(plane.segments)) == (PrimitiveKind.PLANE, 0.0, 0)
    ends = sorted({tuple(point) for point in mesh.segments.reshape(-1, 2).round(9).tolist()})
    assert ends == [(99, 0), (100, 1), (101, 0)]


def test_the_plane_turns_to_the_right():
    ir = m3dc.compile(SOLIDS.format(up=2)).ir
    # Looking along -x, right is +y: the ball 30 m aside at 100 m.
    cuts = plot.section(ir, plot.ViewPlane.of(ir, math.degrees(math.atan2(30, 100))))
    ball = next(cut for cut in cuts if cut.solid == 6)
    np.testing.assert_allclose(ball.segments[:, 0, 0].mean(), math.hypot(30, 100), atol=0.02)


def test_angles_of_a_view():
    def angles(to: str):
        ir = m3dc.compile(f"SCENE {{ VIEW {{ FROM <0,0,9> TO <{to}> FOV 60 WIDTH 9 HEIGHT 9 }} }} LIGHT {{ }}").ir
        return np.degrees(view_angles(ir))

    np.testing.assert_allclose(angles("9,0,9"), [-30, 30])
    np.testing.assert_allclose(angles("9,0,0"), [-75, -15])
    np.testing.assert_allclose(angles("0,0,0"), [-89, -60], err_msg="straight down")
    np.testing.assert_allclose(angles("1,0,20"), [90 - math.degrees(math.atan2(1, 11)) - 30, 89])


def test_what_is_looked_at():
    def distance(text: str):
        return plot.things_distance(m3dc.compile(text).ir)

    view = "SCENE { VIEW { FROM <10,0,2> TO <%s,0,2> } } "
    assert distance(view % 0) == 10, "without things VIEW TO is all there is"
    assert distance(view % 0 + "SOLID { SPHERE { RADIUS 3 } }") == 10
    assert distance(view % 9 + "SOLID { SPHERE { RADIUS 3 } }") == 10, "TO is a direction only"
    assert distance(view % 5 + "SOLID { SPHERE { RADIUS 5 } }") == 5


def test_a_profiles_layers():
    profile = plot.temperature_profile(merman().build())
    z, t = np.array(MERMAN_PROFILE).T
    np.testing.assert_allclose(profile.gradient, np.diff(t) / np.diff(z))
    np.testing.assert_allclose(profile.layers.curvature - profile.layers.effective, EARTH_CURVATURE)
    # Thesis eq. 2.3 by hand, in the middle of the steepest layer, with the pressure of 2.23 m.
    steepest = int(profile.gradient.argmax())
    middle = 273.15 + (t[steepest] + t[steepest + 1]) / 2
    pressure = 101325 * math.exp(-3.48e-3 * 9.80665 * z[steepest : steepest + 2].mean() / 277.5)
    density = 3.48e-3 * pressure / middle
    expected = 226e-6 * density * (profile.gradient[steepest] + 3.48e-3 * 9.80665) / middle
    assert profile.layers.curvature[steepest] == pytest.approx(expected, rel=1e-3)
    with pytest.raises(SceneError, match="no MIRAGE"):
        plot.temperature_profile(SceneBuilder().build())


def test_layers_end_at_the_elevation_limit():
    low = SceneBuilder((0, 0, 2), (1, 0, 2)).mirage([(0, 10), (1, 10.1), (3, 12), (5, 10)], elevation=2.0)
    profile = plot.temperature_profile(low.build())
    assert profile.layers.top.tolist() == [1, 2]
    assert len(profile.gradient) == 2
