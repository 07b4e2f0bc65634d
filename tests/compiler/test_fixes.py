"""Fixes that are certain never guess: all of them at once, again and again until none is left, add no error, change
nothing of what a scene without errors means, and come to an end."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from marks import without_marks
from mutations import mutations

import m3dc
from m3d_language.table import LANGUAGE
from m3dc.diagnostics import all_certain
from m3dc.diagnostics.catalogue import CATALOGUE
from m3dc.diagnostics.spelling import certain, nearest

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
DIAGNOSTICS = Path(__file__).parent / "diagnostics"
MOST_ROUNDS = 10
"""A fix may show what was hidden behind it, and that another fix."""


def fixed(data: bytes) -> bytes:
    """A text with all its certain fixes made at once."""
    for diagnostic in reversed(all_certain(m3dc.compile(data).diagnostics)):
        assert diagnostic.fix is not None
        (start, end), new = diagnostic.fix.span.bytes, diagnostic.fix.text
        data = data[:start] + new.encode() + data[end:]
    return data


def errors(result: m3dc.Result) -> int:
    return sum(diagnostic.severity == "error" for diagnostic in result.diagnostics)


def spread(ir: m3dc.SceneIR) -> list[object]:
    """All values in an IR, but for where they were written."""
    tables = [
        (table, column, repr(values.tolist()))
        for table, columns in ir.tables.items()
        for column, values in columns.items()
        if column not in ("span", "offset")
    ]
    return [ir.scene._replace(spans={}), *tables]


def check(data: bytes, *, hidden: bool = False) -> None:
    """That the law holds of a text. A mended syntax error may bring to light others that were `hidden` behind it."""
    for _ in range(MOST_ROUNDS):
        after = fixed(data)
        if after == data:
            return
        was, now = m3dc.compile(data), m3dc.compile(after)
        assert hidden or errors(now) <= errors(was), after.decode()
        if was.ok:
            assert spread(now.ir) == spread(was.ir), after.decode()
        data = after
    pytest.fail(f"no end: {data.decode()}")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["merman", "runway", "wheel", "two-balls", "cylinder-and-cone"])
def test_of_examples_with_a_slip(name: str) -> None:
    text = (EXAMPLES / f"{name}.m3d").read_text(encoding="utf-8")
    for mutation in mutations(text, random.Random(name), 300):
        check(mutation.text.encode())


@pytest.mark.parametrize("scene", sorted(DIAGNOSTICS.glob("*.m3d")), ids=lambda path: path.stem)
def test_of_scenes_that_show_diagnostics(scene: Path) -> None:
    text = without_marks(scene.read_text(encoding="utf-8"))
    check(text.encode())
    for mutation in mutations(text, random.Random(scene.stem), 20) if text.isascii() else ():
        check(mutation.text.encode(), hidden=True)


@pytest.mark.parametrize("code", CATALOGUE)
def test_of_the_example_of_a_diagnostic(code: str) -> None:
    check(CATALOGUE[code].wrong.encode())


def misspelt() -> Iterator[tuple[str, str, str]]:
    """For each keyword of each block: the block, the keyword, and it in small letters."""
    for block in LANGUAGE.blocks.values():
        for keyword in block.members():
            yield block.keyword, keyword, keyword.lower()


@pytest.mark.parametrize(("block", "keyword", "small"), list(misspelt()))
def test_small_letters_are_certain(block: str, keyword: str, small: str) -> None:
    known = LANGUAGE.blocks[block].members()
    assert nearest(small, known) == keyword
    assert certain(small, known) == keyword


@given(st.data())
def test_what_is_one_slip_away_from_two_keywords_is_not_certain(data: st.DataObject) -> None:
    block = LANGUAGE.blocks[data.draw(st.sampled_from(sorted(LANGUAGE.blocks)))]
    known = block.members()
    if not known:
        return
    word = list(data.draw(st.sampled_from(known)))
    at = data.draw(st.integers(0, len(word) - 1))
    word[at : at + data.draw(st.integers(0, 1))] = data.draw(st.sampled_from(["", "E", "X", "S"]))
    slipped = "".join(word)
    meant = certain(slipped, known)
    if meant is not None:
        assert nearest(slipped, known) == meant


@pytest.mark.parametrize(
    ("word", "block", "meant"),
    [
        ("RADUIS", "SPHERE", "RADIUS"),
        ("COLOUR", "SURFACE", "COLOR"),
        ("CENTRE", "SPHERE", "CENTER"),
        ("HIGHT", "VIEW", "HEIGHT"),
        ("TRANZ", "TRANSFORM", "TRANSZ"),
        ("SFACET", "POLYGONS", "SFACETS"),
        ("translate", "SOLID", None),
        ("TRANSW", "TRANSFORM", None),
        ("ROT", "TRANSFORM", None),
        ("VERTEX", "TRIANGLE", None),
        ("WAVES", "BUMPS", None),
        ("POINTS", "SOURCE", "POINT"),
    ],
)
def test_words(word: str, block: str, meant: str | None) -> None:
    known = LANGUAGE.blocks[block].members()
    assert certain(word, known) == meant


def test_the_documented_default_can_be_written() -> None:
    """Every statement with the value that it has without being written."""
    number = re.compile(r"\d")
    for keyword, block in LANGUAGE.blocks.items():
        for statement in block.statements.values():
            if statement.is_flag or statement.default is None:
                continue
            values = statement.default if isinstance(statement.default, tuple) else (statement.default,)
            vector = statement.arguments[0].shape == "vector"
            written = f"< {', '.join(map(repr, values))} >" if vector else ", ".join(map(repr, values))
            assert number.search(written)
            text = f"{statement.keyword} {written}"
            inside = keyword
            while inside not in LANGUAGE.top:
                text = f"{inside} {{ {text} }}"
                inside = LANGUAGE.parents[inside][0]
            found = m3dc.compile(f"{inside} {{ {text} }}").diagnostics
            assert not [d for d in found if d.code in ("M3D0401", "M3D0402", "M3D0422", "M3D0423", "M3D0420")], text
