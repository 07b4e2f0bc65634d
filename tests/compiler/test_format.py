"""The formatter: pairs of scenes before and after, the examples, the page of rules, and what must not change."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from conftest import REPOSITORY

from m3dc.format import Edit, FormatError, format, format_range

PAIRS = Path(__file__).parent / "format"
PAGE = REPOSITORY / "docs/formatting.md"
FENCES = re.findall(r"^```(before|after)\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("name", sorted(path.name.removesuffix(".in.m3d") for path in PAIRS.glob("*.in.m3d")))
def test_pair(name: str, rewrite: bool) -> None:
    out = format((PAIRS / f"{name}.in.m3d").read_bytes())
    expected = PAIRS / f"{name}.out.m3d"
    if rewrite:
        expected.write_bytes(out)
    assert out.decode() == expected.read_text(encoding="utf-8")
    assert format(out) == out


@pytest.mark.parametrize("path", sorted((REPOSITORY / "examples").glob("*.m3d")), ids=lambda path: path.stem)
def test_examples_are_laid_out(path: Path) -> None:
    assert format(path.read_bytes()) == path.read_bytes()


def test_the_page_has_pairs() -> None:
    assert len(FENCES) >= 10
    assert [kind for kind, _ in FENCES] == ["before", "after"] * (len(FENCES) // 2)


@pytest.mark.parametrize("number", range(0, len(FENCES), 2))
def test_example_of_the_page(number: int) -> None:
    (_, before), (_, after) = FENCES[number : number + 2]
    assert format(before.encode()).decode() == after
    assert format(after.encode()).decode() == after


# --- bytes ----------------------------------------------------------------------------------------------------------


def test_line_ends_are_those_of_the_first_line() -> None:
    assert format(b"x=1\r\n/* a\n   b */\r\ny=2\nSOLID { }") == (b"x = 1\r\n/* a\r\n   b */\r\ny = 2\r\nSOLID { }\r\n")
    assert format(b"x=1\n/* a\r\n   b */\r\ny=2\r\n") == b"x = 1\n/* a\n   b */\ny = 2\n"
    table = b"x = {\r\n  FACETS {\r\n    1\r\n  0 1 2\r\n\r\n\r\n  3 4 5 } }"
    assert format(table).replace(b"\r\n", b"\n") == format(table.replace(b"\r\n", b"\n"))
    assert b"\n" not in format(table).replace(b"\r\n", b"")


def test_bytes_that_are_not_utf_8_stay() -> None:
    assert format(b"/* caf\xe9 \xff\xfe */x=1") == b"/* caf\xe9 \xff\xfe */ x = 1\n"
    assert format("/* café */x=1".encode()) == "/* café */ x = 1\n".encode()


def test_a_byte_order_mark_stays_where_it_is() -> None:
    assert format(b"\xef\xbb\xbf\n\n x=1") == b"\xef\xbb\xbfx = 1\n"
    assert format(b"\xef\xbb\xbfx = 1\n") == b"\xef\xbb\xbfx = 1\n"


@pytest.mark.parametrize(("text", "out"), [(b"", b""), (b" \n\t\r\n", b""), (b"\n/* c */  ", b"/* c */\n")])
def test_texts_without_items(text: bytes, out: bytes) -> None:
    assert format(text) == out


def test_width_is_counted_in_characters() -> None:
    for character, stays in (("é", True), ("éé", False)):
        line = f"SOLID {{ PLANE {{ }} /* {character}{'x' * 73} */ }}\n"
        assert (format(line.encode()).decode() == line) == stays
        assert len(line) == 101 + (not stays)


# --- large tables ---------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("eol", ["\n", "\r\n"])
@pytest.mark.parametrize("untidy", ["", " ", "\t", "\f", "{eol}", "{eol}{eol} {eol}", " /* c */", " /* c{eol}d */ "])
def test_a_table_of_many_chunks_is_laid_out_like_a_small_one(eol: str, untidy: str) -> None:
    """A large table goes through in pieces, some of them at once; each row must come out as it would alone."""
    rows = [f"< {i}.5, -{i % 7}, 1 >{untidy.format(eol=eol) if i % 50_000 == 49_999 else ''}" for i in range(150_000)]
    text = eol.join(["x = {", "  VERTICES {", "  150000", *(f"  {row}" for row in rows), "  }", "}"])
    out = format(text.encode()).decode()
    assert format(out.encode()).decode() == out
    small = eol.join(["x = {", "  VERTICES {", "  150000", *(f"  {row}" for row in rows[99_990:100_010]), "  }", "}"])
    expected = format(small.encode()).decode().split(eol)
    assert eol.join(expected[5:-3]) in out
    assert out.count("<") == 150_000
    assert re.sub(r"\s+", " ", out) == re.sub(r"\s+", " ", text) + " "


# --- ranges ---------------------------------------------------------------------------------------------------------

RANGE = b"x=1\ny   = 2\n\n\n\nSOLID {\n  PLANE { } \n}\n"


def test_a_range_gives_the_smallest_edits_on_its_lines() -> None:
    assert format_range(RANGE, 1, 1) == [Edit((1, 1), " "), Edit((2, 2), " ")]
    assert format_range(RANGE, 2, 2) == [Edit((6, 8), "")]
    assert format_range(RANGE, 3, 5) == [Edit((13, 15), "")]
    assert format_range(RANGE, 6, 8) == [Edit((20, 21), "\n"), Edit((25, 25), "  "), Edit((34, 35), "")]
    assert format_range(RANGE, 7, 7) == [Edit((25, 25), "  "), Edit((34, 35), "")]


def test_the_whole_range_is_the_whole_format() -> None:
    text = RANGE
    for edit in reversed(format_range(RANGE, 1, 99)):
        text = text[: edit.span[0]] + edit.text.encode() + text[edit.span[1] :]
    assert text == format(RANGE)


def test_rows_of_a_large_table_are_edited_one_by_one() -> None:
    rows = "".join(f"< {i}, 0, 0 >\n" for i in range(100_000))
    text = f"x =\n{{\n    VERTICES\n    {{\n        100000\n{rows}    }}\n}}\n".encode()
    start = text.index(b"< 500, 0")
    assert format_range(text, 506, 506) == [Edit((start, start), " " * 8)]


def test_a_range_beyond_the_text() -> None:
    assert format_range(RANGE, 20, 30) == []
    assert format_range(b"", 1, 1) == []


# --- errors ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "place"),
    [
        (b"SOLID { SPHERE { RADIUS 2 }", 27),
        (b"SOLID { } }", 10),
        (b"x=1\n/* never closed", 4),
        (b"x=1 */", 4),
        (b"x=1\0", 3),
        (b"x =" + b" { TRANSFORM" * 41 + b" { }" + b" }" * 41, 486),
        (b"x =" + b" { TRANSFORM" * 5000 + b" { }" + b" }" * 5000, 486),
        (b"SCENE { VIEW { FROM < 1, 2 > } }", 27),
        (b"SOLID { " * 50 + b"} " * 50, None),
    ],
)
def test_text_with_syntax_errors_has_no_layout(text: bytes, place: int | None) -> None:
    with pytest.raises(FormatError) as caught:
        format(text)
    assert caught.value.message
    assert place is None or caught.value.span[0] == place


BROKEN = b"""\
  x=1 /* one */
SOLID{PLANE{}} SOLID { SPHERE{RADIUS < } }
/* stays */   y=2 /* two */
  /* between */
   VECTOR{ }
 SOLID { PLANE { }  }  /* stays */
"""


MENDED = b"""\
x = 1 /* one */
SOLID { PLANE { } } SOLID { SPHERE{RADIUS < } }
/* stays */   y = 2 /* two */
  /* between */
   VECTOR{ }
SOLID { PLANE { } }  /* stays */
"""


def test_items_beside_a_broken_one_are_laid_out() -> None:
    text = BROKEN
    for edit in reversed(format_range(BROKEN, 1, 99)):
        text = text[: edit.span[0]] + edit.text.encode() + text[edit.span[1] :]
    assert text == MENDED
    assert [edit.text for edit in format_range(BROKEN, 3, 5)] == [" ", " "]


def test_what_is_only_wrong_in_meaning_is_laid_out() -> None:
    assert format(b"SOLID{RADIUS -2 CENTER y}") == b"SOLID { RADIUS -2 CENTER y }\n"
    assert format(b"x=1e999 y=1.5.2") == b"x = 1e999\ny = 1.5.2\n"
