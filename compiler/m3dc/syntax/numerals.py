"""Numerals: what one is worth, what to say of a token that is none, and where they stand in a part of a text."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import NamedTuple

from m3d_language import blank_comments

from ..diagnostics import Fix, catalogue
from ..diagnostics.catalogue import Entry
from ..diagnostics.findings import At
from ..text.span import Span

_NUMBER = re.compile(rb"[+-]?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?")
_LEADING_POINT = re.compile(rb"^([+-]?)\.")
_BARE_POINT = re.compile(rb"(\.)(?![0-9])")
_GROUPS = re.compile(rb"[+-]?[0-9]{1,3}(_[0-9]{3})+(\.[0-9]+)?")
_C_SUFFIX = re.compile(rb"([+-]?[0-9]+\.[0-9]+)[fF]")
_UNIT = re.compile(rb"[+-]?[0-9]+(?:\.[0-9]+)?([A-Za-z]+)")

# What ends a value in a list of arguments or a table.
_ENDS = b" \t\r\n\f\v<>,{}"
_SCALAR = re.compile(rb"[^%s]+" % _ENDS)
_VALUE = re.compile(rb"<[^>]*>?|[^%s]+" % _ENDS)


def scalars(data: bytes, start: int, end: int) -> Iterator[Span]:
    """Where the numerals and names of a part of a text stand, those in vectors too, comments left out."""
    return _found(_SCALAR, data, start, end)


def values(data: bytes, start: int, end: int) -> Iterator[Span]:
    """Where the values of a part of a table stand: its vectors, and its numerals and names outside of them."""
    return _found(_VALUE, data, start, end)


def _found(pattern: re.Pattern[bytes], data: bytes, start: int, end: int) -> Iterator[Span]:
    if data.find(b"/*", start, end) < 0:
        return (match.span() for match in pattern.finditer(data, start, end))
    text = blank_comments(data[start:end].decode("latin-1")).encode("latin-1")
    return ((start + match.start(), start + match.end()) for match in pattern.finditer(text))


def around(data: bytes, offset: int, within: Span) -> Span:
    """The numeral or name that holds a byte or ends before it, as far as it is within a range; an empty one at the byte
    where there is none."""
    start = end = offset
    while start > within[0] and data[start - 1] not in _ENDS:
        start -= 1
    while end < within[1] and data[end] not in _ENDS:
        end += 1
    return start, end


def decimals(numeral: str) -> int | None:
    """How many digits stand behind the point of a numeral that is digits, a point and digits; None of any other."""
    whole, _, fraction = numeral.partition(".")
    return len(fraction) if whole.isdigit() and fraction.isdigit() else None


class Fault(NamedTuple):
    """Why a token is no number: from its byte `start` on. `mended` is what it certainly stands for, if there is such a
    numeral."""

    entry: Entry
    start: int
    detail: str
    mended: str | None = None

    def fix(self, span: At) -> Fix[At] | None:
        """What mends the token at `span`."""
        return None if self.mended is None else Fix(f"Write {self.mended}", span, self.mended, certain=True)


def read(text: bytes) -> tuple[float, Fault | None]:
    """The number that a token is; NaN, and what is wrong, where it is none."""
    match = _NUMBER.match(text)
    end = match.end() if match else 0
    if end < len(text):
        return math.nan, Fault(catalogue.EXPECTED_DIGIT, end, _fault(text, end), mend(text))
    value = float(text)
    if value in (float("inf"), float("-inf")):
        return math.nan, Fault(catalogue.NUMBER_TOO_LARGE, 0, "the largest number is about 1.8e308")
    return value, None


def mend(text: bytes) -> str | None:
    """The numeral that a token certainly stands for: with a 0 beside a bare point, without a `_` between thousands,
    without the `f` of C. None where there is none."""
    with_digits = _BARE_POINT.sub(rb"\g<1>0", _LEADING_POINT.sub(rb"\g<1>0.", text))
    if with_digits != text and _NUMBER.fullmatch(with_digits):
        return with_digits.decode()
    if _GROUPS.fullmatch(text):
        return text.replace(b"_", b"").decode()
    suffixed = _C_SUFFIX.fullmatch(text)
    return suffixed[1].decode() if suffixed else None


def _fault(text: bytes, end: int) -> str:
    """Why a token is no numeral: it stops being one at `end`."""
    shown = text.decode("ascii", "replace")
    rest = text[end : end + 1]
    if rest == b"." or end == 0:
        return f"a digit must stand on both sides of the point in {shown!r}"
    if rest in b"eE" and text[end + 1 :].strip(b"+-0123456789") == b"":
        return f"the exponent in {shown!r} has no digits"
    if text[:2].lower() == b"0x":
        return f"{shown!r} is not a number; numbers are decimal"
    unit = _UNIT.fullmatch(text)
    if unit and unit[1].decode() in UNITS:
        return f"{shown!r} is not a number; {UNITS_SAY}"
    return f"{shown!r} is not a number; a space must stand between a number and what follows it"


# What people write after a number that measures something.
UNITS = frozenset({"m", "cm", "mm", "km", "ft", "deg", "degrees", "degree", "rad", "radians", "px", "pixels", "K", "C"})
UNITS_SAY = "units are not written: lengths are in scene units, angles in degrees, temperatures in degrees Celsius"
