"""The numbers of a big table, read in one pass: millions of rows in a tenth of a second, without a syntax tree."""

from __future__ import annotations

from typing import Literal, NamedTuple, cast

from ._binding import only_numbers as _only_numbers
from ._binding import read_table as _read_table

Expected = Literal["number", "digit", "space", "<", ",", ">", "*/"]


class Stop(NamedTuple):
    """Where a table stops fitting its layout, as a byte offset, and what should have stood there.

    `digit` is one within a numeral; `space` is anything that ends one; `*/` is the end of the comment that begins
    there.
    """

    offset: int
    expected: Expected


class TableData(NamedTuple):
    """What was read of a table: the numbers of its head, and all whole rows before the place where it stops fitting.

    `rows` holds `width` doubles a row, `offsets` the byte offset at which each row begins, as 32 bits where they are
    enough. Neither is copied by `numpy.asarray(data.rows).reshape(-1, data.width)`.
    """

    head: tuple[float, ...]
    rows: memoryview[float]
    offsets: memoryview[int]
    width: int
    stop: Stop | None


def read_table(source: bytes | bytearray | memoryview, start: int, end: int, head: str, row: str) -> TableData:
    """Reads the numbers of `source[start:end]`: the head once, then rows.

    A layout has an `n` for each number and a `v` for each vector `< x, y, z >`: POLYGONS' SFACETS are `"n"` and
    `"nnnvvv"`. White space and nested comments may stand between any two tokens. Numbers are rounded correctly; one
    too large is infinite. Other threads run meanwhile.

    >>> read_table(b"2  0 1 2  2 1 0", 0, 15, "n", "nnn").rows.tolist()
    [0.0, 1.0, 2.0, 2.0, 1.0, 0.0]
    """
    values, rows, offsets, offset_size, at, expected = _read_table(source, start, end, head, row)
    return TableData(
        values,
        memoryview(rows).cast("d"),
        memoryview(offsets).cast("Q" if offset_size == 8 else "I"),
        len(row) + 2 * row.count("v"),
        None if expected is None else Stop(at, cast(Expected, expected)),
    )


def only_numbers(source: bytes | bytearray | memoryview, start: int, end: int) -> bool:
    """Whether every byte of `source[start:end]` is one of those that numerals, vectors and white space are made of.

    Gigabytes in a second, for it does not look at their order. Raises ValueError where the range is none.

    >>> only_numbers(b"< 1, 2.5e-3, +4 >", 0, 17), only_numbers(b"< 1, x, 3 >", 0, 11)
    (True, False)
    """
    return _only_numbers(source, start, end)
