"""What is found of a scene after edits is what is found of its text from the start: diagnostics, IR, items and tree."""

from __future__ import annotations

import json
import random
import warnings
from typing import Any

import m3dc
from m3dc import SceneIR, Source
from m3dc.analysis import Analyser, Analysis

from . import repeating
from .scenes import PIECES, TOKEN, Scenes, broken

SUFFIX = ".json"
CASES = 40

WORDS = ("SPHERE { }", "v0 = v1", "SOLID v0", "RADIUS 2", "VARIABLES { NUMBER more; }", "more = 1", "SCENE { }", "\n\n")


def make(chance: random.Random) -> bytes:
    """The versions of a text, as a JSON list."""
    text = Scenes(chance, 0.05).scene()
    versions = [text]
    for _ in range(chance.randint(1, 8)):
        if chance.random() < 0.1:
            text = broken(text, chance)
        for _ in range(chance.choice((1, 1, 1, 2, 4))):
            text = _edited(text, chance)
        if chance.random() < 0.2:
            text = chance.choice(versions)  # undone
        versions.append(text)
    return json.dumps(versions).encode()


def _edited(text: str, chance: random.Random) -> str:
    tokens = [found.span() for found in TOKEN.finditer(text)] or [(0, 0)]
    start, end = chance.choice(tokens)
    match chance.randrange(5):
        case 0:
            return text[:start] + text[end:]
        case 1:
            at = chance.randint(0, len(text))
            return text[:at] + chance.choice(PIECES) + text[at:]
        case 2:
            return f"{text[:start]}{chance.choice(WORDS)} {text[start:]}"
        case 3:
            other, last = chance.choice(tokens)
            return text[:start] + text[other:last] + text[end:]
        case _:
            other = min(len(text), end + chance.randint(0, 80))
            return text[:start] + text[other:] if chance.random() < 0.5 else text[:other] + text[start:]


def _plain(ir: SceneIR) -> list[str]:
    return [repr(ir.scene), *(repr(c.tolist()) for columns in ir.tables.values() for c in columns.values())]


def _difference(after: Analysis, fresh: Analysis) -> str | None:
    if after.diagnostics != fresh.diagnostics:
        return f"diagnostics: {after.diagnostics}\nfrom the start: {fresh.diagnostics}"
    if _plain(after.ir) != _plain(fresh.ir):
        return "the IR differs"
    if str(after.tree.root_node) != str(fresh.tree.root_node):
        return "the tree differs"
    items: list[list[Any]] = [[(top.start, top.item) for top in analysis.items] for analysis in (after, fresh)]
    return None if repr(items[0]) == repr(items[1]) else "the items differ"


def check(data: bytes) -> str | None:
    analyser = Analyser()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for number, version in enumerate(json.loads(data)):
            text = version.encode("utf-8", "surrogatepass")
            fresh = Analyser().analyse(Source(text))
            what = _difference(analyser.analyse(Source(text)), fresh)
            if what is not None:
                return f"version {number}: {what}"
            if fresh.diagnostics != m3dc.compile(text).diagnostics:
                return f"version {number}: compile finds something else"
    return None


run = repeating(make, check)
