"""The two grammars describe one language.

A sentence made from the formal grammar, and the same with something put in, taken out or exchanged, is accepted by both
or rejected by both. On the formal side that is `first_error`; on the other, the tree-sitter grammar, which is
permissive about which keyword stands where, together with the compiler's check against the table.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.lark import from_lark

from m3d_language.formal import first_error, parser
from m3d_language.table import LANGUAGE
from m3dc.diagnostics.catalogue import CATALOGUE
from m3dc.meaning.check import structural_faults
from m3dc.text.source import Source

# How a terminal is spelt. A blank follows each, so that no two become one; blanks are taken out again below.
SPELLINGS: dict[str, st.SearchStrategy[str]] = {
    "IDENTIFIER": st.sampled_from(["x", "the_ground", "F15", "Sphere", "e5", "SOLIDS", "SPHERE_2", "a" * 300]),
    "NUMERAL": st.sampled_from(["0", "-1", "+2.50", "1e3", "4.8E-10", "007", "1e999", "3"]),
    "BLANK": st.sampled_from([" ", "\n", "\t", "\r\n", "/* < */ ", "/* a /* } */ b */"]),
    **{keyword: st.just(keyword) for keyword in LANGUAGE.keywords - set(LANGUAGE.reserved)},
}
sentences = from_lark(
    parser(), explicit={name: words.map(lambda word: f"{word} ") for name, words in SPELLINGS.items()}
)
TOKEN = re.compile(r"/\*.*?\*/|[^\s{}<>,;=]+|\S", re.DOTALL)
pieces = st.one_of(
    st.sampled_from(sorted(LANGUAGE.keywords)),
    st.sampled_from([*"{}<>,;=", "x", "y", "1", "2", "< 1, 2, 3 >", "{ }", "SOLID { }", "x = 1"]),
    st.sampled_from(["1.", ".5", "1e", "1.2.3", "--1", "-", "5x", "_x", "/*", "*/", "/", "@", "é", '"']),
)


@st.composite
def nearly_sentences(draw: Any) -> str:
    """A sentence of at most some dozens of tokens with a change or two in it."""
    tokens = TOKEN.findall(draw(sentences))[:80]
    for _ in range(draw(st.integers(1, 2))):
        at = draw(st.integers(0, len(tokens)))
        tokens[at : at + draw(st.integers(0, 2))] = draw(st.lists(pieces, max_size=2))
    return " ".join(tokens)


def agree(text: str) -> None:
    fault = first_error(text.encode().decode("latin-1"))
    faults = structural_faults(Source(text.encode()))
    assert (fault is None) == (faults == []), f"formal grammar: {fault}; compiler: {faults}"


@pytest.mark.slow
@given(sentences)
def test_sentences_are_accepted_by_both(text: str) -> None:
    assert first_error(text) is None
    assert structural_faults(Source(text.encode())) == []


@given(nearly_sentences())
def test_what_is_nearly_a_sentence_is_judged_alike(text: str) -> None:
    agree(text)


@given(st.lists(pieces, max_size=8).map(" ".join))
def test_pieces_are_judged_alike(text: str) -> None:
    agree(text)


@given(nearly_sentences(), st.data())
def test_characters_taken_out_are_judged_alike(text: str, data: st.DataObject) -> None:
    """So that tokens meet without a blank between them."""
    at = data.draw(st.integers(0, len(text)))
    agree(text[:at] + text[at + data.draw(st.integers(1, 3)) :])


EXAMPLES = Path(__file__).parent.parent.parent / "examples"
TEXTS = [
    *(block.example for block in LANGUAGE.blocks.values()),
    *(text for entry in CATALOGUE.values() for text in (entry.wrong, entry.right) if len(text) < 1000),
    *((EXAMPLES / f"{name}.m3d").read_text(encoding="utf-8") for name in ("two-balls", "wheel")),
    "SOLID { SPHERE ball {\n",
]


@pytest.mark.slow
def test_every_prefix_is_judged_alike() -> None:
    """A text that breaks off anywhere, in a block or a word: what is no sentence is never accepted in silence."""
    for text in TEXTS:
        step = 1 + len(text) // 200
        for end in range(0, len(text) + 1, step):
            agree(text[:end])


@given(st.sampled_from(TEXTS), st.data())
def test_changed_texts_are_judged_alike(text: str, data: st.DataObject) -> None:
    """Real scenes with some tokens taken out, doubled or put in."""
    tokens = TOKEN.findall(text)
    at = data.draw(st.integers(0, max(len(tokens) - 60, 0)))
    tokens = tokens[at : at + 60]
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(tokens)))
        tokens[at : at + data.draw(st.integers(0, 2))] = data.draw(st.lists(pieces, max_size=2))
    agree(" ".join(tokens))


@pytest.mark.slow
def test_members_of_every_block() -> None:
    """Every keyword in every block, in every form: as a flag, with up to four arguments, as a block, as a table."""
    forms = ["", "1", "x", "< 1, 2, 3 >", "1, 2", "1, 2, 3, 4", "{ }", "x { }", "{ 1 2 3 < 1, 2, 3 > }", "= 1"]
    unlike = {block.members(): keyword for keyword, block in LANGUAGE.blocks.items()}
    for block in (*unlike.values(), "VARIABLES", None):
        for keyword in sorted(LANGUAGE.keywords):
            for form in forms:
                text = f"{keyword} {form}"
                place = block
                while place is not None:
                    text = f"{place} {{ {text} }}"
                    place = next(iter(LANGUAGE.parents.get(place, ())), None)
                agree(text)
