"""Every statement and table of the language changes what it should in the IR, and nothing is forgotten."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import pytest

import m3dc
from m3d_language.table import LANGUAGE, Block
from m3dc.ir import LightKind, SceneIR, TextureKind

SPHERE = "SPHERE { }"
PROFILE = "PROFILE { 0 1 10 2 20 4 }"
FACET = "VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> }"


def scene(body: str) -> str:
    return f"SCENE {{ {body} }}"


def solid(body: str) -> str:
    return f"SOLID {{ {body} }}"


def light(body: str) -> str:
    return f"LIGHT {{ SOURCE {{ {body} }} }}"


def surface(body: str) -> str:
    return solid(f"{SPHERE} SURFACE {{ {body} }}")


def texture(body: str, kind: str = "WOOD") -> str:
    return surface(f"TEXTURE {{ {kind} {{ {body} }} }}")


def sphere_matrix(body: str) -> str:
    return solid(f"SPHERE {{ TRANSFORM {{ {body} }} }}")


Get: TypeAlias = Callable[[SceneIR], Any]


def column(table: str, name: str, row: int = 0) -> Get:
    return lambda ir: ir[table][name][row]


def scene_value(path: str) -> Get:
    def get(ir: SceneIR) -> Any:
        value: Any = ir.scene
        for name in path.split("."):
            value = getattr(value, name)
        return value

    return get


def matrix(*rows: list[float]) -> np.ndarray:
    return np.array(rows, float)


def moved(x: float, y: float, z: float) -> np.ndarray:
    return matrix([1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [x, y, z, 1])


def scaled(x: float, y: float, z: float) -> np.ndarray:
    return np.diag([x, y, z, 1.0])


primitive_matrix = column("primitives", "transform")
S45 = 0.5**0.5

# (block, keyword): a scene that uses it, where it shows in the IR, and what must be there. All values differ from the
# defaults.
CASES: dict[tuple[str, str], tuple[str, Get, Any]] = {
    ("SCENE", "SHADOWS"): (scene("SHADOWS"), scene_value("shadows"), True),
    ("SCENE", "LOGSCALE"): (scene("LOGSCALE 15"), scene_value("log_scale"), 15.0),
    ("SCENE", "DEPTH"): (scene("DEPTH 5"), scene_value("depth"), 5),
    ("SCENE", "BACKGROUND"): (scene("BACKGROUND <0.1,0.2,0.3>"), scene_value("background"), (0.1, 0.2, 0.3)),
    ("AMBIENT", "INTENSITY"): (scene("AMBIENT { INTENSITY 0.7 }"), scene_value("ambient.intensity"), 0.7),
    ("AMBIENT", "COLOR"): (scene("AMBIENT { COLOR <1,0.5,0> }"), scene_value("ambient.color"), (1.0, 0.5, 0.0)),
    ("AMBIENT", "NSAMPLES"): (scene("AMBIENT { NSAMPLES 8 }"), scene_value("ambient.samples"), 8),
    ("AMBIENT", "DEPTH"): (scene("AMBIENT { DEPTH 3 }"), scene_value("ambient.depth"), 3),
    ("HAZE", "INTENSITY"): (scene("HAZE { INTENSITY 0.4 }"), scene_value("haze.intensity"), 0.4),
    ("HAZE", "COLOR"): (scene("HAZE { COLOR <1,0,0> }"), scene_value("haze.color"), (1.0, 0.0, 0.0)),
    ("HAZE", "DENSITY"): (scene("HAZE { DENSITY 0.001 }"), scene_value("haze.density"), 0.001),
    ("SKY", "RADIUS"): (scene("SKY { RADIUS 1e8 }"), scene_value("sky.radius"), 1e8),
    ("SKY", "INTENSITY"): (scene("SKY { INTENSITY 0.5 }"), scene_value("sky.intensity"), 0.5),
    ("SKY", "ZENITHCOLOR"): (scene("SKY { ZENITHCOLOR <0,1,0> }"), scene_value("sky.zenith_color"), (0.0, 1.0, 0.0)),
    ("SKY", "HORIZONCOLOR"): (scene("SKY { HORIZONCOLOR <1,0,0> }"), scene_value("sky.horizon_color"), (1.0, 0.0, 0.0)),
    ("SKY", "OVERCAST"): (scene("SKY { OVERCAST 0.3 }"), scene_value("sky.overcast"), 0.3),
    ("SUN", "INTENSITY"): (scene("SKY { SUN { INTENSITY 0.6 } }"), column("lights", "intensity"), 0.6),
    ("SUN", "COLOR"): (scene("SKY { SUN { COLOR <1,1,0> } }"), column("lights", "color"), (1, 1, 0)),
    ("SUN", "AZIMUTH"): (scene("SKY { SUN { ZENITH 45 AZIMUTH 90 } }"), column("lights", "direction"), (0, -S45, -S45)),
    ("SUN", "ZENITH"): (scene("SKY { SUN { ZENITH 45 } }"), column("lights", "direction"), (-S45, 0, -S45)),
    ("SUN", "DIRECTION"): (scene("SKY { SUN { DIRECTION <0,3,-4> } }"), column("lights", "direction"), (0, 0.6, -0.8)),
    ("SUN", "FROM"): (scene("SKY { SUN { FROM <3,0,4> } }"), column("lights", "direction"), (-0.6, 0, -0.8)),
    ("SUN", "TO"): (scene("SKY { SUN { TO <0,75,0> } }"), column("lights", "direction"), (0, 0.6, -0.8)),
    ("SUN", "NOSPECULAR"): (scene("SKY { SUN { NOSPECULAR } }"), column("lights", "highlights"), False),
    ("SUN", "NOSHADOWS"): (scene("SKY { SUN { NOSHADOWS } }"), column("lights", "shadows"), False),
    ("MIRAGE", "SEGMENTS"): (scene(f"MIRAGE {{ SEGMENTS 9 {PROFILE} }}"), scene_value("mirage.segments"), 9),
    ("MIRAGE", "DISTANCE"): (scene(f"MIRAGE {{ DISTANCE 99 {PROFILE} }}"), scene_value("mirage.distance"), 99.0),
    ("MIRAGE", "ELEVATION"): (scene(f"MIRAGE {{ ELEVATION 15 {PROFILE} }}"), scene_value("mirage.elevation"), 15.0),
    ("MIRAGE", "PROFILE"): (scene(f"MIRAGE {{ {PROFILE} }}"), column("profile", "temperature", 2), 4.0),
    ("VIEW", "FROM"): (scene("VIEW { FROM <1,2,3> }"), scene_value("view.eye"), (1.0, 2.0, 3.0)),
    ("VIEW", "TO"): (scene("VIEW { TO <1,2,3> }"), scene_value("view.target"), (1.0, 2.0, 3.0)),
    ("VIEW", "FOV"): (scene("VIEW { FOV 90 }"), scene_value("view.distance"), 1.0),
    ("VIEW", "TILT"): (scene("VIEW { TILT 90 }"), scene_value("view.right"), (0.0, 0.0, -1.0)),
    ("VIEW", "WIDTH"): (scene("VIEW { WIDTH 640 }"), scene_value("view.width"), 640),
    ("VIEW", "HEIGHT"): (scene("VIEW { HEIGHT 480 }"), scene_value("view.height"), 480),
    ("VIEW", "ASPECT"): (scene("VIEW { ASPECT 1.2 }"), scene_value("view.aspect"), 1.2),
    ("VIEW", "REGION"): (scene("VIEW { REGION 10, 20, 30, 40 }"), scene_value("view.right_edge"), 40),
    ("TRANSFORM", "IDENTITY"): (sphere_matrix("TRANSX 5 IDENTITY TRANSY 1"), primitive_matrix, moved(0, 1, 0)),
    ("TRANSFORM", "TRANSLATE"): (sphere_matrix("TRANSLATE <1,2,3>"), primitive_matrix, moved(1, 2, 3)),
    ("TRANSFORM", "TRANSX"): (sphere_matrix("TRANSX 4"), primitive_matrix, moved(4, 0, 0)),
    ("TRANSFORM", "TRANSY"): (sphere_matrix("TRANSY 4"), primitive_matrix, moved(0, 4, 0)),
    ("TRANSFORM", "TRANSZ"): (sphere_matrix("TRANSZ 4"), primitive_matrix, moved(0, 0, 4)),
    ("TRANSFORM", "SCALE"): (sphere_matrix("SCALE <2,3,-4>"), primitive_matrix, scaled(2, 3, -4)),
    ("TRANSFORM", "SCALEX"): (sphere_matrix("SCALEX 2"), primitive_matrix, scaled(2, 1, 1)),
    ("TRANSFORM", "SCALEY"): (sphere_matrix("SCALEY 2"), primitive_matrix, scaled(1, 2, 1)),
    ("TRANSFORM", "SCALEZ"): (sphere_matrix("SCALEZ 2"), primitive_matrix, scaled(1, 1, 2)),
    # Seen from an axis's positive end a turn is counter-clockwise: y to z about x, z to x about y, x to y about z.
    ("TRANSFORM", "ROTATE"): (
        sphere_matrix("ROTATE <90,0,90>"),
        primitive_matrix,
        matrix([0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1]),
    ),
    ("TRANSFORM", "ROTX"): (
        sphere_matrix("ROTX 90"),
        primitive_matrix,
        matrix([1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]),
    ),
    ("TRANSFORM", "ROTY"): (
        sphere_matrix("ROTY 90"),
        primitive_matrix,
        matrix([0, 0, -1, 0], [0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1]),
    ),
    ("TRANSFORM", "ROTZ"): (
        sphere_matrix("ROTZ 90"),
        primitive_matrix,
        matrix([0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]),
    ),
    ("SPHERE", "CENTER"): (solid("SPHERE { CENTER <1,2,3> }"), column("spheres", "center"), (1, 2, 3)),
    ("SPHERE", "RADIUS"): (solid("SPHERE { RADIUS 7 }"), column("spheres", "radius"), 7.0),
    **{
        (block, f"VERTEX{n}"): (solid(f"{block} {{ VERTEX{n} {at} }}"), column(f"{block.lower()}s", name), value)
        for block in ("PLANE", "TRIANGLE", "RECTANGLE")
        for n, at, name, value in (
            (1, "<0,0,2>", "v", (0, 0, 2)),
            (2, "<5,5,5>", "point", (5, 5, 5)),
            (3, "<0,0,2>", "u", (0, 0, 2)),
        )
    },
    ("POLYGONS", "PHONG"): (
        solid(f"POLYGONS {{ PHONG {FACET} FACETS {{ 1 0 1 2 }} }}"),
        column("meshes", "phong"),
        True,
    ),
    ("POLYGONS", "NOPHONG"): (
        solid(f"POLYGONS {{ PHONG NOPHONG {FACET} FACETS {{ 1 0 1 2 }} }}"),
        column("meshes", "phong"),
        False,
    ),
    ("POLYGONS", "VERTICES"): (
        solid(f"POLYGONS {{ {FACET} FACETS {{ 1 0 1 2 }} }}"),
        column("vertices", "position", 1),
        (1, 0, 0),
    ),
    ("POLYGONS", "FACETS"): (
        solid(f"POLYGONS {{ {FACET} FACETS {{ 1 2 0 1 }} }}"),
        column("facets", "vertex"),
        (2, 0, 1),
    ),
    ("POLYGONS", "SFACETS"): (
        solid(f"POLYGONS {{ {FACET} SFACETS {{ 1 0 1 2 <0,0,2> <0,3,4> <0,0,1> }} }}"),
        column("normals", "direction", 1),
        (0, 0.6, 0.8),
    ),
    ("TERRAIN", "PHONG"): (
        solid("TERRAIN { PHONG VERTICES { 2 2 <0,0,0> <0,1,0> <1,0,0> <1,1,0> } }"),
        column("meshes", "phong"),
        True,
    ),
    ("TERRAIN", "VERTICES"): (
        solid("TERRAIN { VERTICES { 2 2 <0,0,5> <0,1,0> <1,0,0> <1,1,0> } }"),
        column("vertices", "position", 0),
        (0, 0, 5),
    ),
    **{
        ("SURFACE", keyword): (surface(f"{keyword} 0.35"), column("surfaces", name), 0.35)
        for keyword, name in (
            ("SPECULAR", "specular"),
            ("ROUGH", "rough"),
            ("HARD", "hard"),
            ("METALLIC", "metallic"),
            ("FUZZ", "fuzz"),
            ("AMBIENT", "ambient"),
        )
    },
    ("SURFACE", "COLOR"): (surface("COLOR <0.1,0.2,0.3>"), column("surfaces", "color"), (0.1, 0.2, 0.3)),
    ("SURFACE", "REFINDEX"): (surface("REFINDEX 1.5"), column("surfaces", "refindex"), 1.5),
    **{
        ("WOOD", keyword): (texture(f"{keyword} 0.25"), column("textures", keyword.lower()), 0.25)
        for keyword in ("TURBULENCE", "SQUEEZE", "SCALE", "SLOPE", "ELEVATION")
    },
    ("WOOD", "LOCAL"): (texture("LOCAL"), column("textures", "local"), True),
    ("WOOD", "COLOR"): (texture("COLOR <1,0,0>"), column("textures", "color"), (1, 0, 0)),
    ("WOOD", "COLORS"): (texture("COLORS { 0 0.5 <1,0,0> <0,1,0> }"), column("color_ranges", "end_color"), (0, 1, 0)),
    ("WAVE", "CENTER"): (texture("WAVE { CENTER <1,2,3> }"), column("waves", "center"), (1, 2, 3)),
    ("WAVE", "AMPLITUDE"): (texture("WAVE { AMPLITUDE 2 }"), column("waves", "amplitude"), 2.0),
    ("WAVE", "FREQ"): (texture("WAVE { FREQ 3 }"), column("waves", "freq"), 3.0),
    ("WAVE", "PHASE"): (texture("WAVE { PHASE -1 }"), column("waves", "phase"), -1.0),
    ("WAVE", "DAMP"): (texture("WAVE { DAMP 0.5 }"), column("waves", "damp"), 0.5),
    ("SOURCE", "COLOR"): (light("COLOR <1,0,0>"), column("lights", "color"), (1, 0, 0)),
    ("SOURCE", "INTENSITY"): (light("INTENSITY 0.5"), column("lights", "intensity"), 0.5),
    ("SOURCE", "INFINITE"): (light("POINT INFINITE"), column("lights", "kind"), LightKind.INFINITE),
    ("SOURCE", "POINT"): (light("POINT"), column("lights", "kind"), LightKind.POINT),
    ("SOURCE", "ATTENUATION"): (light("POINT ATTENUATION 2"), column("lights", "attenuation"), 2.0),
    ("SOURCE", "ANGLE"): (light("POINT ANGLE 30"), column("lights", "angle"), 30.0),
    ("SOURCE", "EXPONENT"): (light("POINT EXPONENT 8"), column("lights", "exponent"), 8.0),
    ("SOURCE", "FROM"): (light("POINT FROM <3,0,4>"), column("lights", "position"), (3, 0, 4)),
    ("SOURCE", "TO"): (light("TO <0,75,0>"), column("lights", "direction"), (0, 0.6, -0.8)),
    ("SOURCE", "DIRECTION"): (light("DIRECTION <3,0,4>"), column("lights", "direction"), (0.6, 0, 0.8)),
    ("SOURCE", "ZENITH"): (light("ZENITH 90"), column("lights", "direction"), (-1, 0, 0)),
    ("SOURCE", "AZIMUTH"): (light("ZENITH 90 AZIMUTH 90"), column("lights", "direction"), (0, -1, 0)),
    ("SOURCE", "NOSHADOWS"): (light("NOSHADOWS"), column("lights", "shadows"), False),
    ("SOURCE", "NOSPECULAR"): (light("NOSPECULAR"), column("lights", "highlights"), False),
}


def problems(result: m3dc.Result) -> set[str]:
    """The codes of what is wrong; that such a small scene has no light, overwrites what it shows, or does not show it
    (M3D0514 and on), is not."""
    found = {diagnostic.code for diagnostic in result.diagnostics}
    return {code for code in found if code < "M3D0513"} - {"M3D0502", "M3D0509"}


def same(left: object, right: object) -> bool:
    return np.allclose(np.asarray(left, float), np.asarray(right, float), rtol=0, atol=1e-15)


@pytest.mark.parametrize(("block", "keyword"), CASES)
def test_statement_reaches_the_ir(block: str, keyword: str) -> None:
    text, get, expected = CASES[block, keyword]
    result = m3dc.compile(text)
    assert problems(result) == set()
    assert same(get(result.ir), expected)


def test_no_statement_is_forgotten() -> None:
    textures = LANGUAGE.blocks["TEXTURE"].holds
    described = {
        ("WOOD" if block.keyword in textures else block.keyword, keyword)
        for block in LANGUAGE.blocks.values()
        for keyword in (*block.statements, *block.tables)
    }
    assert set(CASES) == described


@pytest.mark.parametrize("keyword", LANGUAGE.blocks["TEXTURE"].holds)
def test_textures_reach_the_ir(keyword: str) -> None:
    result = m3dc.compile(texture("LOCAL COLOR <1,0,0> TRANSFORM { TRANSX 4 }", keyword))
    assert problems(result) == set()
    textures = result.ir["textures"]
    assert textures["kind"].tolist() == [TextureKind[keyword]]
    assert same(textures["transform"][0], moved(4, 0, 0))
    assert same(textures["inverse"][0], moved(-4, 0, 0))


@pytest.mark.parametrize("block", LANGUAGE.blocks.values(), ids=lambda block: block.keyword)
def test_the_tables_examples_compile(block: Block) -> None:
    """Each block's example stands alone in the blocks that hold it."""
    text = block.example
    keyword = block.keyword
    while keyword not in LANGUAGE.top:
        keyword = next(b.keyword for b in reversed(LANGUAGE.blocks.values()) if keyword in b.holds)
        needs = SPHERE if keyword == "SOLID" and "SPHERE" not in text else ""
        text = f"{keyword} {{ {text} {needs} }}"
    assert problems(m3dc.compile(text)) <= {"M3D0507"}
