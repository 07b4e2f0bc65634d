"""Texts that are no scenes, of any length: what is found is bounded, and the work grows no faster than the text."""

from __future__ import annotations

import random
import sys
from types import FrameType

import pytest

import m3dc

CHANCE = random.Random(1993)
WORDS = ["alpha", "SOLID", "{", "}", "2", "<", ">", "x", "=", "SPHERE", "\n", "("]
JUNK = {
    "closing braces": "}",
    "closing braces after a solid": "SOLID { } }",
    "opening braces": "{",
    "solids that are not closed": "SOLID{",
    "assignments in blocks": "SOLID { a = { ",
    "commas": ",",
    "semicolons in a table": ";1",
    "equals signs": "a=",
    "less than": "<",
    "calls": "x(",
    "hyphens": "a-",
    "comments of C": "// x\n",
    "prose": "Lorem ipsum dolor sit amet, consectetur adipiscing elit.\n",
    "JSON": '{"a": [1, 2, 3], "b": {"c": "text"}},\n',
    "tags": '<sphere radius="1"/>\n',
    "one long word": "x",
    "words at random": " ".join(CHANCE.choices(WORDS, k=1000)),
}


def work(text: str) -> tuple[int, int]:
    """How many functions are called to compile a text, and how many findings it has."""
    count = 0

    def called(_frame: FrameType, event: str, _argument: object) -> None:
        nonlocal count
        count += event.endswith("call")

    sys.setprofile(called)
    try:
        found = m3dc.compile(text).diagnostics
    finally:
        sys.setprofile(None)
    return count, len(found)


@pytest.mark.parametrize("unit", JUNK.values(), ids=JUNK)
def test_the_work_grows_no_faster_than_the_text(unit: str) -> None:
    m3dc.compile(unit)  # what is done once is not counted
    (once, _), (twice, found) = (work(unit * (length // len(unit))) for length in (4_000, 8_000))
    assert twice <= 2.2 * once + 20_000
    assert 1 <= found <= 210
