"""Scenes that a few words make very large, and texts that cost more than they are long: a limit is said, and work is
in proportion to the text."""

from __future__ import annotations

import cProfile
import itertools
import pstats
import tracemalloc
from collections.abc import Callable

import pytest

import m3dc
from m3d_language.table import LANGUAGE
from m3dc.analysis import Analyser

pytestmark = pytest.mark.slow

FOREST = "VARIABLES { SOLID a; } a = { " + "SPHERE { } " * 2000 + "} "


def test_more_primitives_than_fit_are_said_at_the_one_too_many() -> None:
    text = FOREST + "SOLID a " * 3000 + "SCENE { DEPTH 5 }"
    result = m3dc.compile(text)
    (error,) = (d for d in result.diagnostics if d.severity == "error")
    assert (error.code, error.headline) == ("M3D0412", "Too many solids, primitives and textures")
    assert error.detail == "with this there are 2,001,000, at most 2,000,000"
    assert text[: error.span.start].count("SOLID a ") == LANGUAGE.limits["parts"] // 2001
    assert len(result.ir["primitives"]["kind"]) == 0
    assert result.ir.scene.depth == 5
    assert Analyser().analyse(m3dc.Source(text.encode())).diagnostics == result.diagnostics


def test_facets_and_textures_are_counted() -> None:
    side = 200
    rows = " ".join(f"< {x}, {y}, 0 >" for x in range(side) for y in range(side))
    terrain = f"VARIABLES {{ SOLID a; }} a = {{ TERRAIN {{ VERTICES {{ {side} {side} {rows} }} }} }} "
    assert m3dc.compile(terrain + "SOLID a " * 50).ok
    codes = [d.code for d in m3dc.compile(terrain + "SOLID a " * 200).diagnostics if d.severity == "error"]
    assert codes == ["M3D0412"]
    waves = "VARIABLES { SURFACE s; } s = { TEXTURE { WAVES { " + "WAVE { } " * 3000 + "} } } "
    codes = [d.code for d in m3dc.compile(waves + "SOLID { SPHERE { } SURFACE s } " * 800).diagnostics]
    assert "M3D0412" in codes


def test_copies_share_their_parts() -> None:
    text = "VARIABLES { SOLID a; } " + "a = { SPHERE { } } " * 20_000 + "SOLID a a = { SPHERE { RADIUS 3 } } SOLID a"
    tracemalloc.start()
    solids = Analyser().analyse(m3dc.Source(text.encode())).world.solids
    assert [len(solid.parts) for solid in solids] == [20_000, 20_001]
    assert tracemalloc.get_traced_memory()[1] < 400_000_000  # two billion, if each had them all
    tracemalloc.stop()
    assert [part.number("RADIUS") for part in solids[1].parts[-2:]] == [1, 3]
    assert sum(1 for _ in solids[1].parts) == 20_001


def calls(work: Callable[[], object]) -> int:
    """How many calls of functions something takes: what it costs, on any machine."""
    profile = cProfile.Profile()
    profile.runcall(work)
    return vars(pstats.Stats(profile))["total_calls"]


def chain(count: int) -> str:
    names = [f"name{number}" for number in range(count)]
    assignments = "\n".join(f"{name} = {before}" for before, name in itertools.pairwise(names))
    return f"VARIABLES {{ SURFACE {', '.join(names)}; }} name0 = {{ }} {assignments} SOLID {{ SPHERE {{ }} }}"


TEXTS: dict[str, Callable[[int], str]] = {
    "names assigned in a row": chain,
    "undeclared names": lambda n: "VARIABLES { NUMBER " + ", ".join(f"name{i}x" for i in range(n)) + "; } SOLID { "
    "SPHERE { " + " ".join(f"RADIUS name{i}" for i in range(n)) + " } }",
    "unknown types": lambda n: "VARIABLES { " + " ".join(f"NUMBRE{i} x{i};" for i in range(n)) + " }",
    "one solid": lambda n: "SOLID { " + "SPHERE { RADIUS 2 } " * n + "}",
    "parts added one by one": lambda n: "VARIABLES { SOLID a; } " + "a = { SPHERE { } } " * n + "SOLID a",
    "open blocks": lambda n: "SOLID { " * n,
    "open lines": lambda n: "SOLID {\n" * n,
    "repeated statements": lambda n: "SOLID { SPHERE { " + "RADIUS 1 " * n + "} }",
    "textures": lambda n: "SOLID { SPHERE { } SURFACE { " + "TEXTURE { CHECKER { } } " * n + "} }",
    "junk": lambda n: "ab $ {} < 3 ; foo\n" * n,
}


@pytest.mark.parametrize("name", TEXTS)
def test_work_is_in_proportion_to_the_text(name: str) -> None:
    small, large = (TEXTS[name](n) for n in (300, 1200))
    m3dc.compile(large)  # what is loaded when it is first needed is loaded
    costs = [calls(lambda text=text: Analyser().analyse(m3dc.Source(text.encode()))) for text in (small, large)]
    assert costs[1] < 6 * costs[0]
