"""The fuzz targets: failures are found and come again by their seeds; a fixed number of cases of each has none."""

from __future__ import annotations

import importlib
import math
import random

import pytest

from fuzz import TARGETS, USUAL_CASES, Failure, repeating

pytestmark = pytest.mark.slow


def make(chance: random.Random) -> bytes:
    return b"%d" % chance.randrange(10)


def check(data: bytes) -> str | None:
    if data == b"3":
        raise ValueError("three")
    return "seven" if data == b"7" else None


def test_what_fails_is_found_and_made_again_by_its_seed() -> None:
    run = repeating(make, check)
    failures = run(math.inf, 1, cases=60)
    assert {failure.input for failure in failures} == {b"3", b"7"}
    for failure in failures:
        [again] = run(math.inf, failure.seed, cases=1)
        assert again == failure
        assert "ValueError: three" in again.what or again == Failure(again.seed, b"7", "seven")


def test_it_ends_when_its_time_is_over() -> None:
    assert repeating(make, check)(0.0, 1) == []


@pytest.mark.parametrize("name", TARGETS)
def test_nothing_is_found_in_a_few_cases(name: str) -> None:
    target = importlib.import_module(f"fuzz.{name}")
    assert target.run(math.inf, 1, cases=getattr(target, "CASES", USUAL_CASES)) == []


# What was found once, made small.
KEPT = {
    "editor": (
        b"SOLID { SPHERE { CENTER < 1e20, 0, 0 > TRANSFORM { SCALEX 1e300 } } TRANSFORM { SCALEX 1e300 ROTX 3 } }",
        b"SOLID { TRIANGLE { VERTEX1 < 1e20, 0, 0 > TRANSFORM { SCALEX 1e200 } } TRANSFORM { SCALEX 1e100 } }",
    ),
    "text": (
        b"SOLID COLORS MBIENT }",
        b"SOLID { SPHERE { CENTER < 1e20, 0, 0 > } TRANSFORM { SCALE < 1e300, 1e300, 1e300 > } }",
        b"SOLID { POLYGONS { VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> } SFACETS { 1 0 1 2 <0,0,1> <0,0,1> <0,0,1> } } "
        b"TRANSFORM { SCALEX 1e-300 } }",
    ),
    "wireframe": (
        b"SOLID { TERRAIN { VERTICES { 2 3 <0,0,0> <0,2,0> <0,10,0> <1,0,0> <1,1,0> <1e18,1,0> } } }",
        b"SOLID { SPHERE { RADIUS 1e-320 CENTER < 20, 0, 6 > } }",
        b"SOLID { TRANSFORM { SCALEZ 0.68 TRANSX 2.86e+19 } RECTANGLE { VERTEX1 < 9, 2, 1 > VERTEX2 < 2, 892, -31 > } "
        b"SPHERE { CENTER < 0, 1, -1 > } }",
    ),
}


@pytest.mark.parametrize(("name", "data"), [(name, data) for name, inputs in KEPT.items() for data in inputs])
def test_what_was_found_once_stays_right(name: str, data: bytes) -> None:
    assert importlib.import_module(f"fuzz.{name}").check(data) is None
