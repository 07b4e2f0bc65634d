"""Fuzzing: input that nobody would think of, made from a seed, and what must hold of it all the same.

python -m fuzz                          every target, two minutes each
python -m fuzz text edits --seconds 600
python -m fuzz text --seed 42 --cases 1 one case again, by the seed that a failure names
python -m fuzz text --input FILE        one input again: a file that a failure was saved in

A target is a module here, named in `TARGETS`, with

    def make(chance: random.Random) -> bytes        an input
    def check(data: bytes) -> str | None            what is wrong with what comes of it; it may raise, too
    SUFFIX: str                                     of a file with such an input
    CASES: int                                      how many the test suite tries (20 without)

and `run = repeating(make, check)`, or a `run` of its own: (seconds, seed, cases=None) -> list[Failure].
"""

from __future__ import annotations

import os
import random
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

TARGETS = ("text", "edits", "editor", "wireframe", "m3ir", "protocol", "kernel")

USUAL_CASES = 20

# After so many failures a target ends: more of them seldom say more.
MOST_FAILURES = 10


@dataclass(frozen=True)
class Failure:
    """An input for which something does not hold. `seed` makes it again, `what` says what is wrong."""

    seed: int
    input: bytes
    what: str


class Run(Protocol):
    """Tries inputs until the seconds are over, or so many cases; returns what failed. Case n is made of seed + n."""

    def __call__(self, seconds: float, seed: int, cases: int | None = None) -> list[Failure]: ...


def repeating(make: Callable[[random.Random], bytes], check: Callable[[bytes], str | None]) -> Run:
    """The `run` of a target whose cases do not depend on each other."""

    def run(seconds: float, seed: int, cases: int | None = None) -> list[Failure]:
        failures: list[Failure] = []
        end = time.monotonic() + seconds
        number = 0
        while (cases is None or number < cases) and time.monotonic() < end and len(failures) < MOST_FAILURES:
            data = make(random.Random(seed + number))
            remember(seed + number, data)
            what = outcome(check, data)
            if what is not None:
                failures.append(Failure(seed + number, data, what))
            number += 1
        return failures

    return run


def outcome(check: Callable[[bytes], str | None], data: bytes) -> str | None:
    """What is wrong with an input; what `check` raises is wrong, too."""
    try:
        return check(data)
    except KeyboardInterrupt:
        raise
    except BaseException:
        return traceback.format_exc()


def remember(seed: int, data: bytes) -> None:
    """Keep the case that is about to be tried where it is found if it ends the whole process."""
    place = os.environ.get("FUZZ_CURRENT_CASE")
    if place:
        Path(place).write_bytes(b"%d\n" % seed + data)
