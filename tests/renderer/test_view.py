"""What m3d-view shows, in numbers: no pyvista is needed for it."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from concurrent.futures import Executor, Future
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar

import numpy as np
import pytest
from at_once import AtOnce
from exit_status import exit_status
from scene_builder import MERMAN_PROFILE, SceneBuilder

import m3dc
from m3d_render.geometry import sphere
from m3d_render.geometry.shape import Triangles
from m3d_render.optics import trace_paths
from m3d_render.rendering import SceneError
from m3d_render.sight import view_angles
from m3d_render.view.axes import axes
from m3d_render.view.bodies import bodies, primitive_colors
from m3d_render.view.cli import main
from m3d_render.view.description import describe
from m3d_render.view.fan import fan
from m3d_render.view.follower import Follower
from m3d_render.view.ground import ground, places_of_interest, round_down
from m3d_render.view.marks import extent_box, frustum, light_marks
from m3d_render.view.opening import Fault, Opened, open_scene
from m3d_render.view.viewpoint import From, viewpoint
from m3dc.ir import PrimitiveKind, SceneIR, m3ir

T = TypeVar("T")


@pytest.fixture(scope="module")
def merman(examples: Path):
    return compiled((examples / "merman.m3d").read_text())


def compiled(text: str):
    result = m3dc.compile(text)
    assert result.ok, result.diagnostics
    return result.ir


def area(mesh: Triangles, primitive: int):
    a, b, c = np.moveaxis(mesh.points[mesh.corners[mesh.primitives == primitive]], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


# --- bodies -------------------------------------------------------------------------------------------------------


def test_flat_things_are_the_triangles_of_the_scene():
    mesh, _ = bodies(
        compiled(
            "SOLID { TRIANGLE { VERTEX1 <0,0,2> VERTEX2 <0,0,0> VERTEX3 <3,0,0> } SPHERE { } }"
            "SOLID { RECTANGLE { VERTEX1 <0,0,2> VERTEX2 <0,0,0> VERTEX3 <5,0,0> } }"
            "SOLID { POLYGONS { VERTICES { 4 <0,0,0> <1,0,0> <1,1,0> <0,1,0> } FACETS { 2 0 1 2 0 2 3 } } }"
            "SOLID { TERRAIN { VERTICES { 2 3 <0,0,0> <0,1,0> <0,2,0> <1,0,0> <1,1,0> <1,2,0> } } }"
        )
    )
    assert mesh.primitives.tolist() == [0, 2, 2, 3, 3, 4, 4, 4, 4]
    assert [area(mesh, primitive) for primitive in (0, 2, 3, 4)] == pytest.approx([3, 10, 1, 2])
    assert mesh.normals is None
    np.testing.assert_allclose(mesh.points[mesh.corners[0]], [[0, 0, 2], [0, 0, 0], [3, 0, 0]])


def test_a_sphere_lies_on_its_sphere_and_its_triangles_face_outward():
    _, mesh = bodies(compiled("SOLID { SPHERE { CENTER <1,2,3> RADIUS 4 } }"))
    outward = (mesh.points - (1, 2, 3)) / 4
    np.testing.assert_allclose(np.linalg.norm(outward, axis=1), 1)
    assert mesh.normals is not None
    np.testing.assert_allclose(mesh.normals, outward, atol=1e-12)
    assert area(mesh, 0) == pytest.approx(4 * math.pi * 16, rel=0.01)
    a, b, c = np.moveaxis(outward[mesh.corners], 1, 0)
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) > 0).all()


def test_normals_of_a_phong_mesh_are_the_scenes():
    scene = SceneBuilder()
    corners, normals = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 0, 1), (0, 1, 0), (1, 0, 0), (0, 0, -1)]
    scene.mesh([(9, 9, 9)], [], scene.solid())
    scene.mesh(corners, [(0, 1, 2), (2, 1, 3)], scene.solid(), normals=normals)
    ir = scene.build()
    flat, mesh = bodies(ir)
    np.testing.assert_allclose(mesh.points[mesh.corners[1]], [corners[i] for i in (2, 1, 3)])
    assert mesh.normals is not None
    np.testing.assert_allclose(mesh.normals[mesh.corners[1]], [normals[i] for i in (2, 1, 3)])
    assert mesh.primitives.tolist() == [1, 1]
    assert not len(flat.corners)


def test_colors_are_those_of_surfaces_and_lights():
    ir = compiled(
        "SOLID { SPHERE { } SPHERE { CENTER <5,0,0> } SURFACE { COLOR <1,0,0> } }"
        "LIGHT { SPHERE { } SOURCE { POINT COLOR <0,1,0.5> } }"
    )
    assert primitive_colors(ir).tolist() == [[1, 0, 0], [1, 0, 0], [0, 1, 0.5]]


def test_many_spheres_are_coarser(merman: SceneIR):
    assert [sphere.sides(count) for count in (0, 1, 800, 5_000, 10**7)] == [48, 48, 48, 20, 8]
    # Two triangles a side and parallel, but for the poles.
    assert len(bodies(merman)[1].corners) == 4 * 48 * 2 * 23


def test_an_empty_scene_has_no_bodies():
    ir = compiled("SCENE { }")
    assert not any(len(mesh.corners) for mesh in bodies(ir))
    assert not len(ground(ir).lines)


# --- planes, axes, marks ------------------------------------------------------------------------------------------


def test_a_level_plane_lies_under_all_things_and_the_eye(merman: SceneIR):
    ir = merman
    made = ground(ir)
    assert made.step == 50
    low, high = made.patches.points.min(axis=0), made.patches.points.max(axis=0)
    assert low.tolist() == [-1550, -150, 0]
    assert high.tolist() == [150, 150, 0]
    assert made.patches.primitives.tolist() == [4, 4]
    # 35 lines across, 7 along, at whole multiples of the step.
    assert len(made.lines) == 35 + 7
    np.testing.assert_array_equal(made.lines[:, :, :2] % 50, 0)


def test_a_sloping_plane_is_a_patch_of_itself():
    ir = compiled("SOLID { SPHERE { } } SOLID { PLANE { VERTEX1 <1,0,7> VERTEX2 <0,0,6> VERTEX3 <0,1,6> } }")
    made = ground(ir)
    for points in (made.patches.points, made.lines.reshape(-1, 3)):
        np.testing.assert_allclose(points[:, 2], points[:, 0] + 6, atol=1e-9)


@pytest.mark.parametrize(
    ("length", "step"), [(99, 50), (50, 50), (49, 20), (0.3, 0.2), (1e-7, 1e-7), (0, 1), (math.inf, 1)]
)
def test_steps_are_round(length: float, step: float):
    assert round_down(length) == pytest.approx(step)


def test_axes_have_ticks_at_round_numbers_and_names_at_their_ends(merman: SceneIR):
    made = axes(merman)
    # The box of the things and the eye, from the corner nearest the eye: x is 1 there.
    np.testing.assert_allclose(made.lines[0], [[1, -9, -4], [-1407, -9, -4]])
    np.testing.assert_allclose(made.lines[2], [[1, -9, -4], [1, -9, 8]])
    assert made.texts[:8] == ["-1400", "-1200", "-1000", "-800", "-600", "-400", "-200", "0"]
    np.testing.assert_allclose(made.ticks[:8], [(x, -9, -4) for x in range(-1400, 1, 200)])
    assert made.texts[-3:] == ["x, m", "y, m", "z, m"]
    assert axes(compiled("SOLID { SPHERE { } }")).texts[-3:] == ["x", "y", "z"], "no unit without an atmosphere"


def test_the_frustum_holds_the_corners_of_the_picture():
    ir = compiled(
        "SCENE { VIEW { FROM <10,0,0> TO <0,0,0> FOV 90 WIDTH 200 HEIGHT 100 ASPECT 1.2 } } SOLID { SPHERE { } }"
    )
    lines = frustum(ir)
    np.testing.assert_allclose(lines[:4, 0], [[10, 0, 0]] * 4)
    # 10 ahead and 90 degrees wide: 10 to each side, and 10 * 100/200 * 1.2 up and down; looking along -x, right is +y.
    np.testing.assert_allclose(lines[:4, 1], [[0, -10, -6], [0, 10, -6], [0, 10, 6], [0, -10, 6]], atol=1e-9)


def test_the_extents_are_a_box_of_twelve_edges():
    edges = extent_box(compiled("SOLID { SPHERE { CENTER <1,2,3> RADIUS 1 } }"))
    assert edges.shape == (12, 2, 3)
    ends: list[list[list[float]]] = edges.tolist()
    assert len({frozenset(map(tuple, edge)) for edge in ends}) == 12
    np.testing.assert_array_equal(edges.reshape(-1, 3).min(axis=0), [0, 1, 2])
    np.testing.assert_array_equal(edges.reshape(-1, 3).max(axis=0), [2, 3, 4])
    np.testing.assert_allclose(np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1), 2)


def test_lights_shine_from_where_they_stand():
    ir = compiled(
        "SCENE { SKY { SUN { AZIMUTH 0 ZENITH 0 } } } SOLID { SPHERE { } }"
        "LIGHT { SOURCE { POINT FROM <5,6,7> COLOR <1,0,0> } }"
        "LIGHT { SOURCE { POINT FROM <0,0,9> DIRECTION <0,0,-1> ANGLE 30 } }"
    )
    marks = {mark.name: mark for mark in light_marks(ir)}
    sun, lamp, spot = (marks[name] for name in ("sun", "light 1", "light 2"))
    ((start, end),) = sun.lines
    np.testing.assert_allclose((end - start) / np.linalg.norm(end - start), [0, 0, -1], atol=1e-12)
    assert (lamp.source.tolist(), lamp.color.tolist(), len(lamp.lines)) == ([5, 6, 7], [1, 0, 0], 0)
    rim = spot.lines[1:5, 1] - spot.source
    np.testing.assert_allclose(np.degrees(np.arccos(-rim[:, 2] / np.linalg.norm(rim, axis=1))), 30)


# --- rays ---------------------------------------------------------------------------------------------------------


def test_rays_are_curves_of_the_air_in_the_plane_of_view(merman: SceneIR):
    ir = merman
    made = fan(ir, 9)
    np.testing.assert_allclose(made.angles, np.linspace(*view_angles(ir), 9))
    for angle, curve in zip(made.angles, made.curves, strict=True):
        np.testing.assert_allclose(curve[0], ir.scene.view.eye)
        np.testing.assert_allclose(curve[:, 1], 0, atol=1e-9)
        middle = curve[len(curve) // 2]
        (heights,) = trace_paths(ir, [angle], at=[1 - middle[0]]).heights
        assert middle[2] == pytest.approx(heights[0], abs=1e-6)
    assert made.curves[0][-1, 2] == pytest.approx(0, abs=1e-6), "the lowest ends at the ground"
    assert made.curves[-1][-1, 0] < -1400, "the highest goes beyond the things"


def test_rays_without_air_are_straight():
    ir = compiled("SCENE { VIEW { FROM <0,0,5> TO <0,10,5> FOV 20 } } SOLID { SPHERE { CENTER <0,10,5> } }")
    made = fan(ir, 3)
    for angle, curve in zip(made.angles, made.curves, strict=True):
        assert len(curve) == 2
        assert (curve[1, 2] - 5) / curve[1, 1] == pytest.approx(math.tan(angle))


def test_no_rays_leave_an_eye_outside_of_the_air():
    scene = SceneBuilder((0, 0, 99), (1, 0, 99)).mirage(MERMAN_PROFILE)
    with pytest.raises(SceneError, match="99"):
        fan(scene.build())


# --- viewpoints ---------------------------------------------------------------------------------------------------


def test_the_scenes_camera_is_the_scenes(merman: SceneIR):
    view = viewpoint(merman, "camera", ratio=320 / 240)
    np.testing.assert_allclose(view.position, [1, 0, 2.1])
    ahead = view.target - view.position
    np.testing.assert_allclose(ahead / np.linalg.norm(ahead), [-1, 0, 0], atol=1e-3)
    # FOV 1.5 over the width; 200 * 1.2 rows of its 320 columns above one another.
    assert view.angle == pytest.approx(2 * math.degrees(math.atan(math.tan(math.radians(0.75)) * 240 / 320)))


def test_a_window_of_another_shape_shows_more(merman: SceneIR):
    ir = merman
    wide, fitting, high = (viewpoint(ir, "camera", ratio).angle or 0.0 for ratio in (3, 320 / 240, 0.5))
    assert wide == pytest.approx(fitting)
    assert math.tan(math.radians(high) / 2) * 0.5 == pytest.approx(math.tan(math.radians(0.75)))


@pytest.mark.parametrize("place", ["above", "side"])
@pytest.mark.parametrize("vertical", [1, 40])
def test_a_parallel_view_holds_the_things_and_the_eye(merman: SceneIR, place: From, vertical: float):
    ir = merman
    view = viewpoint(ir, place, ratio=1.6, vertical=vertical)
    ahead = (view.target - view.position) / np.linalg.norm(view.target - view.position)
    seen = places_of_interest(ir) * [1, 1, vertical] - view.target
    assert view.half_height is not None
    assert (np.abs(seen @ view.up) <= view.half_height).all()
    assert (np.abs(seen @ np.cross(ahead, view.up)) <= 1.6 * view.half_height).all()
    assert ((seen + view.target - view.position) @ ahead > 0).all(), "all is before the camera"
    # The direction of view, -x, is to the right.
    np.testing.assert_allclose(np.cross(ahead, view.up), [-1, 0, 0], atol=1e-3)


# --- names and descriptions ---------------------------------------------------------------------------------------

BALLS = """VARIABLES { SOLID ball; }
ball = { SPHERE { RADIUS 2 TRANSFORM { TRANSX 3 } } SPHERE { } }
SOLID ball { TRANSFORM { SCALE <2,2,2> } } /* the great one */
SOLID ball
SOLID { PLANE { } }
"""


def test_a_thing_is_described_with_its_name_place_and_matrices(tmp_path: Path):
    (tmp_path / "balls.m3d").write_text(BALLS)
    opened = open_scene(str(tmp_path / "balls.m3d"))
    assert isinstance(opened, Opened)
    assert describe(opened, 0).splitlines() == [
        "the great one (ball)",
        "solid 0, line 3",
        "sphere 1 of 2, line 2",
        "color < 1, 1, 1 >",
        "",
        "matrix of the solid:",
        "         2          0          0          0",
        "         0          2          0          0",
        "         0          0          2          0",
        "         0          0          0          1",
        "matrix of the primitive:",
        "         1          0          0          0",
        "         0          1          0          0",
        "         0          0          1          0",
        "         3          0          0          1",
    ]
    assert describe(opened, 3).splitlines()[:3] == ["ball", "solid 1, line 4", "sphere 2 of 2, line 2"]
    assert describe(opened, 4).splitlines()[:3] == ["solid 2", "solid 2, line 5", "plane, line 5"]
    assert describe(opened, 4).endswith("matrix of the solid: identity\nmatrix of the primitive: identity")


def test_things_of_a_compiled_scene_go_by_their_numbers(tmp_path: Path):
    m3ir.write(m3dc.compile(BALLS, "balls.m3d").ir, tmp_path / "balls.m3ir")
    opened = open_scene(str(tmp_path / "balls.m3ir"))
    assert isinstance(opened, Opened)
    lines = describe(opened, 0).splitlines()
    assert lines[:2] == ["solid 0", f"solid 0, byte {BALLS.index('SOLID ball {')} of balls.m3d"]


# --- the file -----------------------------------------------------------------------------------------------------


class Later(Executor):
    """Does no work before it is told to."""

    def __init__(self):
        self.waiting: list[Callable[[], None]] = []

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        future: Future[T] = Future()
        self.waiting.append(lambda: future.set_result(fn(*args, **kwargs)))
        return future


@pytest.fixture
def scene(tmp_path: Path):
    path = tmp_path / "scene.m3d"
    path.write_text("SOLID { SPHERE { } }")
    return path


def save(path: Path, text: str) -> None:
    """As editors do: a new file takes the old one's place."""
    (path.parent / "new").write_text(text)
    (path.parent / "new").replace(path)


def test_a_follower_tells_what_a_file_becomes(scene: Path):
    follower = Follower(scene, AtOnce())
    assert follower.poll() is None
    save(scene, "SOLID { SPHERE { RADIUS 7 } }")
    found = follower.poll()
    assert isinstance(found, Opened)
    assert found.ir["spheres"]["radius"].tolist() == [7]
    assert follower.poll() is None
    save(scene, "SOLID {\n SPHERE { RADIUS -1 } }")
    fault = follower.poll()
    assert isinstance(fault, Fault)
    assert (fault.status, fault.summary) == (1, "line 2: Sphere radius must be > 0")
    assert "RADIUS -1" in fault.report
    scene.unlink()
    gone = follower.poll()
    assert isinstance(gone, Fault)
    assert "not there any more" in gone.summary
    assert follower.poll() is None
    scene.write_text("SOLID { SPHERE { RADIUS 8 } }")
    assert isinstance(follower.poll(), Opened)


def test_a_follower_waits_for_nothing_and_misses_nothing(scene: Path):
    work = Later()
    follower = Follower(scene, work)
    save(scene, "SOLID { SPHERE { RADIUS 7 } }")
    assert follower.poll() is None
    assert follower.poll() is None, "it is being read"
    work.waiting.pop()()
    save(scene, "SOLID { SPHERE { RADIUS 123 } }")
    first = follower.poll()
    assert isinstance(first, Opened)
    assert follower.poll() is None
    work.waiting.pop()()
    second = follower.poll()
    assert isinstance(second, Opened)
    assert second.ir["spheres"]["radius"].tolist() == [123]


# --- errors for people --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (["nix.m3d"], 2, "nix.m3d: No such file"),
        (["broken.m3d"], 1, "RADIUS -1"),
        (["scene.m3d", "--screenshot", "a.gif"], 2, "one of .png, "),
        (["scene.m3d", "--screenshot", "nix/a.png"], 2, "make it first"),
        (["scene.m3d"], 2, "DISPLAY is not set"),
        (["scene.m3d", "--vertical", "0"], 2, "0 is not from 0.001"),
        (["scene.m3d", "--hide", "rays,trees"], 2, "'trees' is none of rays, camera"),
        (["scene.m3d", "--size", "9x9"], 2, "9 is not from 16"),
    ],
)
def test_what_goes_wrong_is_explained(
    scene: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    status: int,
    message: str,
):
    monkeypatch.chdir(scene.parent)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    there = ModuleType("pyvista")
    there.__spec__ = ModuleSpec("pyvista", None)
    monkeypatch.setitem(sys.modules, "pyvista", there)
    Path("broken.m3d").write_text("SOLID { SPHERE { RADIUS -1 } }")
    assert exit_status(main, arguments) == status
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [["--screenshot", "a.png"], []])
def test_without_pyvista_it_says_how_to_get_it(
    scene: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], arguments: list[str]
):
    """Whatever else is missing, a display or what draws without one."""
    monkeypatch.chdir(scene.parent)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setattr("m3d_render.view.backend._WITHOUT_DISPLAY", ())
    monkeypatch.setitem(sys.modules, "pyvista", None)
    assert main([str(scene), *arguments]) == 2
    assert 'pip install "mirage3d[view]"' in capsys.readouterr().err


def test_meshes_hold_every_primitive_but_planes(examples: Path):
    for path in sorted(examples.glob("*.m3d")):
        ir = m3dc.compile(path.read_bytes()).ir
        shown = [*bodies(ir), ground(ir).patches]
        primitives = np.unique(np.concatenate([mesh.primitives for mesh in shown]))
        np.testing.assert_array_equal(primitives, np.arange(len(ir["primitives"]["kind"])), path.name)
        planes = ir["primitives"]["kind"] == PrimitiveKind.PLANE
        np.testing.assert_array_equal(np.unique(shown[2].primitives), np.flatnonzero(planes))
