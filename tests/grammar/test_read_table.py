"""The reader of big tables, against Python's own float and a slow reader of the same layouts."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from m3d_language import Stop, TableData, only_numbers, read_table

LAYOUTS = [("n", "nnn"), ("n", "nnnvvv"), ("", "nn"), ("", "nnvv"), ("nn", "v"), ("n", "v"), ("v", "n")]

digits = st.text("0123456789", min_size=1, max_size=25)
numerals = st.builds(
    "".join,
    st.tuples(
        st.sampled_from(["", "+", "-"]),
        digits,
        st.one_of(st.just(""), digits.map(lambda text: f".{text}")),
        st.one_of(
            st.just(""), st.builds("{}{}{}".format, st.sampled_from("eE"), st.sampled_from(["", "+", "-"]), digits)
        ),
    ),
)
blanks = st.sampled_from([" ", "\n", "\t ", "\r\n", " /* 1 */ ", "/* a /* b */ < */"])


def read(text: str | bytes, head: str, row: str) -> TableData:
    data = text if isinstance(text, bytes) else text.encode()
    return read_table(data, 0, len(data), head, row)


def tokens(layout: str) -> Iterator[str]:
    for item in layout:
        yield from "n" if item == "n" else "<n,n,n>"


def slow_read(text: str, head: str, row: str) -> tuple[list[float], list[float], list[int], Stop | None]:
    """What read_table should give, token by token."""
    blank = re.compile(r"[ \t-\r]*")
    numeral = re.compile(r"[+-]?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?(?![A-Za-z0-9_.])")
    heads: list[float] = []
    rows: list[float] = []
    offsets: list[int] = []
    at = 0

    def after_blank(at: int) -> int:
        found = blank.match(text, at)
        assert found is not None
        return found.end()

    def read_layout(layout: str) -> tuple[list[float], bool]:
        nonlocal at
        values: list[float] = []
        for token in tokens(layout):
            at = after_blank(at)
            match = numeral.match(text, at) if token == "n" else re.compile(re.escape(token)).match(text, at)
            if not match:
                return values, False
            if token == "n":
                values.append(float(match[0]))
            at = match.end()
        return values, True

    heads, whole = read_layout(head)
    while whole:
        start = at = after_blank(at)
        if at == len(text):
            return heads, rows, offsets, None
        values, whole = read_layout(row)
        if whole:
            rows += values
            offsets.append(start)
    return heads, rows, offsets, Stop(at, "number")


@given(numerals)
@example("0.1")
@example("9007199254740993")
@example("179769313486231580793728971405301e276")
@example("1e400")
@example("-1e-400")
@example("4.9406564584124654e-324")
@example("2.2250738585072011e-308")
@example("0." + "0" * 400 + "1")
@example("1" + "0" * 1000)
@example("123456789012345678901234567890.123456789")
def test_numbers_are_those_that_python_reads(numeral: str) -> None:
    data = read(numeral, "", "n")
    assert data.stop is None
    assert struct.pack("d", data.rows[0]) == struct.pack("d", float(numeral))


@given(st.sampled_from(LAYOUTS), st.data())
def test_rows_of_every_layout(layout: tuple[str, str], data: st.DataObject) -> None:
    head, row = layout
    text = data.draw(blanks)
    values: list[list[float]] = []
    offsets: list[int] = []
    for index in range(data.draw(st.integers(0, 4)) + 1):
        values.append([])
        part = head if index == 0 else row
        if index:
            offsets.append(len(text))
        for token in tokens(part):
            numeral = data.draw(numerals) if token == "n" else token
            if token == "n":
                values[-1].append(float(numeral))
            text += numeral + data.draw(blanks)
    found = read(text, head, row)
    assert found.stop is None
    assert list(found.head) == values[0]
    assert np.asarray(found.rows).reshape(-1, found.width).tolist() == values[1:]
    assert found.offsets.tolist() == offsets


@given(st.sampled_from(LAYOUTS), st.text("0123 .,<>eE+-x\n", max_size=60))
def test_it_keeps_what_fits_and_stops_where_it_does_not(layout: tuple[str, str], text: str) -> None:
    head, row = layout
    heads, rows, offsets, stop = slow_read(text, head, row)
    found = read(text, head, row)
    assert (found.stop is None) == (stop is None)
    assert found.rows.tolist() == rows
    assert found.offsets.tolist() == offsets
    if found.stop is None:
        assert list(found.head) == heads
    else:
        # The slow reader stops at the beginning of a numeral, this one at the character in it that is wrong.
        assert stop is not None
        assert stop.offset <= found.stop.offset <= len(text)
        assert re.fullmatch(r"[+-]?[0-9.eE+-]*", text[stop.offset : found.stop.offset])


@pytest.mark.parametrize(
    ("text", "head", "row", "offset", "expected"),
    [
        ("1 2 x", "", "n", 4, "number"),
        ("1 2", "", "nnn", 3, "number"),
        ("", "n", "nnn", 0, "number"),
        ("3 <0,0,0> 1", "n", "v", 10, "<"),
        ("<0 0,0>", "", "v", 3, ","),
        ("<0,0,0,0>", "", "v", 6, ">"),
        ("<0,0,", "", "v", 5, "number"),
        ("1. 2", "", "n", 2, "digit"),
        ("1.5e+ 2", "", "n", 5, "digit"),
        ("- 2", "", "n", 1, "digit"),
        (".5", "", "n", 0, "number"),
        ("12a", "", "n", 2, "space"),
        ("1.2.3", "", "n", 3, "space"),
        ("1_000", "", "n", 1, "space"),
        ("1 /* 2", "", "n", 2, "*/"),
        ("1 */ 2", "", "n", 2, "number"),
        ("1 / 2", "", "n", 2, "number"),
        ("1 \xff", "", "n", 2, "number"),
        ("1 \0", "", "n", 2, "number"),
    ],
)
def test_the_place_and_what_was_expected(text: str, head: str, row: str, offset: int, expected: str) -> None:
    assert read(text.encode("latin-1"), head, row).stop == (offset, expected)


def test_rows_before_the_fault_are_kept() -> None:
    found = read("2  1 2 3  4 5 6  7 8", "n", "nnn")
    assert found.head == (2.0,)
    assert found.rows.tolist() == [1, 2, 3, 4, 5, 6]
    assert found.stop == (20, "number")


def test_only_the_stretch_that_is_asked_for_is_read() -> None:
    text = b"FACETS { 1 2 3 } x"
    found = read_table(text, 8, 14, "", "n")
    assert found.rows.tolist() == [1, 2, 3]
    assert found.offsets.tolist() == [9, 11, 13]
    assert read_table(memoryview(text), 9, 10, "", "n").rows.tolist() == [1]


def test_many_rows_need_room_again_and_again() -> None:
    count = 1 << 18
    found = read("7 " * count, "", "n")
    assert np.all(np.asarray(found.rows) == 7)
    assert np.array_equal(np.asarray(found.offsets), np.arange(0, 2 * count, 2, dtype=np.uint32))


def test_numpy_sees_it_without_a_copy() -> None:
    found = read("1 2 3 4", "", "nn")
    rows = np.asarray(found.rows).reshape(-1, found.width)
    assert rows.dtype == np.float64
    assert np.shares_memory(rows, np.asarray(found.rows))
    assert np.asarray(found.offsets).dtype == np.uint32


@pytest.mark.parametrize(("head", "row"), [("", ""), ("x", "n"), ("", "nq"), ("n" * 33, "n")])
def test_a_layout_must_be_one(head: str, row: str) -> None:
    with pytest.raises(ValueError, match="layout"):
        read("1", head, row)


@pytest.mark.parametrize(("start", "end"), [(-1, 1), (2, 1), (0, 4)])
def test_a_stretch_must_be_in_the_source(start: int, end: int) -> None:
    with pytest.raises(ValueError, match="source"):
        read_table(b"123", start, end, "", "n")


def test_deeply_nested_comments() -> None:
    assert read("/*" * 100_000 + "*/" * 100_000 + "5", "", "n").rows.tolist() == [5]


def test_the_locale_does_not_matter() -> None:
    import locale

    before = locale.setlocale(locale.LC_NUMERIC)
    for name in ("de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"):
        try:
            locale.setlocale(locale.LC_NUMERIC, name)
        except locale.Error:
            continue
        break
    try:
        assert read("0.123456789012345678901", "", "n").rows[0] == 0.123456789012345678901
    finally:
        locale.setlocale(locale.LC_NUMERIC, before)


@pytest.mark.parametrize("before", [0, 1, 255, 256, 257])
def test_each_byte_is_of_numbers_or_not_wherever_it_stands(before: int) -> None:
    allowed = b"0123456789.+-eE<>, \t\r\n\v\f"
    for byte in range(256):
        text = b"1" * before + bytes([byte]) + b"2" * 300
        assert only_numbers(text, 0, len(text)) == (byte in allowed), chr(byte)
        assert only_numbers(text, before + 1, len(text))
        assert only_numbers(text, 0, before)


@pytest.mark.parametrize(("start", "end"), [(-1, 2), (2, 1), (0, 4)])
def test_a_range_that_is_none_is_refused(start: int, end: int) -> None:
    with pytest.raises(ValueError, match="within the source"):
        only_numbers(b"123", start, end)
