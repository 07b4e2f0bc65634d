"""What a constant expression or a hexadecimal colour is worth, written as the language has it."""

from __future__ import annotations

import ast as python
import re

_CONSTANT = re.compile(rb"[0-9eE+\-*/.() \t]+")


def colour_of(text: str) -> str:
    """A hexadecimal colour as a vector: `#ff8000` as `< 1, 0.502, 0 >`."""
    digits = text[1:] if len(text) == 7 else "".join(2 * digit for digit in text[1:])
    parts = (int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4))
    return f"< {', '.join(f'{round(part, 3):g}' for part in parts)} >"


def calculated(text: bytes) -> str | None:
    """What an expression of numerals is worth, as a numeral; None for any other."""
    if not _CONSTANT.fullmatch(text) or len(text) > 100 or b"**" in text or b"//" in text:
        return None
    try:
        tree = python.parse(text.strip().decode(), mode="eval")
        value = _worth(tree.body)
    except (SyntaxError, ValueError, ZeroDivisionError, OverflowError, RecursionError):
        return None
    written = f"{value:.15g}"
    return written if (abs(value) < 1e300 and float(written) == value) or abs(value) < 1e6 else None


def _worth(node: object) -> float:
    match node:
        case python.Constant(value=int() | float() as value):
            return float(value)
        case python.UnaryOp(op=python.USub(), operand=operand):
            return -_worth(operand)
        case python.UnaryOp(op=python.UAdd(), operand=operand):
            return _worth(operand)
        case python.BinOp(left=left, op=python.Add(), right=right):
            return _worth(left) + _worth(right)
        case python.BinOp(left=left, op=python.Sub(), right=right):
            return _worth(left) - _worth(right)
        case python.BinOp(left=left, op=python.Mult(), right=right):
            return _worth(left) * _worth(right)
        case python.BinOp(left=left, op=python.Div(), right=right):
            return _worth(left) / _worth(right)
        case _:
            raise ValueError
