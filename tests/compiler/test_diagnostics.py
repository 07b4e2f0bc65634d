"""Diagnostics, scene by scene: each mark in tests/compiler/diagnostics has its diagnostic, each diagnostic its mark."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from marks import mark, marks, with_marks, without_marks

import m3dc
from m3dc.diagnostics import catalogue
from m3dc.diagnostics.catalogue import CATALOGUE, Entry

ROOT = Path(__file__).parents[2]
SCENES = sorted((Path(__file__).parent / "diagnostics").glob("*.m3d"))


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_marks_and_diagnostics_agree(scene: Path, rewrite: bool) -> None:
    text = scene.read_text(encoding="utf-8")
    if rewrite:
        plain = without_marks(text)
        result = m3dc.compile(plain)
        scene.write_text(with_marks(plain, [mark(d, result.source) for d in result.diagnostics]), encoding="utf-8")
        return
    result = m3dc.compile(text)
    assert sorted(mark(d, result.source) for d in result.diagnostics) == marks(text)
    assert marks(text), "a scene without marks shows nothing"


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_a_fix_never_adds_an_error(scene: Path) -> None:
    text = without_marks(scene.read_text(encoding="utf-8"))
    result = m3dc.compile(text)
    errors = sum(d.severity == "error" for d in result.diagnostics)
    for diagnostic in result.diagnostics:
        if diagnostic.fix is None:
            continue
        (start, end), new = diagnostic.fix.span.bytes, diagnostic.fix.text
        data = text.encode()
        mended = m3dc.compile(data[:start] + new.encode() + data[end:])
        assert sum(d.severity == "error" for d in mended.diagnostics) <= errors
        assert diagnostic._replace(fix=None) not in [d._replace(fix=None) for d in mended.diagnostics]


@pytest.mark.parametrize(
    ("wrong", "mended"),
    [
        ("VARIABLES { NUMBER a b; }", "VARIABLES { NUMBER a, b; }"),
        ("VARIABLES { NUMBER a }", "VARIABLES { NUMBER a; }"),
        ("SOLID { SPHERE { CENTER < 1 2, 3 > } }", "SOLID { SPHERE { CENTER < 1, 2, 3 > } }"),
        ("SOLID { SPHERE { CENTER < 1, 2, 3 } }", "SOLID { SPHERE { CENTER < 1, 2, 3 > } }"),
        ("SOLID { SPHERE { RADIUS 1 }", "SOLID { SPHERE { RADIUS 1 } }"),
        ("SOLID\n{\n    SPHERE {\n        RADIUS 1\n}\n", "SOLID\n{\n    SPHERE {\n        RADIUS 1\n    }\n}\n"),
        ("SOLID { SPHERE { } } }", "SOLID { SPHERE { } } "),
        ("SOLID { SPHERE { } } */ LIGHT { }", "SOLID { SPHERE { } }  LIGHT { }"),
        ("SOLID { SPHERE { RADIUS 2. } }", "SOLID { SPHERE { RADIUS 2.0 } }"),
        ("SOLID { SPHERE { CENTER < -.5, 1.e5, 0 > } }", "SOLID { SPHERE { CENTER < -0.5, 1.e5, 0 > } }"),
        ("SCENE { MIRAGE { PROFILE { 0 -.5 5 11 20 12 } } }", "SCENE { MIRAGE { PROFILE { 0 -0.5 5 11 20 12 } } }"),
        ("SCENE { MIRAGE { PROFILE { 0 5. 5 11 20 12 } } }", "SCENE { MIRAGE { PROFILE { 0 5.0 5 11 20 12 } } }"),
        ("VARIABLES { NUMBER a, a, b; }", "VARIABLES { NUMBER a, b; }"),
        ("VARIABLES { NUMBER a; NUMBER a; VECTOR b; }", "VARIABLES { NUMBER a; VECTOR b; }"),
        ("VARIABLES { NUMBER a; NUMBER a, b; }", "VARIABLES { NUMBER a; NUMBER b; }"),
        ("VARIABLES { SPHERE b; } b = b { RADIUS 2 }", "VARIABLES { SPHERE b; } b = { RADIUS 2 }"),
        ("VARIABLES { SPHERE b; } b = b", "VARIABLES { SPHERE b; } "),
        ("SCENE { SHADOWS 1 }", "SCENE { SHADOWS }"),
        ("SCENE { DEPTH 0 }", "SCENE { DEPTH 2 }"),
        ("SCENE { BACKGROUND < 0.123456789, 1.5, -1 > }", "SCENE { BACKGROUND < 0.123456789, 1, 0 > }"),
        ("SOLID { SPHERE { RADIUS 2 RADIUS 3 } }", "SOLID { SPHERE { RADIUS 3 } }"),
        ("SOLID { SPHERE {\n  RADIUS 2\n  RADIUS 3\n} }", "SOLID { SPHERE {\n  RADIUS 3\n} }"),
        (
            "SOLID { SPHERE { TRANSFORM { TRANSX 5 IDENTITY ROTZ 30 } } }",
            "SOLID { SPHERE { TRANSFORM { IDENTITY ROTZ 30 } } }",
        ),
    ],
)
def test_a_fix_mends(wrong: str, mended: str) -> None:
    fix = next(diagnostic.fix for diagnostic in m3dc.compile(wrong).diagnostics if diagnostic.fix is not None)
    assert wrong[: fix.span.start] + fix.text + wrong[fix.span.end :] == mended


@pytest.mark.parametrize(
    "wrong",
    [
        "SOLID { SPHERE { CENTER < 1, 2 > } }",  # what the third number is nobody knows
        "SOLID { SPHERE { RADIUS 2x } }",
        "VARIABLES { NUMBER a; VECTOR a; }",
        "VARIABLES { NUMBER a; } a = -5 SCENE { DEPTH a }",
    ],
)
def test_what_is_not_certain_has_no_fix(wrong: str) -> None:
    assert [diagnostic.fix for diagnostic in m3dc.compile(wrong).diagnostics] != []
    assert not any(diagnostic.fix for diagnostic in m3dc.compile(wrong).diagnostics)


WITHOUT_SCENE = {"M3D0112", "M3D0113", "M3D0115"}  # an empty file, a binary one, one with ten thousand errors


def test_every_code_is_shown() -> None:
    """Each code of the catalogue stands in a scene."""
    shown = {m.code for scene in SCENES for m in marks(scene.read_text(encoding="utf-8"))}
    assert shown == set(CATALOGUE) - WITHOUT_SCENE


def test_the_catalogue_is_in_order() -> None:
    entries = [value for value in vars(catalogue).values() if isinstance(value, Entry)]
    assert [entry.code for entry in entries] == sorted(CATALOGUE), "no code twice, and each in its place"


@pytest.mark.parametrize("package", ["compiler/m3dc", "renderer/m3d_render", "lsp/m3d_lsp", "tools"])
def test_code_calls_diagnostics_by_name(package: str) -> None:
    """`catalogue.NO_LIGHT` and not its code, so that a reader knows what is meant and a type checker that it exists."""
    for file in (ROOT / package).rglob("*.py"):
        if file.samefile(catalogue.__file__):
            continue
        tree = ast.parse(file.read_text(encoding="utf-8"))
        texts = [node for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)]
        for text in texts:
            assert not re.fullmatch(r"M3D\d{4}", str(text.value)), f"{file}:{text.lineno}"


@pytest.mark.parametrize("code", CATALOGUE)
def test_each_entry_shows_what_causes_it_and_how_to_mend_it(code: str) -> None:
    entry = CATALOGUE[code]
    assert code in {diagnostic.code for diagnostic in m3dc.compile(entry.wrong).diagnostics}
    mended = m3dc.compile(entry.right)
    assert code not in {diagnostic.code for diagnostic in mended.diagnostics}
    assert mended.ok
    assert entry.says.endswith(".")


def test_related_places_and_details_help() -> None:
    result = m3dc.compile("VARIABLES { NUMBER radius; }\nradius = 1 SOLID { SPHERE { RADIUS radus } }")
    diagnostic = next(d for d in result.diagnostics if d.code == "M3D0202")
    assert "radius" in diagnostic.detail
    assert diagnostic.fix is not None
    assert diagnostic.fix.text == "radius"
    result = m3dc.compile("SCENE { } SCENE { }")
    (diagnostic,) = result.diagnostics
    assert diagnostic.related[0].span.bytes == (0, 5)
