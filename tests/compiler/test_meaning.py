"""What a scene means: evaluation order, copies, matrices, geometry. Numbers are checked against SciPy or by hand."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

import m3dc
from m3dc.ir.lower import beckmann_maximum, fresnel


def compiled(text: str) -> m3dc.SceneIR:
    result = m3dc.compile(text)
    assert [d for d in result.diagnostics if d.severity == "error"] == []
    return result.ir


def radii(text: str) -> list[float]:
    return compiled(text)["spheres"]["radius"].tolist()


# --- order and copies ---------------------------------------------------------------------------------------------


def test_an_assignment_copies_and_each_use_sees_the_value_at_its_place() -> None:
    text = """
        VARIABLES { NUMBER r, s; }
        r = 2  s = r
        SOLID { SPHERE { RADIUS r } SPHERE { RADIUS s } }
        r = 5
        SOLID { SPHERE { RADIUS r } SPHERE { RADIUS s } }
    """
    assert radii(text) == [2, 2, 5, 2]


def test_a_later_change_to_a_structure_does_not_reach_its_copies() -> None:
    text = """
        VARIABLES { SPHERE a, b; SOLID one, two; }
        a = { RADIUS 2 }
        b = a { CENTER < 1, 0, 0 > }
        one = { SPHERE a SPHERE b }
        two = one { SPHERE a { RADIUS 9 } }
        a = { RADIUS 7 }
        one = { SPHERE a }
        SOLID one SOLID two
    """
    assert radii(text) == [2, 2, 7, 2, 2, 9]


def test_a_block_assignment_changes_only_what_it_names() -> None:
    text = """
        VARIABLES { SPHERE a; }
        a = { RADIUS 2 CENTER < 1, 2, 3 > }
        a = { RADIUS 3 }
        SOLID { SPHERE a }
    """
    ir = compiled(text)
    assert ir["spheres"]["radius"].tolist() == [3]
    assert ir["spheres"]["center"].tolist() == [[1, 2, 3]]


def test_a_surface_is_replaced_by_a_name_and_changed_by_a_block() -> None:
    text = """
        VARIABLES { SURFACE red; SOLID ball; }
        red = { COLOR < 1, 0, 0 > SPECULAR 0.5 }
        ball = { SPHERE { } SURFACE { HARD 0.9 } SURFACE red { ROUGH 0.1 } }
        SOLID ball
        SOLID ball { SURFACE { AMBIENT 0.7 } }
    """
    surfaces = compiled(text)["surfaces"]
    assert surfaces["color"].tolist() == [[1, 0, 0]] * 2
    assert surfaces["hard"].tolist() == [0.5, 0.5], "SURFACE red replaces what was there"
    assert surfaces["rough"].tolist() == [0.1, 0.1]
    assert surfaces["ambient"].tolist() == [0.1, 0.7]
    assert surfaces["specular"].tolist() == [0.5, 0.5]


def test_textures_waves_and_color_ranges_add_up() -> None:
    text = """SOLID { SPHERE { } SURFACE {
        TEXTURE { CHECKER { } }
        TEXTURE {
            WOOD { COLORS { 0 0.2 <1,0,0> <1,0,0> } COLORS { 0.2 1 <0,1,0> <0,0,1> } }
            RIPPLES { WAVE { } WAVE { FREQ 2 } }
        }
    } }"""
    ir = compiled(text)
    assert ir["surfaces"]["texture_count"].tolist() == [3]
    assert ir["textures"]["color_range_count"].tolist() == [0, 2, 0]
    assert ir["textures"]["wave_count"].tolist() == [0, 0, 2]
    assert ir["color_ranges"]["start"].tolist() == [0, 0.2]


def test_the_last_statement_counts() -> None:
    assert radii("SOLID { SPHERE { RADIUS 2 RADIUS 3 } }") == [3]


def test_variables_may_stand_in_tables_and_vectors() -> None:
    text = """
        VARIABLES { NUMBER n, x; VECTOR p; }
        n = 3  x = 0.5  p = < 0, x, 0 >
        SOLID { POLYGONS { VERTICES { n p < 1, x, 0 > < 0, 2, x > } FACETS { 1 0 1 2 } } }
    """
    assert compiled(text)["vertices"]["position"].tolist() == [[0, 0.5, 0], [1, 0.5, 0], [0, 2, 0.5]]


def test_whole_numbers_are_cut_off() -> None:
    assert compiled("SCENE { DEPTH 3.99 VIEW { WIDTH 100.5 } }").scene.depth == 3


def test_a_light_keeps_its_place_among_the_lights() -> None:
    ir = compiled("LIGHT { SOURCE { INTENSITY 0.1 } } SCENE { SKY { } } LIGHT { SOURCE { INTENSITY 0.2 } }")
    assert ir["lights"]["sun"].tolist() == [False, True, False]
    assert ir.scene.sky is not None
    assert ir.scene.sky.sun == 1


# --- transformations ----------------------------------------------------------------------------------------------

Steps: TypeAlias = list[tuple[str, float]]
STEPS = st.lists(
    st.one_of(
        st.tuples(st.sampled_from(["TRANSX", "TRANSY", "TRANSZ"]), st.floats(-10, 10)),
        st.tuples(st.sampled_from(["ROTX", "ROTY", "ROTZ"]), st.floats(-720, 720)),
        st.tuples(st.sampled_from(["SCALEX", "SCALEY", "SCALEZ"]), st.floats(0.25, 4)),
    ),
    max_size=8,
)


def by_scipy(steps: Steps, points: np.ndarray) -> np.ndarray:
    """Each step done to the points in turn."""
    for keyword, amount in steps:
        axis = "XYZ".index(keyword[-1])
        if keyword.startswith("TRANS"):
            points = points + np.eye(3)[axis] * amount
        elif keyword.startswith("SCALE"):
            points = points * np.where(np.arange(3) == axis, amount, 1.0)
        else:
            points = Rotation.from_euler("xyz"[axis], amount, degrees=True).apply(points)
    return points


def written(steps: Steps) -> str:
    return "TRANSFORM { " + " ".join(f"{keyword} {amount:.17f}" for keyword, amount in steps) + " }"


@given(STEPS, STEPS)
def test_points_go_through_the_primitives_and_then_the_objects_steps(primitive: Steps, obj: Steps) -> None:
    text = f"SOLID {{ TRIANGLE {{ VERTEX1 <1,2,3> {written(primitive)} }} {written(obj)} }}"
    triangles = compiled(text)["triangles"]
    corners = np.array([[1, 2, 3], [0, 0, 0], [1, 0, 0]], float)
    first, second, third = by_scipy(obj, by_scipy(primitive, corners))
    np.testing.assert_allclose(triangles["point"][0], second, atol=1e-9)
    np.testing.assert_allclose(triangles["v"][0], first - second, atol=1e-9)
    np.testing.assert_allclose(triangles["u"][0], third - second, atol=1e-9)


@given(STEPS)
def test_the_inverse_undoes_the_matrix(steps: Steps) -> None:
    ir = compiled(f"SOLID {{ SPHERE {{ {written(steps)} }} }}")
    product = ir["primitives"]["transform"][0] @ ir["primitives"]["inverse"][0]
    np.testing.assert_allclose(product, np.eye(4), atol=1e-7)


@given(STEPS)
def test_two_blocks_are_as_good_as_one(steps: Steps) -> None:
    whole = compiled(f"SOLID {{ SPHERE {{ {written(steps)} }} }}")
    half = len(steps) // 2
    parts = compiled(f"SOLID {{ SPHERE {{ {written(steps[:half])} {written(steps[half:])} }} }}")
    np.testing.assert_allclose(whole["primitives"]["transform"], parts["primitives"]["transform"], atol=1e-12)


def test_a_name_replaces_the_matrix_and_a_block_builds_on_it() -> None:
    text = """
        VARIABLES { TRANSFORM t; }
        t = { TRANSX 1 }
        SOLID { SPHERE { TRANSFORM { TRANSY 5 } TRANSFORM t { TRANSZ 2 } } }
    """
    assert compiled(text)["spheres"]["center"].tolist() == [[1, 0, 2]]


def test_rotations_by_quarter_turns_leave_no_dust() -> None:
    ir = compiled("SOLID { SPHERE { CENTER <1,0,0> TRANSFORM { ROTZ 90 ROTX -270 ROTY 180 } } }")
    assert ir["spheres"]["center"].tolist() == [[0, 0, 1]] or set(np.abs(ir["spheres"]["center"][0])) == {0.0, 1.0}


def test_a_spheres_radius_grows_by_the_largest_factor() -> None:
    assert radii("SOLID { SPHERE { RADIUS 2 TRANSFORM { SCALE <1,3,-5> ROTX 30 } } TRANSFORM { SCALEX 0.5 } }") == [
        pytest.approx(10)
    ]


def test_a_light_moves_with_its_shape() -> None:
    ir = compiled("LIGHT { SPHERE { } SOURCE { POINT FROM <0,0,0> TO <1,0,0> } TRANSFORM { ROTZ 90 TRANSZ 3 } }")
    assert ir["spheres"]["center"].tolist() == [[0, 0, 3]]
    assert ir["lights"]["position"].tolist() == [[0, 0, 3]]
    np.testing.assert_allclose(ir["lights"]["direction"], [[0, 1, 0]], atol=1e-15)


# --- geometry -----------------------------------------------------------------------------------------------------


def test_normals_go_with_the_inverse_transpose() -> None:
    text = """SOLID { POLYGONS { PHONG VERTICES { 3 <0,0,0> <1,0,0> <0,1,1> }
        SFACETS { 1 0 1 2 <0,-1,1> <0,-1,1> <0,-1,1> } TRANSFORM { SCALE <1,1,3> } } }"""
    ir = compiled(text)
    a, b, c = ir["vertices"]["position"]
    np.testing.assert_allclose(
        np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a)), ir["normals"]["direction"][0]
    )


def test_terrain_normals_of_a_slope_are_the_slopes() -> None:
    size = 4
    points = " ".join(f"<{i},{2 * j},{0.5 * i - 0.25 * j}>" for i in range(size) for j in range(size))
    ir = compiled(f"SOLID {{ TERRAIN {{ PHONG VERTICES {{ {size} {size} {points} }} }} }}")
    expected = np.array([-0.5, 0.125, 1]) / math.sqrt(0.25 + 0.125**2 + 1)
    np.testing.assert_allclose(ir["normals"]["direction"], np.tile(expected, (size * size, 1)), atol=1e-12)
    assert len(ir["facets"]["vertex"]) == 2 * (size - 1) ** 2
    corners = ir["vertices"]["position"][ir["facets"]["vertex"]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[:, 2] > 0).all()


def test_terrain_facets_point_up_whichever_way_the_grid_runs() -> None:
    ir = compiled("SOLID { TERRAIN { VERTICES { 2 2 <1,0,0> <1,1,0> <0,0,0> <0,1,0> } } }")
    corners = ir["vertices"]["position"][ir["facets"]["vertex"]]
    assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] > 0).all()


def test_extents_hold_every_finite_primitive_of_solids_and_lights() -> None:
    text = """
        SOLID { PLANE { } SPHERE { CENTER <10,0,0> RADIUS 2 } }
        SOLID { RECTANGLE { VERTEX1 <0,5,0> VERTEX2 <0,0,0> VERTEX3 <0,0,-7> } }
        LIGHT { SPHERE { CENTER <0,0,20> } SOURCE { POINT } }
    """
    extent = compiled(text).scene.extent
    assert extent is not None
    assert extent.maximum == (12, 5, 21)
    assert extent.minimum == (-1, -2, -7)


def test_looking_straight_down_and_up() -> None:
    down = compiled("SCENE { VIEW { FROM <0,0,9> TO <0,0,0> } }").scene.view
    assert (down.up, down.right) == ((-1, 0, 0), (0, 1, 0))
    up = compiled("SCENE { VIEW { FROM <0,0,9> TO <0,0,99> } }").scene.view
    assert (up.up, up.right) == ((1, 0, 0), (0, 1, 0))


@given(st.floats(-180, 180))
def test_tilt_turns_the_camera_clockwise(tilt: float) -> None:
    """Turned clockwise, the observer's right sinks: from the horizon by the angle of tilt."""
    view = compiled(f"SCENE {{ VIEW {{ FROM <0,0,0> TO <0,7,0> TILT {tilt:.12f} }} }}").scene.view
    np.testing.assert_allclose(view.right, (math.cos(math.radians(tilt)), 0, -math.sin(math.radians(tilt))), atol=1e-9)
    np.testing.assert_allclose(view.up, (math.sin(math.radians(tilt)), 0, math.cos(math.radians(tilt))), atol=1e-9)


# --- constants ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rough", [0.05, 0.2, 0.3, 0.6, 0.7, 0.71, 0.75, 0.9, 1.0])
def test_beckmann_maximum_is_the_maximum(rough: float) -> None:
    def term(beta: float) -> float:
        return math.exp(-((math.tan(beta) / rough) ** 2)) / (rough**2 * math.cos(beta) ** 4)

    def negative(beta: float) -> float:
        return -term(beta)

    found = minimize_scalar(negative, bounds=(0, 1.5), method="bounded", options={"xatol": 1e-12})
    assert beckmann_maximum(rough) == pytest.approx(max(-found.fun, term(0)), rel=1e-9)


def test_fresnel_of_the_merman_surfaces() -> None:
    assert fresnel(1.4) == pytest.approx(0.027778, abs=5e-7)
    assert fresnel(1.1) == pytest.approx(0.002268, abs=5e-7)
    assert fresnel(1.0) == 0


# --- spans --------------------------------------------------------------------------------------------------------


def test_every_row_knows_its_text() -> None:
    text = """VARIABLES { SPHERE ball; }
ball = { RADIUS 2 }
SOLID { SPHERE ball POLYGONS { VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> } FACETS { 1 0 1 2 } } }
LIGHT { SOURCE { POINT } }
SCENE { MIRAGE { PROFILE { 0 1 /* low */ 10 2 20 3 } } }"""
    ir = compiled(text)

    def at(span: np.ndarray) -> str:
        return text[span[0] : span[1]]

    assert at(ir["solids"]["span"][0]).startswith("SOLID { SPHERE ball")
    assert at(ir["primitives"]["span"][0]) == "SPHERE ball"
    assert at(ir["primitives"]["span"][1]).startswith("POLYGONS {")
    assert at(ir["lights"]["span"][0]) == "LIGHT { SOURCE { POINT } }"
    assert text[ir["facets"]["offset"][0] :].startswith("0 1 2 }")
    assert at(ir["profile"]["span"][1]).startswith("10 2")
    assert at(np.array(ir.scene.spans["MIRAGE"])).startswith("MIRAGE {")
