"""Where a text's long tables of numbers are, so that nothing need look at every character of them but their reader.

The inside of such a table holds numerals, punctuation and white space alone: no comment can begin or end in it, no
byte of it is out of place, and the syntax tree is the same with or without it (a table is one token).
"""

from __future__ import annotations

from m3d_language import only_numbers

from .span import Span

LONG = 1 << 16
# What is left of a table at both ends, so that a token is there and words keep their neighbours.
KEPT = 256
_BLANK = b" \t\r\n"


def insides(data: bytes) -> list[Span]:
    """The insides of all long tables, in order: half-open ranges of bytes that begin and end at white space."""
    found: list[Span] = []
    brace = data.find(b"{") if len(data) > LONG else -1
    while brace >= 0:
        close = data.find(b"}", brace)
        if close < 0:
            break
        opened = data.rfind(b"{", brace, close) + 1
        if close - opened > LONG and only_numbers(data, opened, close):
            start = _next_blank(data, opened + KEPT, opened + LONG // 2)
            end = _last_blank(data, close - KEPT, close - LONG // 2)
            if start is not None and end is not None:
                found.append((start, end))
        brace = data.find(b"{", close)
    return found


def outside(data: bytes) -> list[Span]:
    """All of the text but the insides of its long tables."""
    edges = [0, *(edge for inside in insides(data) for edge in inside), len(data)]
    return list(zip(edges[::2], edges[1::2], strict=True))


def _next_blank(data: bytes, start: int, end: int) -> int | None:
    return next((i for i in range(start, end) if data[i] in _BLANK), None)


def _last_blank(data: bytes, start: int, end: int) -> int | None:
    return next((i for i in range(start, end, -1) if data[i - 1] in _BLANK), None)
