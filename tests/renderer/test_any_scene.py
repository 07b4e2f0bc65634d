"""Scenes that nobody would want a picture of: each has one, or is refused in words; and what is asked for beside a
picture, or how it is divided, never changes it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from scene_builder import SceneBuilder, view

import m3d_render
import m3dc
from fuzz import kernel
from m3d_language.table import LANGUAGE
from m3d_render import RenderOptions
from m3d_render.optics import trace_paths
from m3dc.ir import Ambient, LightKind, Triple

SCENES = Path(__file__).parent / "scenes"
BEYOND_REACH = {"ball-beyond-reach", "light-beyond-reach"}
ENDLESS = {"endless-segments", "endless-segments-met"}


def compiled(name: str):
    return m3dc.compile((SCENES / f"{name}.m3d").read_bytes()).ir


@pytest.mark.parametrize("name", sorted({path.stem for path in SCENES.iterdir()} - BEYOND_REACH - ENDLESS))
def test_a_picture_depends_on_nothing_else(name: str):
    ir = compiled(name)
    options: RenderOptions = {"width": 16, "height": 10, "samples": 2, "refract_reflections": True, "shadows": True}
    scene = m3d_render.prepare(ir)
    whole = scene.render(**options).picture
    found = kernel.divided(ir, scene, whole, {**options, "normalize": False})
    assert found is None


@pytest.mark.parametrize("name", sorted(BEYOND_REACH))
def test_what_no_arithmetic_holds_is_refused(name: str):
    with pytest.raises(m3d_render.SceneError, match=r"spheres\.radius, row \d, is .*e1.*: up to 1e75 can be rendered"):
        m3d_render.prepare(compiled(name))


@pytest.mark.parametrize("name", sorted(ENDLESS))
def test_a_ray_without_end_is_cut_and_can_be_stopped(name: str):
    ir = compiled(name)
    paths = trace_paths(ir, [1e-4, -1e-5], at=[1e15])
    assert paths.ends.tolist() == ["segments"] * 2
    assert paths.arcs.tolist() == [1_000_000] * 2
    with pytest.raises(m3d_render.Cancelled):
        m3d_render.render(ir, width=4000, height=4000, samples=64, cancel=lambda: True)


def garden(scale: float = 1.0, hidden: Sequence[Triple] = ()):
    """Shapes of all kinds, seen along the x axis: the middle row's rays are exactly level."""
    scene = SceneBuilder()

    def at(*coordinates: float):
        return tuple(scale * x for x in coordinates)

    scene.set(
        view=view(at(9, 0.5, 1), at(0, 0.5, 1), 50, 33, 21),
        shadows=True,
        depth=4,
        ambient=Ambient(0.3, (1, 1, 1), 2, 3),
    )
    scene.light(direction=(-0.5, 0.3, -0.8))
    scene.light(kind=LightKind.POINT, position=at(3, 4, 5))
    mirror = scene.solid(color=(0.2, 0.4, 0.6), specular=0.7, hard=0.9, refindex=1.4, rough=0.3)
    scene.sphere(at(0, 0, 1), 1.25 * scale, mirror)
    scene.plane([at(0, 0, 0), at(0, 1, 0), at(1, 0, 0)], mirror)
    red = scene.solid(color=(1, 0.25, 0))
    scene.rectangle([at(-4, -3, 4), at(-4, -3, 0), at(-4, 5, 0)], red)
    scene.triangle([at(2, 1, 0), at(2, 3, 0), at(1, 2, 2)], red)
    scene.mesh([at(1, -2, 0), at(1, -1, 0), at(0, -1.5, 0), at(0.5, -1.5, 2)], [(0, 1, 3), (1, 2, 3), (2, 0, 3)], red)
    for center in hidden:
        scene.sphere(center, 2, red)
    return scene.build()


@pytest.mark.parametrize("power", [-60, -20, 10, 30, 40, 45, 55, 58, 60, 66])
def test_a_scene_of_any_size_has_the_same_picture(power: int):
    expected = m3d_render.render(garden())
    assert m3d_render.render(garden(2.0**power)).tobytes() == expected.tobytes()


@pytest.mark.parametrize("far", [1e9, 1e12, 1e15, 1e17, 1e18, 1e20])
def test_what_lies_far_below_the_ground_changes_nothing(far: float):
    hidden = [(far, far, -5), (-far, far, -5), (far, 0, -far), (0, -far, -5)]
    assert m3d_render.render(garden(hidden=hidden)).tobytes() == m3d_render.render(garden()).tobytes()


def test_the_bound_of_arcs_is_the_one_that_is_warned_of():
    text = (SCENES / "endless-segments.m3d").read_text(encoding="utf-8")
    most = LANGUAGE.limits["segments"]
    assert trace_paths(m3dc.compile(text).ir, [1e-4]).arcs.tolist() == [most]
    assert "M3D0508" in {found.code for found in m3dc.compile(text).diagnostics}
    enough = m3dc.compile(text.replace("2147483647", str(most)))
    assert "M3D0508" not in {found.code for found in enough.diagnostics}
