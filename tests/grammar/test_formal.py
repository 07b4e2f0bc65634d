"""The formal grammar: where a text stops being a sentence, what could stand there, and Lark's own opinion of it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lark.exceptions import UnexpectedInput

from m3d_language import blank_comments
from m3d_language.formal import END, first_error, parser
from m3d_language.table import LANGUAGE, Block

SENTENCES = [
    "",
    "SCENE { SHADOWS DEPTH 3 VIEW { FROM < 20, 0, 6 > REGION 0, 1, 2, right } AMBIENT { INTENSITY 0.3 } }",
    "VARIABLES { NUMBER a, b; SPHERE ball; } a = 3 ball = { RADIUS a } ball = other { RADIUS 2 } x = y",
    "SOLID house SOLID { SPHERE ball { RADIUS 1 } SURFACE brick TERRAIN { VERTICES { 2 2 corner < 1, 0, x > } } }",
    "SOLID{SPHERE{CENTER<1,2,3>RADIUS 5}}LIGHT{}",
    "SOLID { /* one /* two */ */ }",
]
TOP = {"SCENE", "SOLID", "LIGHT", "VARIABLES", "IDENTIFIER", END}


@pytest.mark.parametrize("text", SENTENCES)
def test_sentences(text: str) -> None:
    assert first_error(text) is None


@pytest.mark.parametrize("block", LANGUAGE.blocks.values(), ids=lambda block: block.keyword)
def test_the_example_of_every_block_is_one(block: Block) -> None:
    example = block.example
    keyword = block.keyword
    while keyword not in LANGUAGE.top:
        keyword = LANGUAGE.parents[keyword][0]
        example = f"{keyword} {{ {example} }}"
    assert first_error(example) is None


def test_the_example_of_variables_is_one() -> None:
    assert first_error(LANGUAGE.variables["example"]) is None


# `^` stands under the token that does not fit; then what could, and the block that it is in.
@pytest.mark.parametrize(
    ("text", "mark", "expected", "block"),
    [
        ("SOLID { SPHERE { RADIUS } }",
         "                        ^", {"IDENTIFIER", "NUMERAL"}, "SPHERE"),
        ("SOLID { SPHERE { CENTER 5 } }",
         "                        ^", {"IDENTIFIER", "LANGLE"}, "SPHERE"),
        ("SOLID { SPHERE { CENTER < 1, 2 3 > } }",
         "                               ^", {"COMMA"}, "SPHERE"),
        ("SOLID { SPHERE { RADIUS 1 RAD 2 } }",
         "                          ^^^", {"RADIUS", "CENTER", "TRANSFORM", "RBRACE"}, "SPHERE"),
        ("SOLID { SPHERE { RADIUS 1",
         "                         ", {"RADIUS", "CENTER", "TRANSFORM", "RBRACE"}, "SPHERE"),
        ("SCENE view { }",
         "      ^^^^", {"LBRACE"}, None),
        ("SOLID { } }",
         "          ^", TOP, None),
        ("x SOLID { }",
         "  ^^^^^", {"EQUAL"}, None),
        ("x = SPHERE",
         "    ^^^^^^", {"IDENTIFIER", "NUMERAL", "LANGLE", "LBRACE"}, None),
        ("VARIABLES { NUMBER a b; }",
         "                     ^", {"COMMA", "SEMICOLON"}, "VARIABLES"),
        ("VARIABLES { NUMBER SOLID; }",
         "                   ^^^^^", {"IDENTIFIER"}, "VARIABLES"),
        ("VARIABLES { COLOUR red; }",
         "            ^^^^^^", {*LANGUAGE.types, "RBRACE"}, "VARIABLES"),
        ("SCENE { MIRAGE { PROFILE { 0 1 2 } } }",
         "                                 ^", {"IDENTIFIER", "NUMERAL"}, "PROFILE"),
        ("SOLID { POLYGONS { VERTICES { 1 2 } } }",
         "                                ^", {"IDENTIFIER", "LANGLE", "RBRACE"}, "VERTICES"),
        ("SOLID { SPHERE { RADIUS 1.2.3 } }",
         "                        ^^^^^", {"IDENTIFIER", "NUMERAL"}, "SPHERE"),
        ("SOLID { SPHERE { RADIUS5 } }",
         "                 ^^^^^^^", {"RADIUS", "CENTER", "TRANSFORM", "RBRACE"}, "SPHERE"),
        ("SOLID { } */",
         "          ^^", TOP, None),
        ("SOLID { /* for ever }",
         "        ^^", {"SPHERE", "PLANE", "TRIANGLE", "RECTANGLE", "POLYGONS", "TERRAIN", "SURFACE", "TRANSFORM",
                       "RBRACE"}, "SOLID"),
        ("SOLID { } @",
         "          ^", TOP, None),
    ],
)  # fmt: skip
def test_the_first_error(text: str, mark: str, expected: set[str], block: str | None) -> None:
    fault = first_error(text)
    assert fault is not None
    assert " " * fault.offset + "^" * fault.length == mark
    assert fault.expected == expected
    assert fault.block == block


def test_offsets_count_blanked_comments() -> None:
    fault = first_error("/* ein\n/* zwei */ */ SOLID { oops }")
    assert fault is not None
    assert fault.offset == 29


def lark_accepts(text: str) -> bool:
    try:
        parser().parse(text)  # pyright: ignore[reportUnknownMemberType]  Lark says too little
    except UnexpectedInput:
        return False
    return True


words = st.sampled_from([*sorted(LANGUAGE.keywords), *"{}<>,;=", "x", "1", "2.5", "1.", "-", "x1", "1x", "é"])


@given(st.sampled_from(SENTENCES[:-1]), st.data())
def test_it_agrees_with_lark(sentence: str, data: st.DataObject) -> None:
    """Also on sentences with some tokens put in, taken out or exchanged."""
    tokens = sentence.split()
    for _ in range(data.draw(st.integers(0, 2))):
        at = data.draw(st.integers(0, len(tokens)))
        tokens[at : at + data.draw(st.integers(0, 1))] = data.draw(st.lists(words, max_size=2))
    text = " ".join(tokens)
    assert (first_error(text) is None) == lark_accepts(text)


@given(st.sampled_from(SENTENCES), st.data())
def test_what_it_expects_can_stand_there(sentence: str, data: st.DataObject) -> None:
    text = sentence[: data.draw(st.integers(0, len(sentence)))]
    fault = first_error(f"{text} @")
    assert fault is not None
    if fault.offset == len(text) + 1:
        spelling = {"LBRACE": "{", "RBRACE": "}", "LANGLE": "<", "RANGLE": ">", "COMMA": ",", "SEMICOLON": ";"}
        spelling |= {"EQUAL": "=", "NUMERAL": "1", "IDENTIFIER": "x"}
        for terminal in fault.expected - {END}:
            after = first_error(f"{text} {spelling.get(terminal, terminal)} @")
            assert after is not None
            assert after.offset > fault.offset, terminal
        assert (END in fault.expected) == (first_error(text) is None)


# --- comments ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "blanked"),
    [
        ("a /* b */ c", "a         c"),
        ("a/*/* b */*/c", "a           c"),
        ("a /* b\r\n c */ d", "a      \n      d"),
        ("/**/x/***/", "    x     "),
        ("/*/ x */ y", "         y"),
        ("a */ b", "a */ b"),
        ("a /* b /* c */ d", "a /* b /* c */ d"),
        ("", ""),
    ],
)
def test_comments_are_blanked(text: str, blanked: str) -> None:
    assert blank_comments(text) == blanked


@given(st.text("/* \nx", max_size=40))
def test_blanking_keeps_lengths_and_lines(text: str) -> None:
    blanked = blank_comments(text)
    assert len(blanked) == len(text)
    assert [i for i, c in enumerate(blanked) if c == "\n"] == [i for i, c in enumerate(text) if c == "\n"]
    assert blank_comments(blanked) == blanked


def test_ten_thousand_comments_deep() -> None:
    text = "/*" * 10_000 + "*/" * 10_000
    assert blank_comments(text) == " " * len(text)
