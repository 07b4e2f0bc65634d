"""Whatever a scene looks like, formatting keeps its tokens, its comments and its meaning, and twice is once."""

from __future__ import annotations

import re
from collections.abc import Iterable
from random import Random

import numpy as np
import pytest
from conftest import REPOSITORY
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.lark import from_lark
from tree_sitter import Language, Node, Parser

import m3d_language
import m3dc
from m3d_language.formal import parser
from m3d_language.table import LANGUAGE
from m3dc.format import Edit, FormatError, edits, format, format_range
from m3dc.format.diff import unified_diff
from m3dc.ir import TABLES

pytestmark = pytest.mark.slow

SPELLINGS: dict[str, st.SearchStrategy[str]] = {
    "IDENTIFIER": st.sampled_from(["x", "y", "the_ground", "e5", "a_name_of_more_than_thirty_two_characters"]),
    "NUMERAL": st.sampled_from(["0", "-1", "+2.50", "1e3", "4.8E-10", "3"]),
    "BLANK": st.just(" "),
    **{keyword: st.just(keyword) for keyword in LANGUAGE.keywords - set(LANGUAGE.reserved)},
}
sentences = from_lark(
    parser(), explicit={name: words.map(lambda word: f"{word} ") for name, words in SPELLINGS.items()}
)
TOKEN = re.compile(r"/\*.*?\*/|[^\s{}<>,;=]+|\S", re.DOTALL)
SPACES = ["", " ", " ", " ", "   ", "\t"]
BLANKS = ["\n", "\n", "\n  ", "\n    ", "\n\t", "\n\n", "\n \n\n", "  \n      ", "\r\n", "\f"]
COMMENTS = [
    "/* c */",
    "/**/",
    "/* { < */",
    "/* one /* in */ another */",
    "/* \n   two lines */",
    "/*\n\n  a drawing\nof four  \n\t\t*/",
    "/* \xe9 */",
    "/* " + "wide " * 18 + "*/",
]
SCENES = [
    text
    for path in sorted((REPOSITORY / "examples").glob("*.m3d"))
    if len(text := path.read_text(encoding="utf-8")) < 7000
]


def scattered(text: str, random: Random, commented: float, broken: float) -> bytes:
    """The tokens of a text with any blanks and comments between them."""
    parts: list[str] = []
    for token in [*TOKEN.findall(text), ""]:
        blank = random.choice(BLANKS if random.random() < broken else SPACES)
        while random.random() < commented:
            blank += random.choice(COMMENTS) + random.choice(BLANKS)
        if parts and not blank and parts[-1][-1:] not in "{}<>,;=" and token not in tuple("{}<>,;="):
            blank = " "
        parts += [blank, token]
    return "".join(part for part in parts).encode(random.choice(["utf-8", "latin-1"]))


texts = st.builds(
    scattered,
    st.one_of(sentences, st.sampled_from(SCENES)),
    st.randoms(use_true_random=False),
    st.sampled_from([0, 0.05, 0.3]),
    st.sampled_from([0.02, 0.1, 0.5]),
)


def leaves(data: bytes) -> list[bytes]:
    """The tokens and comments of a text, rows of tables token by token; the lines of comments without their indents."""
    found: list[bytes] = []

    def visit(node: Node) -> None:
        text = data[node.start_byte : node.end_byte]
        if node.child_count:
            for child in node.children:
                visit(child)
        elif node.type == "comment":
            found.append(re.sub(rb"\r*\n[ \t\r\f\v]*", b"\n", text))
        else:
            found.extend(re.split(rb"\s+", text))

    visit(Parser(Language(m3d_language.language())).parse(data).root_node)
    return found


def made(data: bytes, changes: Iterable[Edit]) -> bytes:
    """A text with edits made, which must be in order, apart, no larger than needed, and of white space alone."""
    parts: list[bytes] = []
    done = -1
    for edit in changes:
        old, new = data[slice(*edit.span)], edit.text.encode()
        assert not old.strip()
        assert not new.strip()
        assert done < edit.span[0]
        assert old[:1] != new[:1]
        assert old[-1:] != new[-1:]
        parts += [data[max(done, 0) : edit.span[0]], new]
        done = edit.span[1]
    return b"".join([*parts, data[max(done, 0) :]])


LINE = re.compile(rb"[^\n]*\n|[^\n]+")


def patched(data: bytes, difference: bytes) -> bytes:
    """What a unified diff makes of a text."""
    old = LINE.findall(data)
    new: list[bytes] = []
    at = 0
    for line in LINE.findall(difference.replace(b"\n\\ No newline at end of file", b""))[2:]:
        text = line[1:]
        if line.startswith(b"@@"):
            match = re.match(rb"@@ -(\d+)(,0)?", line)
            assert match
            start = int(match[1]) - (match[2] is None)
            new += old[at:start]
            at = start
        elif line.startswith(b"+"):
            new.append(text)
        else:
            assert line[:1] in b" -"
            assert old[at].rstrip(b"\n") == text.rstrip(b"\n")
            new += [text] if line.startswith(b" ") else []
            at += 1
    return b"".join(new + old[at:])


relaxed = settings(suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large], deadline=None)


@relaxed
@given(texts)
def test_twice_is_once_and_no_token_or_comment_is_lost(data: bytes) -> None:
    out = format(data)
    assert format(out) == out
    assert leaves(out) == leaves(data)


values = st.sampled_from(["0", "-1", "12.5", "+2.50", "1e3", "-4.8E-10", "x", "the_ground"])
rows = st.lists(st.tuples(values, values, values, st.sampled_from(["1", "2.25", "30"])), min_size=2, max_size=12)


@relaxed
@given(rows, st.sampled_from(["SOLID {{ {} }}", "SOLID {{\n{}\n}}"]))
def test_runs_of_one_line_blocks_are_in_columns(rows: list[tuple[str, str, str, str]], around: str) -> None:
    blocks = [f"SPHERE{{CENTER<{x},{y},{z}>RADIUS {r}}}" for x, y, z, r in rows]
    out = format(around.format("\n".join(blocks)).encode()).decode()
    assert format(out.encode()).decode() == out
    assert re.sub(r"\s", "", out) == re.sub(r"\s", "", around.format("".join(blocks)))
    lines = [line for line in out.splitlines() if line.strip().startswith("SPHERE {")]
    assert len(lines) in (0, len(rows))
    assert len({(line.index(">"), line.index("RADIUS"), len(line)) for line in lines}) <= 1


@relaxed
@given(texts)
def test_the_meaning_stays(data: bytes) -> None:
    out = format(data)
    first, second = m3dc.compile(data), m3dc.compile(out)
    assert [d.code for d in first.diagnostics] == [d.code for d in second.diagnostics]
    for table, columns in TABLES.items():
        for column in columns:
            if column not in ("span", "offset"):  # where in the text it is written
                np.testing.assert_array_equal(first.ir[table][column], second.ir[table][column])


@relaxed
@given(texts)
def test_edits_and_difference_make_the_same(data: bytes) -> None:
    out = format(data)
    assert made(data, edits(data)) == out
    assert made(data, format_range(data, 1, data.count(b"\n") + 1)) == out
    assert patched(data, b"".join(unified_diff(data, edits(data), "x"))) == out


@relaxed
@given(texts, st.integers(1, 30), st.integers(0, 5))
def test_a_range_keeps_tokens_and_comments(data: bytes, start: int, more: int) -> None:
    changes = format_range(data, start, start + more)
    assert set(changes) <= set(edits(data))
    assert leaves(made(data, changes)) == leaves(data)
    start = min(start, data.count(b"\n") + 1)  # a range after the end is at the end
    for edit in changes:
        assert data.count(b"\n", 0, edit.span[0]) < start + more
        assert data.count(b"\n", 0, edit.span[1]) >= start - 1


@relaxed
@given(texts, st.data())
def test_broken_text_is_laid_out_or_refused(data: bytes, draw: st.DataObject) -> None:
    at = draw.draw(st.integers(0, len(data)))
    data = data[:at] + draw.draw(st.sampled_from([b"", b"{", b"}", b"<", b"/*", b"*/", b"1.", b"\0"])) + data[at + 1 :]
    assert b"".join(made(data, format_range(data, 1, data.count(b"\n") + 1)).split()) == b"".join(data.split())
    try:
        out = format(data)
    except FormatError as error:
        start, end = error.span
        assert 0 <= start <= end <= len(data)
    else:
        assert format(out) == out
        assert leaves(out) == leaves(data)
