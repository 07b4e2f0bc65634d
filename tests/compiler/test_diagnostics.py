"""Diagnostics, scene by scene: each mark in tests/compiler/diagnostics has its diagnostic, each diagnostic its mark."""

from __future__ import annotations

from pathlib import Path

import pytest
from marks import mark, marks, with_marks, without_marks

import m3dc
from m3dc.catalogue import CATALOGUE

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
        (start, end), new = diagnostic.fix.span, diagnostic.fix.text
        data = text.encode()
        mended = m3dc.compile(data[:start] + new.encode() + data[end:])
        assert sum(d.severity == "error" for d in mended.diagnostics) <= errors
        assert diagnostic._replace(fix=None) not in [d._replace(fix=None) for d in mended.diagnostics]


WITHOUT_SCENE = {"M3D0112", "M3D0113", "M3D0115"}  # an empty file, a binary one, one with ten thousand errors


def test_every_code_is_shown() -> None:
    """Each code of the catalogue stands in a scene."""
    shown = {m.code for scene in SCENES for m in marks(scene.read_text(encoding="utf-8"))}
    assert shown == set(CATALOGUE) - WITHOUT_SCENE


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
    assert diagnostic.related[0].span == (0, 5)
