"""What is wrong with a table of numbers that does not fit its layout: its count is missing, there are marks between the
numbers, or some are left over."""

from __future__ import annotations

import re
from typing import NamedTuple

from m3d_language.comments import blank_comments
from m3d_language.table import Argument, Table

from ..diagnostics import Fix
from ..text.span import Span

_TOKEN = re.compile(r"[<>,]|[^\s<>,]+")
_COUNT = re.compile(r"\+?[0-9]+")
LONGEST = 100_000  # bytes: a longer table is not looked at as a whole


class TableFault(NamedTuple):
    """Where it is, what is wrong, and the fix; `uncounted`: the number of rows is missing."""

    span: Span
    detail: str
    fix: Fix[Span] | None = None
    uncounted: bool = False


def table_fault(entry: Table, data: bytes, start: int, end: int) -> TableFault | None:
    """What is wrong with the numbers of a table in a range of bytes; None where no more can be told than where they
    stop fitting."""
    if end - start > LONGEST:
        return None
    text = blank_comments(data[start:end].decode("latin-1"))
    tokens = [(match[0], start + match.start()) for match in _TOKEN.finditer(text)]
    if not tokens:
        return None
    return _marks(entry, tokens, text, start) or _count(entry, tokens) or _left_over(entry, tokens)


def _vectors(arguments: tuple[Argument, ...]) -> int:
    return sum(argument.shape == "vector" for argument in arguments)


def _marks(entry: Table, tokens: list[tuple[str, int]], text: str, start: int) -> TableFault | None:
    """Commas, and < > where there are no vectors."""
    wrong: list[int] = []
    within = False
    plain = _vectors(entry.row) == 0
    for mark, at in tokens:
        if mark in "<>":
            within = mark == "<"
            wrong += [at] if plain else []
        elif mark == "," and (plain or not within):
            wrong.append(at)
    if not wrong:
        return None
    blanked = list(text)
    for at in wrong:
        # `1,2` are two numbers.
        blanked[at - start] = (
            " " if blanked[at - start] == "," and text[at - start + 1 : at - start + 2].strip() else ""
        )
    first, last = wrong[0] - start, wrong[-1] - start + 1
    new = "".join(blanked[first:last])
    fix = (
        Fix("Remove the marks", (wrong[0], wrong[-1] + 1), new)
        if new.isascii() and text[first:last].isascii()
        else None
    )
    names = " ".join(_name(argument) for argument in entry.row)
    without = "no commas and no < > stand between them" if plain else "no commas stand between them"
    return TableFault((wrong[0], wrong[0] + 1), f"{entry.keyword} holds rows of {names}; {without}", fix)


def _count(entry: Table, tokens: list[tuple[str, int]]) -> TableFault | None:
    """The number of rows that should come first is not there."""
    if not entry.head:
        return None
    first, at = tokens[0]
    numbers, vectors = _amounts(tokens)
    width, wide = len(entry.row) - _vectors(entry.row), _vectors(entry.row)
    rows = vectors // wide if wide else numbers // width
    if not wide and _COUNT.fullmatch(first) and int(first) == rows:
        return None  # it is there, and something else is missing
    whole = rows > 0 and rows * width == numbers and rows * wide == vectors
    starts_row = first == "<" if not width else whole
    if not starts_row:
        return None
    names = " and of ".join(_name(argument) for argument in entry.head)
    if len(entry.head) > 1:
        return TableFault((at, at + 1), f"the numbers of {names} come first", uncounted=True)
    detail = f"the number of {names} comes first"
    fix = Fix(f"Insert {rows}", (at, at), f"{rows} ") if whole else None
    return TableFault((at, at + 1), f"{detail}: {rows}" if whole else detail, fix, uncounted=True)


def _left_over(entry: Table, tokens: list[tuple[str, int]]) -> TableFault | None:
    """Numbers that do not make a whole row, in a table of numbers alone."""
    if _vectors(entry.row) or _vectors(entry.head):
        return None
    head, width = len(entry.head), len(entry.row)
    numbers = len(tokens) - head
    left = numbers % width
    if numbers <= 0 or not left or any(mark in "<>," for mark, _ in tokens):
        return None
    at = tokens[-left][1]
    span = (at, tokens[-1][1] + len(tokens[-1][0]))
    what = {"FACETS": "a facet has 3 vertices", "PROFILE": "a point is an elevation and a temperature"}
    detail = what.get(entry.keyword, f"a row has {width} numbers")
    count = tokens[0][0]
    if entry.keyword == "FACETS" and _COUNT.fullmatch(count) and numbers == 4 * int(count):
        detail += ": one with 4 is written as two"
    over = ", ".join(token for token, _ in tokens[-left:])
    return TableFault(span, f"{detail}; {over} {'is' if left == 1 else 'are'} left over")


def _amounts(tokens: list[tuple[str, int]]) -> tuple[int, int]:
    """How many numbers stand outside of vectors, and how many vectors there are."""
    numbers = vectors = 0
    within = False
    for mark, _ in tokens:
        if mark in "<>":
            within = mark == "<"
            vectors += within
        elif mark != "," and not within:
            numbers += 1
    return numbers, vectors


def _name(argument: Argument) -> str:
    name = argument.name.replace("_", " ")
    return f"<{name}>" if argument.shape == "vector" else name


def layout_of(entry: Table) -> str:
    """What a table holds, in words."""
    head = " and of ".join(_name(argument) for argument in entry.head)
    row = " ".join(_name(argument) for argument in entry.row)
    counted = f"the number{'s' * (len(entry.head) > 1)} of {head} and then " if head else ""
    return f"{entry.keyword} holds {counted}rows of {row}"
