"""Every kind of primitive is known to everyone who has to know it. A kind that somebody forgets fails here.

Hover is tested likewise in tests/lsp/test_hover.py.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from primitives import ENDLESS, PRIMITIVES, scene

import m3d_render
import m3dc
from bench import povray
from m3d_language.table import LANGUAGE
from m3d_render.geometry import ViewPlane
from m3d_render.plot.section import section
from m3d_render.view.bodies import bodies
from m3d_render.view.ground import ground
from m3d_render.wireframe import edges
from m3dc.ir import PRIMITIVE_TABLE, PrimitiveKind, SceneIR
from m3dc.ir.dump import dump


@pytest.fixture(params=PrimitiveKind, ids=lambda kind: kind.name)
def kind(request: pytest.FixtureRequest) -> Iterator[PrimitiveKind]:
    return request.param


@pytest.fixture
def ir(kind: PrimitiveKind) -> SceneIR:
    result = m3dc.compile(scene(kind))
    assert result.diagnostics == ()
    return result.ir


def test_the_language_has_just_these() -> None:
    assert {kind.name for kind in PrimitiveKind} == set(PRIMITIVES_OF_A_SOLID)
    assert set(PRIMITIVES) == set(PrimitiveKind) == set(PRIMITIVE_TABLE)


PRIMITIVES_OF_A_SOLID = [word for word in LANGUAGE.blocks["SOLID"].holds if word not in ("TRANSFORM", "SURFACE")]


def test_it_is_compiled(ir: SceneIR, kind: PrimitiveKind) -> None:
    assert ir["primitives"]["kind"].tolist() == [kind]
    assert len(next(iter(ir[PRIMITIVE_TABLE[kind]].values()))) == 1
    assert (ir.scene.extent is None) == (kind in ENDLESS)


def test_a_narrow_light_that_misses_it_is_found(kind: PrimitiveKind) -> None:
    """An endless plane is reached by any light, as far as that is looked into."""
    light = "LIGHT { SOURCE { POINT FROM < 0, 0, 9 > TO < 0, 0, 10 > ANGLE 5 } }"
    found = m3dc.compile(scene(kind).replace("LIGHT { SOURCE { FROM < 0, 0, 9 > TO < 20, 0, 0 > POINT } }", light))
    assert ("M3D0505" in {diagnostic.code for diagnostic in found.diagnostics}) == (kind not in ENDLESS)


def test_it_is_dumped(ir: SceneIR, kind: PrimitiveKind) -> None:
    alone = m3dc.compile(scene(kind).replace(PRIMITIVES[kind], "")).ir
    assert len(dump(ir, "").splitlines()) > len(dump(alone, "").splitlines()) + 5


def test_it_has_edges(ir: SceneIR) -> None:
    (drawn,) = edges(ir)
    assert len(drawn.starts) == len(drawn.ends) >= 3


def test_it_is_cut(ir: SceneIR, kind: PrimitiveKind) -> None:
    (cut,) = section(ir, ViewPlane.of(ir))
    assert (cut.level is None, len(cut.segments) > 0) == ((False, False) if kind in ENDLESS else (True, True))


def test_it_is_in_the_viewer(ir: SceneIR) -> None:
    shown = [*bodies(ir), ground(ir).patches]
    assert np.concatenate([mesh.primitives for mesh in shown]).max(initial=-1) == 0


def test_it_is_rendered(ir: SceneIR) -> None:
    picture = m3d_render.render(ir)
    red, green, blue = np.moveaxis(picture, -1, 0)
    assert ((red > green) & (green > blue)).mean() > 0.01


def test_povray_gets_it(ir: SceneIR) -> None:
    with_it = "\n".join(povray.translate(ir, shadows=True))
    assert with_it.count("pigment") == 1
