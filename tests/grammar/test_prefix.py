"""What is known at a cursor of the text before it, also where that is no beginning of a sentence."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from m3d_language.formal import END, first_error
from m3d_language.prefix import read_prefix
from m3d_language.table import LANGUAGE

SPHERE = {"CENTER", "RADIUS", "TRANSFORM", "RBRACE"}
TOP = {"SCENE", "SOLID", "LIGHT", "VARIABLES", "IDENTIFIER", END}
MEMBERS_OF_SOLID = {*LANGUAGE.blocks["SOLID"].members(), "RBRACE"}


CASES: list[tuple[str, set[str], list[str], str]] = [
    ("", TOP, [], ""),
    ("SOLID { SPHERE { ", SPHERE, ["SOLID", "SPHERE"], ""),
    ("SOLID { SPHERE { RADIUS ", {"NUMERAL", "IDENTIFIER"}, ["SOLID", "SPHERE"], "RADIUS"),
    ("SOLID { SPHERE { RADIUS r ", SPHERE, ["SOLID", "SPHERE"], "RADIUS r"),
    ("SOLID { SPHERE { CENTER < 1, ", {"NUMERAL", "IDENTIFIER"}, ["SOLID", "SPHERE"], "CENTER < 1 ,"),
    ("SOLID { SPHERE ball", {"LBRACE", *MEMBERS_OF_SOLID}, ["SOLID"], "SPHERE ball"),
    ("SCENE { VIEW { REGION 0, 1", {"COMMA"}, ["SCENE", "VIEW"], "REGION 0 , 1"),
    ("SOLID { POLYGONS { FACETS { 1 0 1", {"NUMERAL", "IDENTIFIER"}, ["SOLID", "POLYGONS", "FACETS"], "1 0 1"),
    ("VARIABLES { NUMBER a; VECTOR v, ", {"IDENTIFIER"}, ["VARIABLES"], "VECTOR v ,"),
    ("a = ", {"NUMERAL", "IDENTIFIER", "LANGLE", "LBRACE"}, [], "a ="),
    ("a = < b, c, ", {"NUMERAL", "IDENTIFIER"}, [], "a = < b , c ,"),
    ("a = 1 b", {"EQUAL"}, [], "b"),
    ("SOLID wheel a", {"EQUAL"}, [], "a"),
    ("ball = other { RADIUS", {"NUMERAL", "IDENTIFIER"}, ["=ball"], "RADIUS"),
    # half-typed
    ("SOLID { SPHERE { RADIUS CENTER ", {"LANGLE", "IDENTIFIER"}, ["SOLID", "SPHERE"], "CENTER"),
    ("SOLID { SPHERE { RADIUS } ", MEMBERS_OF_SOLID, ["SOLID"], ""),
    ("SOLID { SPHERE { RADI 5 CENTER < 1, 2 } SURFACE ", {"IDENTIFIER", "LBRACE"}, ["SOLID"], "SURFACE"),
    ("SOLID { SPHERE { LIGHT { ", {*LANGUAGE.blocks["LIGHT"].members(), "RBRACE"}, ["LIGHT"], ""),
    ("SOLID { SPHER { RADIUS ", set(), ["SOLID", "?"], ""),
    ("SOLID { SPHER { RADIUS { } } SPHERE { ", SPHERE, ["SOLID", "SPHERE"], ""),
    # A name that leads nowhere is given up, and what stood before it goes on.
    ("SOLID wheel a { ", MEMBERS_OF_SOLID, ["SOLID"], ""),
    ("SOLID wheel a { } } ", TOP, [], ""),
    ("wheels { SOLID { SPHERE { ", SPHERE, ["SOLID", "SPHERE"], ""),
    ("} } SOLID ", {"IDENTIFIER", "LBRACE"}, [], "SOLID"),
    ("VARIABLES { SOLID a, ; LIGHT ", {"IDENTIFIER"}, ["VARIABLES"], "LIGHT"),
    ("VARIABLES { NUMBER SCENE { SHADOWS VIEW ", {"LBRACE"}, ["SCENE"], "VIEW"),
    # comments
    ("SOLID { /* SPHERE { */ ", MEMBERS_OF_SOLID, ["SOLID"], ""),
    ("SOLID { /* SPHERE { ", set(), [], ""),
]  # fmt: skip
"""The text before the cursor; what could stand there; the open braces; and what was begun."""


@pytest.mark.parametrize(("text", "expected", "opened", "member"), CASES)
def test_what_is_known_at_the_end(text: str, expected: set[str], opened: list[str], member: str) -> None:
    prefix = read_prefix(text)
    assert prefix.expected == expected
    assert [o.keyword or (f"={o.target}" if o.target else "?") for o in prefix.opened] == opened
    assert " ".join(token.text for token in prefix.member) == member


@given(st.lists(st.sampled_from([*"{}<>,;=", "a", "1", "sphere", *sorted(LANGUAGE.keywords)])))
def test_words_in_any_order_can_be_read(words: list[str]) -> None:
    opened = len(read_prefix(" ".join(words)).opened)
    assert opened <= words.count("{")


@given(st.text(alphabet="{}<>,;= \n/*1a").map(lambda text: text.replace("a", " SPHERE ").replace("1", " 1 ")))
def test_any_text_can_be_read(text: str) -> None:
    prefix = read_prefix(text)
    fault = first_error(f"{text} @")
    assert fault is not None
    # Where the text is the beginning of a sentence, both say the same of what could go on.
    if fault.offset == len(text) + 1:
        assert prefix.expected == fault.expected
