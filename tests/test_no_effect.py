"""What is said to have no effect has none: without it the picture is the same. And what has one is not spoken of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from marks import without_marks
from primitives import ENDLESS, solid

import m3d_render
import m3dc
from m3d_language.table import LANGUAGE
from m3dc.diagnostics.catalogue import CATALOGUE
from m3dc.ir import PrimitiveKind
from m3dc.meaning.effects import NEEDS, RULES

DIAGNOSTICS = Path(__file__).parent / "compiler/diagnostics"
WITHOUT_EFFECT = (
    "M3D0512", "M3D0514", "M3D0515", "M3D0516", "M3D0517", "M3D0518", "M3D0519", "M3D0520", "M3D0521", "M3D0522",
    "M3D0524", "M3D0529",
)  # fmt: skip
TEXTURES = LANGUAGE.blocks["TEXTURE"].holds
LIT = "SCENE { SKY { SUN { ZENITH 30 } } VIEW { FROM < 4, 1, 3 > TO < 0, 0, 0 > } }"


def codes(text: str) -> set[str]:
    result = m3dc.compile(text)
    assert result.ok, result.diagnostics
    return {diagnostic.code for diagnostic in result.diagnostics}


def look(text: bytes) -> m3d_render.Picture:
    return m3d_render.render(m3dc.compile(text).ir, width=32, height=20)


@pytest.mark.parametrize(
    "text",
    [
        *(without_marks((DIAGNOSTICS / f"{name}.m3d").read_text()) for name in ("no-effect", "planes-alone")),
        *(CATALOGUE[code].wrong for code in WITHOUT_EFFECT),
    ],
)
def test_without_it_the_picture_is_the_same(text: str) -> None:
    data = text.encode()
    picture = look(data)
    found = [d for d in m3dc.compile(data).diagnostics if d.code in WITHOUT_EFFECT]
    assert found
    for diagnostic in found:
        start, end = diagnostic.span.bytes
        assert np.array_equal(look(data[:start] + data[end:]), picture), diagnostic.message


def test_all_textures_and_primitives_are_known() -> None:
    assert NEEDS.keys() == set(TEXTURES)
    for block, rules in RULES.items():
        for rule in rules:
            assert rule.keywords.keys() <= LANGUAGE.blocks[block].statements.keys()
            assert rule.diagnostic in CATALOGUE.values()


@pytest.mark.parametrize("texture", TEXTURES)
def test_a_texture_uses_what_the_language_says(texture: str) -> None:
    block = LANGUAGE.blocks[texture]
    for keyword in block.members():
        if keyword in block.statements:
            entry = block.statements[keyword]
            text = f"{keyword} {'' if entry.is_flag else '< 1, 0, 0 >' if entry.arguments[0].shape == 'vector' else 1}"
        else:
            text = f"{keyword} {{ {'0 1 < 1, 0, 0 > < 1, 1, 0 >' if keyword in block.tables else ''} }}"
        scene = f"{LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ {texture} {{ {text} }} }} }} }}"
        assert ("M3D0517" in codes(scene)) == (keyword not in block.uses), keyword


@pytest.mark.parametrize("kind", PrimitiveKind, ids=lambda kind: kind.name)
def test_every_kind_of_primitive_behind_the_camera(kind: PrimitiveKind) -> None:
    away = f"SCENE {{ SKY {{ }} VIEW {{ FROM < 0, 0, 1 > TO < -20, 0, 1 > }} }} {solid(kind)}"
    assert ("M3D0526" in codes(away)) == (kind not in ENDLESS)
    toward = away.replace("-20", "20")
    assert "M3D0526" not in codes(toward)
    # In a ball together with it.
    sky = f"{toward} SOLID {{ SPHERE {{ RADIUS 50 }} }}"
    assert "M3D0527" not in codes(sky)
    assert "M3D0527" in codes(sky.replace("RADIUS 50", "CENTER < 0, 0, 3 > RADIUS 2.5"))


QUIET = (
    # The cause came later, and on purpose.
    "VARIABLES { SURFACE a; } a = { HARD 0.9 METALLIC 1 } SOLID { SPHERE { } SURFACE a { SPECULAR 0 } }",
    "VARIABLES { SOURCE a; } a = { POINT ANGLE 20 } SOLID { SPHERE { } } LIGHT { SOURCE a { INFINITE } }",
    "VARIABLES { POLYGONS a; } a = { PHONG VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> } } "
    "SOLID { POLYGONS a { NOPHONG FACETS { 1 0 1 2 } } }",
    # It has an effect in the end.
    "VARIABLES { SURFACE a; } a = { SPECULAR 0 HARD 0.9 } SOLID { SPHERE { } SURFACE a { SPECULAR 1 } }",
    "VARIABLES { SOURCE a; } a = { ANGLE 20 } SOLID { SPHERE { } } LIGHT { SOURCE a { POINT } }",
    "VARIABLES { SOURCE a; } a = { POINT AZIMUTH 20 } SOLID { SPHERE { } } LIGHT { SOURCE a { EXPONENT 1 } }",
    # What is written is what there is anyway.
    "SOLID { SPHERE { } SURFACE { SPECULAR 0 HARD 0 METALLIC 0 ROUGH 1 REFINDEX 1.4 } }",
    "SOLID { SPHERE { } } LIGHT { SOURCE { ANGLE 180 EXPONENT 0 ATTENUATION 0 } }",
    "SOLID { SPHERE { } } SCENE { SKY { } BACKGROUND < 0, 0, 0 > AMBIENT { NSAMPLES 0 DEPTH 0 } }",
    # Each value is used.
    "VARIABLES { NUMBER a; } a = 1 SOLID { SPHERE { RADIUS a } } a = 2 SOLID { SPHERE { CENTER < 0, a, 0 > } }",
    "VARIABLES { NUMBER a, b; } a = 1 b = a a = 2 SOLID { SPHERE { RADIUS a CENTER < b, 0, 0 > } }",
    "VARIABLES { SPHERE a; } a = { RADIUS 1 } a = { CENTER < 0, 1, 0 > } SOLID { SPHERE a }",
    "VARIABLES { NUMBER a; } a = 1 SCENE { SKY { } MIRAGE { PROFILE { 0 a 5 11 20 12 } } } a = 9 "
    "SOLID { SPHERE { RADIUS a } }",
    "VARIABLES { SURFACE a, b; } a = { ROUGH 1 } b = a { HARD 1 } a = b SOLID { SPHERE { } SURFACE a }",
    # A name first, and then what changes it in the same block; a copied SOLID's surface replaced.
    "VARIABLES { SURFACE a; SOLID b; } a = { ROUGH 1 } b = { SPHERE { } SURFACE { HARD 1 } } SOLID b { SURFACE a }",
    # Angles, colours and temperatures that are what they are.
    "SOLID { SPHERE { TRANSFORM { ROTZ 1.5 ROTX 45 } } } "
    "SCENE { SKY { SUN { ZENITH 1.5 } } VIEW { TO < 0, 0, 0 > FOV 1.57 } }",
    "SOLID { SPHERE { TRANSFORM { ROTZ 0.05 } } }",
    "SOLID { SPHERE { TRANSFORM { ROTATE < 5, -3, 0 > } } TRANSFORM { ROTZ 2 } }",
    "SOLID { SPHERE { } SURFACE { COLOR < 1, 1, 0 > } } SCENE { SKY { } MIRAGE { PROFILE { 0 80 5 40 20 30 } } }",
    # In a ball with a lamp, or on its skin.
    "SOLID { SPHERE { CENTER < 20, 0, 6 > RADIUS 3 } } SCENE { } LIGHT { SOURCE { POINT FROM < 19, 0, 6 > } }",
    "SOLID { SPHERE { CENTER < 10, 0, 6 > RADIUS 10 } } SCENE { SKY { } }",
    # In one of the objects that have it from a variable.
    "VARIABLES { SURFACE a; } a = { TEXTURE { UBLEND { } } } SOLID { PLANE { } SURFACE a } "
    "SOLID { SPHERE { } SURFACE a }",
    "VARIABLES { SOURCE a; } a = { ANGLE 60 } SOLID { SPHERE { } } LIGHT { SOURCE a } LIGHT { SOURCE a { POINT } }",
    # Mixed with what has a u, or heights.
    f"{LIT} SOLID {{ PLANE {{ }} SPHERE {{ }} SURFACE {{ TEXTURE {{ UBLEND {{ }} SNOW {{ }} }} }} }}",
)


@pytest.mark.parametrize("text", QUIET)
def test_nothing_is_said(text: str) -> None:
    if "SCENE" not in text:
        text += f" {LIT}"
    assert {code for code in codes(text) if code >= "M3D0512"} == set()
