"""Numbers too large for the world: found where a matrix is made or a thing is placed, reported once, and before
anything is written."""

from __future__ import annotations

import itertools
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import m3dc
from m3dc.analysis import Analyser

M3DC = Path(sys.executable).parent / "m3dc"

MANY = "TRANSFORM { SCALE < 1e20, 1e20, 1e20 > } "
FAR = {
    "a sphere": "SOLID { SPHERE { RADIUS 1e20 TRANSFORM { SCALEX 1e140 } } }",
    "a primitive and its solid": "SOLID { SPHERE { CENTER < 1e20, 0, 0 > } TRANSFORM { SCALE < 1e300, 1, 1 > } }",
    "only together": "SOLID { TRIANGLE { TRANSFORM { SCALEX 1e20 } } TRANSFORM { SCALEX 1e20 } }",
    "many blocks": f"SOLID {{ SPHERE {{ }} {MANY * 9} }}",
    "a plane": "SOLID { PLANE { TRANSFORM { TRANSZ 1e20 SCALEZ 1e20 } } }",
    "a fourth corner": "SOLID { RECTANGLE { TRANSFORM { ROTZ 45 SCALEX 1e31 } } }",
    "a mesh": "SOLID { TERRAIN { VERTICES { 2 2 <0,0,0> <0,1,0> <1,0,0> <1,1,0> } TRANSFORM { SCALEY 1e150 } } }",
    "a lamp": "LIGHT { TRANSFORM { SCALEZ 2e149 } SPHERE { RADIUS 8e19 } }",
    "a light": "LIGHT { SOURCE { POINT FROM < 0, 0, 5 > TO < 0, 0, 0 > } TRANSFORM { SCALEZ 1e40 } }",
    "a variable": "VARIABLES { SOLID a; } a = { SPHERE { RADIUS 1e20 } } SOLID a { TRANSFORM { SCALEX 1e15 } }",
}
NOT_UNDONE = {
    "too large": f"SOLID {{ SPHERE {{ }} {MANY * 30} }}",
    "too small": "SOLID { SPHERE { TRANSFORM { SCALEX 1e-320 } } }",
    "together": "SOLID { SPHERE { TRANSFORM { SCALEX 1e-200 } } TRANSFORM { SCALEX 1e-200 } }",
    "a chain": "SOLID { SPHERE { TRANSFORM { " + "SCALEX 1e-100 " * 9 + "} } }",
    "a variable": "VARIABLES { TRANSFORM t; } t = { SCALEX 1e300 SCALEX 1e9 } SOLID { SPHERE { TRANSFORM t } }",
}
NEAR = (
    "SOLID { SPHERE { CENTER < 1e20, -1e20, 1e20 > RADIUS 1e20 } PLANE { VERTEX1 < 0, 0, 1e20 > } }",
    "SOLID { SPHERE { RADIUS 1e20 } TRANSFORM { SCALE < 1e9, 1e9, 1e9 > } }",
    "SOLID { SPHERE { RADIUS 1e20 TRANSFORM { SCALEX 1e200 } } TRANSFORM { SCALEX 1e-200 } }",
    "SOLID { SPHERE { RADIUS 1e-200 TRANSFORM { SCALE < 1e200, 1e200, 1e200 > } } }",
    "LIGHT { TRANSFORM { SCALE < 1e-200, 1e-200, 1e-200 > } SOURCE { DIRECTION < 1e-200, 0, -1e-200 > } }",
)


def errors(text: str) -> list[str]:
    """The codes of a scene's errors. Python's warnings are none of them: they fail the test."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = m3dc.compile(text).diagnostics
        assert Analyser().analyse(m3dc.Source(text.encode())).diagnostics == found
    return [diagnostic.code for diagnostic in found if diagnostic.severity == "error"]


@pytest.mark.parametrize("text", FAR.values(), ids=FAR)
def test_what_is_carried_too_far_is_reported_once(text: str) -> None:
    assert errors(text) == ["M3D0424"]


@pytest.mark.parametrize("text", NOT_UNDONE.values(), ids=NOT_UNDONE)
def test_what_can_not_be_undone_is_reported_once(text: str) -> None:
    assert errors(text) == ["M3D0421"]


@pytest.mark.parametrize("text", NEAR)
def test_all_that_the_language_can_write_down_is_near_enough(text: str) -> None:
    assert errors(text) == []
    ir = m3dc.compile(text).ir
    for table, columns in ir.tables.items():
        for name, column in columns.items():
            assert column.dtype.kind != "f" or np.isfinite(column).all(), f"{table}.{name}"
    directions = [*ir["lights"]["direction"], *ir["spheres"]["pole"], *ir["spheres"]["equator"]]
    assert [float(np.linalg.norm(direction)) for direction in directions] == pytest.approx([1.0] * len(directions))


def test_of_a_copy_the_place_is_where_it_is_used() -> None:
    text = FAR["a variable"]
    (diagnostic,) = (d for d in m3dc.compile(text).diagnostics if d.severity == "error")
    assert text[slice(*diagnostic.span.bytes)] == "SOLID a { TRANSFORM { SCALEX 1e15 } }"
    assert text[slice(*diagnostic.related[0].span.bytes)] == "SPHERE { RADIUS 1e20 }"


def test_after_an_edit_it_is_still_said() -> None:
    analyser = Analyser()
    for factor in ("1e3", "1e15", "1e3"):
        text = FAR["a variable"].replace("1e15", factor)
        found = analyser.analyse(m3dc.Source(text.encode())).diagnostics
        assert found == m3dc.compile(text).diagnostics


@pytest.mark.slow
@pytest.mark.parametrize("text", list(itertools.chain(list(FAR.values())[:4], NOT_UNDONE.values())))
def test_checking_says_what_compiling_says(text: str, tmp_path: Path) -> None:
    scene, ir = tmp_path / "a.m3d", tmp_path / "a.m3ir"
    scene.write_text(text)
    said = [
        subprocess.run([M3DC, *options, scene], capture_output=True, text=True, check=False)
        for options in (["--check"], ["-o", ir])
    ]
    assert said[0].returncode == said[1].returncode == 1
    assert said[0].stderr == said[1].stderr
    assert "Warning" not in said[0].stderr
    assert not ir.exists()
