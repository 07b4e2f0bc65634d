"""Pictures of m3d-view and what its window does, drawn by pyvista without a display.

pyvista is brought by `make viewer`. Where it is missing these tests are skipped, but in CI they fail.
"""

from __future__ import annotations

import importlib.util
import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest
from array_types import Floats
from at_once import AtOnce
from numpy.typing import ArrayLike, NDArray
from pictures import float_pixels
from scene_builder import MERMAN_PROFILE, SceneBuilder

import m3dc
from m3d_render.sight import view_angles
from m3d_render.view.backend import load_pyvista
from m3d_render.view.cli import main
from m3d_render.view.follower import Follower
from m3d_render.view.opening import Opened, open_scene
from m3d_render.view.stage import LAYERS, Stage
from m3d_render.view.viewpoint import fitting_vertical
from m3d_render.view.window import Window
from m3dc.ir import Triple

pytestmark = pytest.mark.slow

RED, GREEN, BLUE, YELLOW = (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)

# A camera whose picture of the plane x = 0 maps y and z to pixels two to one: 201 pixels for -50..50.
VIEW = "SCENE { VIEW { FROM < 50, 0, 0 > TO < 0, 0, 0 > FOV 90 WIDTH 201 HEIGHT 201 } }"
SIZE = ["--size", "201x201"]
THINGS = (
    VIEW
    + """
SOLID /* a ball */ { SPHERE { CENTER < 0, -20, 20 > RADIUS 8 } SURFACE { COLOR < 1, 0, 0 > } }
SOLID { RECTANGLE { VERTEX1 <0,12,28> VERTEX2 <0,12,12> VERTEX3 <0,28,12> } SURFACE { COLOR < 0, 1, 0 > } }
SOLID { TRIANGLE { VERTEX1 <0,-28,-28> VERTEX2 <0,-12,-28> VERTEX3 <0,-20,-12> } SURFACE { COLOR < 0, 0, 1 > } }
SOLID {
    POLYGONS { VERTICES { 4 <0,12,-28> <0,28,-28> <0,28,-12> <0,12,-12> } FACETS { 2 0 1 2 0 2 3 } }
    SURFACE { COLOR < 1, 1, 0 > }
}
"""
)
ALL = ",".join(LAYERS)

Shoot: TypeAlias = Callable[..., NDArray[np.float32]]


@pytest.fixture(scope="session")
def pyvista():
    if importlib.util.find_spec("pyvista") is None:
        missing = pytest.fail if os.environ.get("CI") == "true" else pytest.skip
        missing("pyvista is not installed: make viewer")
    return load_pyvista(window=False)


@pytest.fixture
def shot(pyvista: Any, tmp_path: Path):
    """Writes a scene, runs the command, and gives its picture: rows x columns x 3, 0..1."""

    def shoot(text: str, *options: str):
        (tmp_path / "scene.m3d").write_text(text)
        assert main([str(tmp_path / "scene.m3d"), "--screenshot", str(tmp_path / "view.png"), *SIZE, *options]) == 0
        return float_pixels(tmp_path / "view.png")[..., :3]

    return shoot


def at(picture: NDArray[np.floating], y: float, z: float):
    """The pixel of the point (0, y, z)."""
    return picture[round(100 - 2 * z), round(100 + 2 * y)]


def is_color(pixels: ArrayLike, color: Triple):
    """Whether pixels have a colour, in more or less light: full channels are bright and alike, empty ones dark."""
    pixels, full = np.asarray(pixels), np.array(color, bool)
    lit = pixels[..., full].min(axis=-1)
    return (lit > 0.3) & (pixels[..., full].max(axis=-1) - lit < 0.1) & (pixels[..., ~full].max(axis=-1) < 0.1)


def test_solids_are_in_their_colors_where_the_camera_sees_them(shot: Shoot):
    picture = shot(THINGS, "--hide", ALL)
    for y, z, color in ((-20, 20, RED), (20, 20, GREEN), (-20, -21, BLUE), (20, -20, YELLOW)):
        assert is_color(at(picture, y, z), color), (y, z)
    rows, columns = np.nonzero(is_color(picture, GREEN))
    np.testing.assert_allclose([rows.min(), rows.max()], [100 - 56, 100 - 24], atol=1.5)
    np.testing.assert_allclose([columns.min(), columns.max()], [100 + 24, 100 + 56], atol=1.5)


def test_a_plane_is_a_patch_below_the_things(shot: Shoot):
    plane = "SOLID { PLANE { TRANSFORM { TRANSZ -10 } } SURFACE { COLOR < 0, 1, 0 > } } SOLID { SPHERE { RADIUS 9 } }"
    picture = shot(VIEW + plane, "--hide", "rays,camera,lights,extents,axes")
    assert is_color(picture[140:], GREEN).mean() > 0.5
    assert not is_color(picture[:95], GREEN).any()
    assert not is_color(shot(VIEW + plane, "--hide", ALL), GREEN).any()


def test_rays_are_drawn_along_their_paths(shot: Shoot):
    scene = (
        "SCENE { VIEW { FROM < 40, 0, 0 > TO < -40, 0, 0 > FOV 90 } } SOLID { SPHERE { CENTER <-40,0,0> RADIUS 1 } }"
    )
    only_rays = ["--from", "side", "--hide", "camera,lights,extents,ground,axes"]
    with_rays, without = shot(scene, *only_rays, "--rays", "3"), shot(scene, *only_rays, "--rays", "0")
    drawn = np.abs(with_rays - without).max(axis=-1) > 0.1
    # Below the middle is the list of colours. A level ray is a line in the middle, another rises evenly.
    rows, columns = np.nonzero(drawn[:101])
    level, upper = columns[rows == 100], rows < 95
    assert len(level) > 150
    _, steepest = view_angles(m3dc.compile(scene).ir)
    np.testing.assert_allclose(columns[upper], level.min() + (100 - rows[upper]) / math.tan(steepest), atol=3)
    assert set(rows[upper]) == set(range(95))


@pytest.mark.parametrize(
    ("scene", "vertical"), [("merman", 20), ("fata-morgana", 50), ("wheel", 1), ("two-balls", 1), ("terrain", 1)]
)
def test_heights_are_stretched_from_the_side_where_little_would_be_seen(examples: Path, scene: str, vertical: float):
    ir = m3dc.compile((examples / f"{scene}.m3d").read_bytes()).ir
    assert fitting_vertical(ir, "side", 1.6) == vertical
    assert fitting_vertical(ir, "camera", 1.6) == fitting_vertical(ir, "above", 1.6) == 1


def test_what_is_done_with_heights_is_said(shot: Shoot, examples: Path, capsys: pytest.CaptureFixture[str]):
    shot((examples / "merman.m3d").read_text(), "--from", "side")
    assert "from the side, heights stretched 20 times, or little would be seen" in capsys.readouterr().err


def test_automatic_heights_follow_the_viewpoint_until_a_key_changes_them(pyvista: Any, examples: Path):
    stage = Stage(pyvista, size=(160, 100), off_screen=True, rays=3)
    opened = open_scene(str(examples / "merman.m3d"))
    assert isinstance(opened, Opened)
    stage.show(opened)
    stage.look("camera")
    window = Window(stage, "merman.m3d")
    heights = [stage.vertical]
    for key in "3", "2", "3", "plus", "1":
        window.press(key)
        heights.append(stage.vertical)
    assert heights == [1, 20, 1, 20, 40, 40]
    stage.plotter.close()


def test_heights_are_stretched(shot: Shoot):
    ball = VIEW + "SOLID { SPHERE { RADIUS 5 } SURFACE { COLOR < 1, 0, 0 > } }"
    plain, stretched = (shot(ball, "--hide", ALL, "--from", "side", "--vertical", n) for n in "14")

    def shape(picture: NDArray[np.floating]):
        rows, columns = np.nonzero(is_color(picture, RED))
        return np.ptp(rows) / np.ptp(columns)

    assert shape(plain) == pytest.approx(1, abs=0.15)
    assert shape(stretched) == pytest.approx(4, abs=0.6)


def test_a_click_tells_what_is_there(shot: Shoot, capsys: pytest.CaptureFixture[str]):
    shot(THINGS, "--hide", ALL, "--pick", "60,60")
    assert capsys.readouterr().out.splitlines()[:4] == [
        "a ball",
        "solid 0, line 2",
        "sphere, line 2",
        "color < 1, 0, 0 >",
    ]
    shot(THINGS, "--hide", ALL, "--pick", "100,100")
    assert capsys.readouterr().out == "nothing is there\n"


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".tif", ".bmp"])
def test_pictures_have_their_formats(pyvista: Any, tmp_path: Path, suffix: str):
    (tmp_path / "scene.m3d").write_text(THINGS)
    picture = tmp_path / f"view{suffix}"
    assert main([str(tmp_path / "scene.m3d"), "--screenshot", str(picture), *SIZE]) == 0
    assert float_pixels(picture).shape[:2] == (201, 201)


# --- the window ---------------------------------------------------------------------------------------------------


@pytest.fixture
def window(pyvista: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """A window that nobody sees, on a file of things."""
    monkeypatch.chdir(tmp_path)
    Path("scene.m3d").write_text(THINGS)
    follower = Follower(Path("scene.m3d"), AtOnce())
    stage = Stage(pyvista, size=(201, 201), off_screen=True, rays=5, hidden=LAYERS)
    opened = open_scene("scene.m3d")
    assert isinstance(opened, Opened)
    stage.show(opened)
    stage.look("camera")
    window = Window(stage, "scene.m3d", follower)
    window.press("h")
    yield window
    stage.plotter.close()


def picture(window: Window) -> Floats:
    window.stage.plotter.render()
    return np.asarray(window.stage.plotter.screenshot(return_img=True)) / 255


CORNERS = ("lower_left", "lower_right", "upper_left", "upper_right")


def written(window: Window, where: str) -> str:
    actor = window.stage.plotter.actors.get(where)
    return actor.GetText(CORNERS.index(where)) if actor is not None else ""


def save(text: str):
    Path("new").write_text(text)
    Path("new").replace("scene.m3d")


def test_the_window_follows_the_file(window: Window, capsys: pytest.CaptureFixture[str]):
    assert not window.tick()
    assert is_color(at(picture(window), -20, 20), RED)

    save(THINGS.replace("COLOR < 1, 0, 0 >", "COLOR < 0, 0, 1 >"))
    assert window.tick()
    assert is_color(at(picture(window), -20, 20), BLUE)

    save(THINGS.replace("RADIUS 8", "RADIUS -8"))
    assert window.tick()
    assert "line 2: Sphere radius must be > 0" in written(window, "upper_left")
    assert "error[M3D0401]" in capsys.readouterr().err
    assert is_color(at(picture(window), -20, 20), BLUE), "the last good scene is still there"

    save(THINGS)
    assert window.tick()
    assert "radius" not in written(window, "upper_left")
    assert is_color(at(picture(window), -20, 20), RED)


def test_a_camera_that_was_moved_stays_when_the_file_changes(window: Window):
    nearer = VIEW.replace("50, 0, 0", "25, 0, 0")
    camera = window.stage.plotter.camera
    save(THINGS.replace(VIEW, nearer))
    window.tick()
    assert camera.position == pytest.approx((25, 0, 0)), "not moved by hand, it is the scene's"
    camera.position = (30, 1, 2)
    save(THINGS)
    window.tick()
    assert camera.position == pytest.approx((30, 1, 2))
    window.press("plus")
    assert camera.position == pytest.approx((30, 1, 4)), "it moves with the heights"
    window.press("1")
    assert camera.position == pytest.approx((50, 0, 0))


@pytest.mark.parametrize(("key", "eye"), [*((key, "50, 0, 0") for key in "123"), ("1", "0, 0, 50"), ("1", "0, 0, -50")])
def test_a_camera_that_is_to_be_turned_is_upright_and_sees_the_same(window: Window, key: str, eye: str):
    save(THINGS.replace(VIEW, VIEW.replace("50, 0, 0", eye)))
    window.tick()
    window.press(key)
    camera = window.stage.plotter.camera

    def directions():
        ahead = np.subtract(camera.focal_point, camera.position)
        right = np.cross(ahead, camera.up)
        return ahead / np.linalg.norm(ahead), right / np.linalg.norm(right)

    before = directions()
    window.stage.upright()
    assert camera.up == (0, 0, 1)
    np.testing.assert_allclose(directions(), before, atol=0.05)
    save(THINGS.replace(VIEW, VIEW.replace("50, 0, 0", "25, 0, 0")))
    window.tick()
    assert key != "1" or camera.position == pytest.approx((25, 0, 0)), "that was no move by hand"


@pytest.mark.parametrize("key", "rcba")
def test_a_key_shows_a_layer_and_hides_it_again(window: Window, key: str):
    window.press("3")
    hidden = picture(window)
    window.press(key)
    shown = picture(window)
    window.press(key)
    assert (shown != hidden).any()
    np.testing.assert_array_equal(picture(window), hidden)


def test_a_wireframe_lets_one_look_through(window: Window):
    assert is_color(at(picture(window), 20, -18), YELLOW)
    window.press("w")
    assert not is_color(at(picture(window), 20, -18), YELLOW)
    window.press("w")
    assert is_color(at(picture(window), 20, -18), YELLOW)


def test_keys_are_written_on_the_screen(window: Window):
    assert written(window, "lower_left").split() == ["h", "keys"]
    window.press("h")
    for key in ("r  rays", "c  camera", "b  box", "w  wireframe", "1  from the scene's camera", "click: what it is"):
        assert key in written(window, "lower_left")


def test_a_click_names_a_solid_and_a_click_beside_it_none(window: Window):
    assert window.click(60, 60).startswith("a ball\n")
    assert "a ball" in written(window, "upper_right")
    assert window.click(100, 100) == ""
    assert written(window, "upper_right") == ""


def test_a_hidden_plane_is_not_hit(window: Window):
    save(THINGS + "SOLID /* floor */ { PLANE { TRANSFORM { TRANSZ -40 } } }")
    window.tick()
    assert window.click(100, 195) == ""
    window.press("g")
    assert window.click(100, 195).startswith("floor")


def test_an_eye_outside_of_the_air_has_no_rays_and_is_told_so(window: Window):
    scene = SceneBuilder((0, 0, 99), (1, 0, 99)).mirage(MERMAN_PROFILE)
    scene.sphere((10, 0, 99), 3, scene.solid(color=RED))
    window.stage.show(Opened(scene.build(), None))
    window.press("1")
    assert "no rays: " in written(window, "upper_left")
    assert is_color(picture(window)[100, 100], RED)
