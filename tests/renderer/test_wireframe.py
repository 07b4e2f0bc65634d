"""Wireframe pictures: edges where geometry says, drawn where the camera says."""

from __future__ import annotations

import math

import numpy as np
import pytest

import m3dc
from m3d_render import wireframe

# A camera whose picture of the plane x = 0 maps y and z to pixels one to one: 101 pixels for -50..50.
VIEW = "SCENE { SKY { } VIEW { FROM < 50, 0, 0 > TO < 0, 0, 0 > FOV 90 WIDTH 101 HEIGHT 101 } }"


def drawn(text: str) -> np.ndarray:
    result = m3dc.compile(VIEW + text)
    assert result.ok
    return wireframe.draw(result.ir).any(axis=-1)


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
    (group,) = wireframe.edges(m3dc.compile("SOLID { SPHERE { } SURFACE { COLOR <0,0,0> } }").ir)
    assert group.color.min() > 0.3


def test_tilt_turns_the_picture() -> None:
    scene = VIEW.replace("FOV 90", "FOV 90 TILT 90") + "SOLID { TRIANGLE { VERTEX1 <0,0,20> VERTEX2 <0,1,19> } }"
    rows, columns = np.nonzero(wireframe.draw(m3dc.compile(scene).ir).any(axis=-1))
    assert math.hypot(rows.mean() - 50, columns.mean() - 50) > 5
    assert columns.min() < 35, "turned clockwise, the observer's up points right, and what is above moves left"
