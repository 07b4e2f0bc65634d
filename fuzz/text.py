"""Any text is compiled without an exception or a warning of Python's, and what has no error is a sound scene."""

from __future__ import annotations

import random
import warnings

import m3dc
from m3dc.analysis import Analyser
from m3dc.ir.soundness import fault

from . import repeating
from .scenes import Scenes, broken

SUFFIX = ".m3d"
CASES = 300


def make(chance: random.Random) -> bytes:
    text = Scenes(chance, chance.choice((0.0, 0.1, 0.5))).scene()
    if chance.random() < 0.5:
        text = broken(text, chance)
    data = text.encode("utf-8", "surrogatepass")
    if chance.random() < 0.05:
        at = chance.randrange(len(data) + 1)
        data = data[:at] + chance.randbytes(chance.randint(1, 9)) + data[at:]
    return data


def check(data: bytes) -> str | None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = m3dc.compile(data)
        analysis = Analyser().analyse(m3dc.Source(data))
    if analysis.diagnostics != result.diagnostics:
        return "compile and analyse find different things"
    return fault(result.ir) if result.ok else None


run = repeating(make, check)
