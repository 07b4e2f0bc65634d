"""Wireframe pictures: edges where geometry says, drawn where the camera says."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest
from exit_status import exit_status
from numpy.typing import NDArray

import m3dc
from m3d_render import wireframe
from m3d_render.cli import main

# A camera whose picture of the plane x = 0 maps y and z to pixels one to one: 101 pixels for -50..50.
VIEW = "SCENE { SKY { } VIEW { FROM < 50, 0, 0 > TO < 0, 0, 0 > FOV 90 WIDTH 101 HEIGHT 101 } }"


def drawn(text: str) -> NDArray[np.bool_]:
    result = m3dc.compile(VIEW + text)
    assert result.ok
    return np.any(wireframe.draw(result.ir), axis=-1)


def edge_count(text: str) -> int:
    return sum(len(group.starts) for group in wireframe.edges(m3dc.compile(text).ir))


def test_edges_of_each_primitive() -> None:
    assert edge_count("SOLID { TRIANGLE { } }") == 3
    assert edge_count("SOLID { RECTANGLE { } }") == 4
    cube = "VERTICES { 4 <0,0,0> <1,0,0> <1,1,0> <0,1,0> } FACETS { 2 0 1 2 0 2 3 }"
    assert edge_count(f"SOLID {{ POLYGONS {{ {cube} }} }}") == 5, "the shared edge once"
    assert edge_count("LIGHT { SPHERE { } SOURCE { POINT } }") == 7 * wireframe.CIRCLE_STEPS


def test_a_rectangle_is_drawn_where_the_camera_sees_it() -> None:
    seen = drawn("SOLID { RECTANGLE { VERTEX1 <0,-20,10> VERTEX2 <0,-20,-10> VERTEX3 <0,30,-10> } }")
    rows, columns = np.nonzero(seen)
    # Row and column 50 are the middle; up is up, and y grows to the right as one looks along -x.
    assert (rows.min(), rows.max()) == (40, 60)
    assert (columns.min(), columns.max()) == (30, 80)
    assert seen[40:61, 30].all()
    assert seen[40, 30:81].all()
    assert not seen[41:60, 31:80].any()


def test_a_spheres_edges_lie_on_it() -> None:
    (group,) = wireframe.edges(m3dc.compile("SOLID { SPHERE { CENTER <1,2,3> RADIUS 4 } }").ir)
    np.testing.assert_allclose(np.linalg.norm(group.starts - (1, 2, 3), axis=1), 4)


def test_the_nearer_line_hides_the_farther_one() -> None:
    ir = m3dc.compile(
        VIEW
        + "SOLID { RECTANGLE { VERTEX1 <0,-20,10> VERTEX2 <0,-20,-10> VERTEX3 <0,20,-10> } SURFACE { COLOR <1,0,0> } }"
        + "SOLID { RECTANGLE { VERTEX1 <25,-10,5> VERTEX2 <25,-10,-5> VERTEX3 <25,10,-5> } SURFACE { COLOR <0,1,0> } }"
    ).ir
    picture = wireframe.draw(ir)
    assert picture[picture.any(axis=-1)].tolist() == [[0, 1, 0]] * int(picture.any(axis=-1).sum())


@pytest.mark.parametrize("x", [49.9999, 50.0, 60.0])
def test_lines_at_and_behind_the_eye_are_cut_off(x: float) -> None:
    seen = drawn(f"SOLID {{ RECTANGLE {{ VERTEX1 <{x},-3,-1> VERTEX2 <0,-3,-1> VERTEX3 <0,3,-1> }} }}")
    assert seen.any()


def test_a_scene_behind_the_eye_is_black() -> None:
    assert not drawn("SOLID { SPHERE { CENTER <90,0,0> } }").any()


def test_black_things_are_seen() -> None:
    ir = m3dc.compile(VIEW + "SOLID { SPHERE { } SURFACE { COLOR <0,0,0> } }").ir
    assert wireframe.draw(ir).max() > 0.3
    white = m3dc.compile(VIEW + "SOLID { SPHERE { } SURFACE { COLOR <1,1,1> } }").ir
    assert wireframe.draw(white, paper="white").min() < 0.7


def test_tilt_turns_the_picture() -> None:
    scene = VIEW.replace("FOV 90", "FOV 90 TILT 90") + "SOLID { TRIANGLE { VERTEX1 <0,0,20> VERTEX2 <0,1,19> } }"
    rows, columns = np.nonzero(wireframe.draw(m3dc.compile(scene).ir).any(axis=-1))
    assert math.hypot(rows.mean() - 50, columns.mean() - 50) > 5
    assert columns.min() < 35, "turned clockwise, the observer's up points right, and what is above moves left"


# --- hidden lines ---------------------------------------------------------------------------------------------------

SCREEN = (
    "SOLID { RECTANGLE { VERTEX1 <10,-10,20> VERTEX2 <10,-10,-20> VERTEX3 <10,10,-20> } SURFACE { COLOR <0,1,0> } }"
)
BAR = "SOLID { RECTANGLE { VERTEX1 <0,-40,1> VERTEX2 <0,-40,-1> VERTEX3 <0,40,-1> } SURFACE { COLOR <1,0,0> } }"


def red(hidden: wireframe.Hidden) -> NDArray[np.float32]:
    return wireframe.draw(m3dc.compile(VIEW + SCREEN + BAR).ir, hidden=hidden)[..., 0]


def test_what_a_surface_covers_is_removed_or_dashed() -> None:
    shown, dimmed, removed = (red(hidden)[49] > 0 for hidden in ("show", "dim", "remove"))
    # The screen is at 40 of the eye's 50 before the bar, and so covers 10 * 50 / 40 = 12.5 pixels on each side.
    covered = np.abs(np.arange(101) - 50) <= 12
    assert shown[10:91].sum() == 79, "all but two pixels, where the screen's own edges cross"
    assert not removed[covered].any()
    assert removed[10:91].sum() == 81 - 25, "what lies beside the screen"
    assert 0 < dimmed[covered].sum() < 15
    np.testing.assert_array_equal(dimmed[~covered], removed[~covered])
    assert red("dim")[49, covered].max() < 0.7 < red("dim")[49, 20]


def test_a_spheres_far_side_is_hidden_by_itself() -> None:
    ir = m3dc.compile(VIEW + "SOLID { SPHERE { CENTER <0,0,0> RADIUS 20 } }").ir
    (thing,) = wireframe.project(ir, hidden="dim").things
    ahead = 1 / thing.starts[:, 2]
    # What touches the sphere from the eye is 50 - 20^2/50 ahead.
    edge = 50 - 20**2 / 50
    assert thing.hidden[ahead > edge + 0.1].all()
    assert not thing.hidden[(ahead < edge - 0.1) & (1 / thing.ends[:, 2] < edge - 0.1)].any()
    assert thing.hidden.any()


def test_an_edge_is_not_hidden_by_the_facets_it_borders() -> None:
    roof = (
        "VERTICES { 6 <5,-9,0> <5,9,0> <0,-9,0.8> <0,9,0.8> <-5,-9,0> <-5,9,0> } FACETS { 4 0 1 3 0 3 2 4 2 3 4 3 5 }"
    )
    ir = m3dc.compile(VIEW.replace("< 50, 0, 0 >", "< 50, 3, 20 >") + f"SOLID {{ POLYGONS {{ {roof} }} }}").ir
    (thing,) = wireframe.project(ir, hidden="dim").things
    assert not thing.hidden.any(), "both sides of a flat roof are seen from above it"


# --- from above, and marks ------------------------------------------------------------------------------------------

LONG = "SCENE { SKY { } VIEW { FROM < 100, 0, 2 > TO < 0, 0, 2 > WIDTH 200 HEIGHT 100 } } SOLID { %s }"


def test_from_above_the_longer_side_lies_across() -> None:
    runway = "RECTANGLE { VERTEX1 < -80, -5, 0 > VERTEX2 < 80, -5, 0 > VERTEX3 < 80, 5, 0 > }"
    drawing = wireframe.project(m3dc.compile(LONG % runway).ir, from_above=True)
    (thing,) = drawing.things
    columns, rows = np.ptp(thing.starts[:, 0]), np.ptp(thing.starts[:, 1])
    assert columns / rows == pytest.approx(16, rel=0.01)
    assert 180 < columns < 199, "nearly all of the width"
    # The camera looks along -x, which is to the right here, and its left, -y, is up.
    right_most = thing.starts[thing.starts[:, 0].argmax()]
    assert right_most[0] > 100
    wide = "RECTANGLE { VERTEX1 < -5, -80, 0 > VERTEX2 < 5, -80, 0 > VERTEX3 < 5, 80, 0 > }"
    (thing,) = wireframe.project(m3dc.compile(LONG % wide).ir, from_above=True).things
    assert np.ptp(thing.starts[:, 0]) > 180, "a broad scene has the direction of view upward"


def test_the_frustum_from_above_has_the_views_angle() -> None:
    ir = m3dc.compile(LONG.replace("TO", "FOV 30 TO") % "SPHERE { }").ir
    things = {thing.name: thing for thing in wireframe.project(ir, from_above=True, show=["frustum"]).things}
    starts, ends = things["frustum"].starts[:4, :2], things["frustum"].ends[:4, :2]
    ways = (ends - starts) / np.linalg.norm(ends - starts, axis=1)[:, None]
    angles = np.degrees(np.arccos(np.clip(ways @ ways.T, -1, 1)))
    assert angles.max() == pytest.approx(30, abs=0.5)


def test_lights_and_axes() -> None:
    text = VIEW + "SOLID { SPHERE { RADIUS 9 } } LIGHT { SOURCE { POINT FROM < 0, 20, 20 > } }"
    ir = m3dc.compile(text).ir
    things = {thing.name: thing for thing in wireframe.project(ir, show=wireframe.MARKS).things}
    assert {"solid-0", "light-0", "light-1", "axes", "frustum"} >= set(things) >= {"solid-0", "light-1", "axes"}
    star = (things["light-1"].starts + things["light-1"].ends)[:, :2] / 2
    np.testing.assert_allclose(star.mean(axis=0), [70, 30], atol=0.3)
    with pytest.raises(ValueError, match="no mark sun"):
        wireframe.project(ir, show=["sun"])


# --- SVG and the command --------------------------------------------------------------------------------------------


def test_an_svg_has_a_group_for_each_thing(tmp_path: Path) -> None:
    (tmp_path / "a.m3d").write_text(VIEW + SCREEN + BAR)
    command = [
        str(tmp_path / "a.m3d"),
        "--wireframe",
        "--hidden",
        "dim",
        "--show",
        "axes",
        "-o",
        str(tmp_path / "a.svg"),
    ]
    assert main(command) == 0
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    space = "{http://www.w3.org/2000/svg}"
    groups = {group.get("id"): group for group in root.iter(f"{space}g")}
    assert list(groups) == ["solid-0", "solid-1", "axes"]
    strokes = [(path.get("stroke"), path.get("stroke-dasharray")) for path in groups["solid-1"].iter(f"{space}path")]
    assert strokes == [("#ff0000", "3"), ("#ff0000", None)]
    screen = next(groups["solid-0"].iter(f"{space}path")).get("d")
    assert screen == "M37.5 25L37.5 75L62.5 75L62.5 25L37.5 25"


def test_a_picture_is_what_draw_gives(tmp_path: Path) -> None:
    (tmp_path / "a.m3d").write_text(VIEW + SCREEN + BAR)
    assert main([str(tmp_path / "a.m3d"), "--wireframe", "-o", str(tmp_path / "a.png"), "--paper", "white"]) == 0
    pixels = OpenImageIO.ImageBuf(str(tmp_path / "a.png")).get_pixels(OpenImageIO.UINT8)
    expected = wireframe.draw(m3dc.compile(VIEW + SCREEN + BAR).ir, paper="white")
    np.testing.assert_array_equal(pixels, np.rint(255 * expected))


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--wireframe", "--samples", "4"], "--samples has no effect on a --wireframe"),
        (["--wireframe", "--straight"], "--straight has no effect on a --wireframe"),
        (["--from-above"], "--from-above is an option of --wireframe"),
        (["--wireframe", "--show", "sun"], "'sun' is none of frustum, lights, axes"),
        (["--wireframe", "-o", "a.jpg"], ".svg, .png, .tif, .tiff, .exr, .raw must name the wireframe's format"),
        (["--wireframe", "-o", "none/a.svg"], "the folder none does not exist"),
    ],
)
def test_what_cannot_be_drawn_is_said(
    arguments: list[str], says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.m3d").write_text(VIEW)
    assert exit_status(main, ["a.m3d", "-o", "a.png", *arguments]) == 2
    assert says in capsys.readouterr().err
    assert not list(Path().glob("*.png"))


def test_a_line_without_end_is_drawn_across_the_picture() -> None:
    far = "VERTEX1 <0,-1e20,10> VERTEX2 <0,-1e20,-10> VERTEX3 <0,1e20,-10>"
    seen = drawn(f"SOLID {{ RECTANGLE {{ {far} }} }}")
    assert seen[40].all()
    assert seen[60].all()
    assert seen.sum() == 2 * 101, "its other two edges are far beside the picture"


FAR = {
    "a terrain with a peak far away": "SOLID { TERRAIN { VERTICES { 2 3 <0,0,0> <0,2,0> <0,10,0> <1,0,0> <1,1,0> "
    "<1e18,1,0> } } }",
    "a huge sphere about the eye": "SOLID { SPHERE { RADIUS 1e+20 } }",
    "as far as there is": "SOLID { SPHERE { RADIUS 1e20 TRANSFORM { SCALEX 9e9 } } PLANE { } }",
    "a lamp far away": "LIGHT { SPHERE { RADIUS 1e20 } SOURCE { POINT FROM < 1e20, 0, 0 > TO < 0, 0, 0 > ANGLE 20 } }",
    "next to nothing": "SOLID { SPHERE { RADIUS 1e-320 CENTER < 20, 0, 6 > } PLANE { TRANSFORM { SCALEX 1e-160 } } }",
    "a picture without end": "SOLID { SPHERE { } } SCENE { VIEW { ASPECT 1e308 } }",
}


@pytest.mark.parametrize("text", FAR.values(), ids=FAR)
@pytest.mark.parametrize("hidden", wireframe.HIDDEN)
@pytest.mark.filterwarnings("error")
def test_what_is_far_away_is_drawn_within_the_picture(text: str, hidden: wireframe.Hidden) -> None:
    ir = m3dc.compile(text).ir
    for from_above in (False, True):
        drawing = wireframe.project(ir, 40, 30, from_above=from_above, hidden=hidden, show=wireframe.MARKS)
        assert "nan" not in wireframe.svg(drawing)
        for thing in drawing.things:
            for points in (thing.starts, thing.ends):
                assert (np.abs(points[:, :2] - (19.5, 14.5)) <= (20 + 1e-9, 15 + 1e-9)).all()
