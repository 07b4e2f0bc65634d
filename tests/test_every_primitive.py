"""Every kind of primitive is known to everyone who has to know it. Where one is forgotten, a failure here says."""

from __future__ import annotations

import re
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from primitives import ENDLESS, LIGHT, scene

import m3d_render
import m3dc
from bench import povray
from m3d_language.table import LANGUAGE
from m3d_lsp.resolved import facts
from m3d_render import wireframe
from m3d_render.geometry import ViewPlane
from m3d_render.plot.section import section
from m3d_render.view.bodies import bodies
from m3d_render.view.ground import ground
from m3dc.analysis import Analyser
from m3dc.diagnostics import catalogue
from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR, m3ir
from m3dc.ir.dump import dump
from m3dc.syntax import ast
from m3dc.text.source import Source

COMPILER = "compiler/m3dc/meaning/primitive"
FIGURES = "renderer/m3d_render/geometry"
GROUND = "renderer/m3d_render/view/ground.py"
KERNEL = "renderer/crates/ir/src/shapes.rs, then make tools"


@contextmanager
def told_by(file: str) -> Generator[None]:
    """Whatever fails within is to be put right in that file."""
    try:
        yield
    except Exception as fault:
        raise AssertionError(f"see {file}: {fault!r}") from fault


@pytest.fixture(params=PrimitiveKind, ids=lambda kind: kind.name)
def kind(request: pytest.FixtureRequest) -> PrimitiveKind:
    return request.param


@pytest.fixture
def ir(kind: PrimitiveKind) -> SceneIR:
    with told_by(COMPILER):
        result = m3dc.compile(scene(kind))
        assert result.diagnostics == ()
    return result.ir


def test_the_language_has_just_these() -> None:
    of_a_solid = set(LANGUAGE.blocks["SOLID"].holds) - {"TRANSFORM", "SURFACE"}
    assert of_a_solid == {kind.name for kind in PrimitiveKind}, f"grammar/language.toml and {COMPILER}/__init__.py"


def test_it_is_compiled(ir: SceneIR, kind: PrimitiveKind) -> None:
    with told_by(COMPILER):
        assert ir["primitives"]["kind"].tolist() == [kind]
        assert len(next(iter(ir[PRIMITIVE_TABLE[kind]].values()))) == 1
        assert (ir.scene.extent is None) == (kind in ENDLESS)


def test_it_is_written_and_read(ir: SceneIR, tmp_path: Path) -> None:
    with told_by(COMPILER):
        m3ir.write(ir, tmp_path / "scene.m3ir")
        again = m3ir.read(tmp_path / "scene.m3ir")
        assert again.scene == ir.scene
        for table, columns in ir.tables.items():
            for name, column in columns.items():
                assert np.array_equal(again[table][name], column), f"{table}.{name}"


def test_a_narrow_light_that_misses_it_is_found(kind: PrimitiveKind) -> None:
    """An endless plane is reached by any light, as far as that is looked into."""
    light = "LIGHT { SOURCE { POINT FROM < 0, 0, 9 > TO < 0, 0, 10 > ANGLE 5 } }"
    with told_by(COMPILER):
        found = {diagnostic.code for diagnostic in m3dc.compile(scene(kind).replace(LIGHT, light)).diagnostics}
        assert (catalogue.LIGHT_REACHES_NOTHING.code in found) == (kind not in ENDLESS)


def test_it_may_not_be_carried_away(kind: PrimitiveKind) -> None:
    with told_by(COMPILER):
        found = m3dc.compile(scene(kind).replace("TRANSX 20", "TRANSX 1e20 SCALEX 1e11")).diagnostics
        assert catalogue.TOO_FAR.code in {diagnostic.code for diagnostic in found}


def test_it_is_dumped(ir: SceneIR, kind: PrimitiveKind) -> None:
    with told_by(COMPILER):
        alone = m3dc.compile(scene(kind).replace(LANGUAGE.blocks[kind.name].example, "")).ir
        assert len(dump(ir, "").splitlines()) > len(dump(alone, "").splitlines()) + 11


def test_an_editor_tells_of_it(kind: PrimitiveKind) -> None:
    with told_by(COMPILER):
        text = scene(kind)
        analysis = Analyser().analyse(Source(text.encode()))
        start = text.index(kind.name)
        at = ast.locate(analysis.items, (start, start + len(kind.name)))
        here = None if at is None else analysis.enclosing(at)
        assert here is not None
        lines = facts(analysis, here, kind.name).split("\n")
        assert "In the scene:" in lines
        assert any(line.startswith("- extents x") for line in lines) == (kind not in ENDLESS)
        assert any(line.startswith("- ") and "extents" not in line for line in lines)


def test_it_has_edges(ir: SceneIR) -> None:
    with told_by(FIGURES):
        (drawn,) = wireframe.edges(ir)
        assert len(drawn.starts) == len(drawn.ends) >= 3
        assert np.isfinite(drawn.starts).all()


def test_it_is_cut(ir: SceneIR, kind: PrimitiveKind) -> None:
    with told_by(FIGURES):
        (cut,) = section(ir, ViewPlane.of(ir))
        assert (cut.level is None, len(cut.segments) > 0) == ((False, False) if kind in ENDLESS else (True, True))


def test_it_is_in_the_viewer(ir: SceneIR, kind: PrimitiveKind) -> None:
    with told_by(GROUND if kind in ENDLESS else FIGURES):
        shown = [*bodies(ir), ground(ir).patches]
        assert np.concatenate([mesh.primitives for mesh in shown]).max(initial=-1) == 0


def test_it_is_rendered(ir: SceneIR) -> None:
    with told_by(KERNEL):
        red, green, blue = np.moveaxis(m3d_render.render(ir), -1, 0)
        assert ((red > green) & (green > blue)).mean() > 0.01


@pytest.mark.parametrize("kind", set(PrimitiveKind) - ENDLESS, ids=lambda kind: kind.name)
def test_figures_stay_within_its_extent(ir: SceneIR) -> None:
    extent = ir.scene.extent
    assert extent is not None
    with told_by(f"{FIGURES} and {COMPILER}"):
        for points in (*(edge.starts for edge in wireframe.edges(ir)), *(mesh.points for mesh in bodies(ir))):
            assert (points >= np.array(extent.minimum) - 1e-9).all()
            assert (points <= np.array(extent.maximum) + 1e-9).all()


def test_povray_gets_it(ir: SceneIR) -> None:
    with told_by("bench/povray.py"):
        text = "\n".join(povray.translate(ir, shadows=True))
        assert text.count("pigment") == 1
        assert re.search(r"^(sphere|plane|polygon|mesh2) \{", text, re.MULTILINE)


@pytest.mark.parametrize("kind", set(PrimitiveKind) - ENDLESS, ids=lambda kind: kind.name)
def test_povray_gets_triangles_of_what_it_does_not_know(ir: SceneIR, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(povray, "OBJECTS", {})
    text = "\n".join(povray.translate(ir, shadows=True))
    assert text.count("mesh2") == text.count("pigment") == 1
    assert text.count("{") == text.count("}")
