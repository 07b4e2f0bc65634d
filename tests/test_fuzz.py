"""The fuzz targets: failures are found and come again by their seeds; a fixed number of cases of each has none."""

from __future__ import annotations

import importlib
import math
import random

import pytest

from fuzz import TARGETS, USUAL_CASES, Failure, repeating


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
