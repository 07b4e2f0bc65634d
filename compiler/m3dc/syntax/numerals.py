"""Numerals: what one is worth, and what to say of a token that is none."""

from __future__ import annotations

import math
import re

from ..diagnostics import Findings, Fix, catalogue
from ..text.span import Span
from . import ast

_NUMBER = re.compile(rb"[+-]?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?")
_LEADING_POINT = re.compile(rb"^([+-]?)\.")
_BARE_POINT = re.compile(rb"(\.)(?![0-9])")
_GROUPS = re.compile(rb"[+-]?[0-9]{1,3}(_[0-9]{3})+(\.[0-9]+)?")
_C_SUFFIX = re.compile(rb"([+-]?[0-9]+\.[0-9]+)[fF]")
_UNIT = re.compile(rb"[+-]?[0-9]+(?:\.[0-9]+)?([A-Za-z]+)")


def read(text: bytes, span: Span, findings: Findings) -> ast.Number:
    """The number that a token is; NaN, and a finding, where it is none."""
    match = _NUMBER.match(text)
    end = match.end() if match else 0
    start, stop = span
    if end < len(text):
        mended = mend(text)
        fix = Fix(f"Write {mended}", span, mended, certain=True) if mended else None
        findings.add(catalogue.EXPECTED_DIGIT, (start + end, stop), _fault(text, end), fix=fix)
        return ast.Number(math.nan, span)
    value = float(text)
    if value in (float("inf"), float("-inf")):
        findings.add(catalogue.NUMBER_TOO_LARGE, span, "the largest number is about 1.8e308")
        value = math.nan
    return ast.Number(value, span)


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
