"""What a block is called: by the comment that stands with it, and by the variable that it copies.

SOLID /* a mirror */ ball { ... }       title "a mirror", variable "ball"
"""

from __future__ import annotations

import re
from typing import NamedTuple

from .comments import Comments
from .span import Span

_WORD = re.compile(rb"[A-Za-z_]\w*")
_BLANK = re.compile(rb"\s*")


class Caption(NamedTuple):
    """Either is empty where there is none."""

    title: str
    variable: str


def caption(data: bytes, span: Span) -> Caption:
    """The caption of the block at `span`, a range of bytes of a scene's text."""
    comments = Comments(data)
    at, variable = _after(_WORD, data, span[0]), ""
    while at < span[1]:
        at = _after(_BLANK, data, at)
        comment = comments.at(at)
        if comment is not None:
            at = comment[1]
            continue
        end = _after(_WORD, data, at)
        if variable or end == at:
            break
        variable, at = data[at:end].decode(), end
    return Caption(comments.title(span, min(at, span[1])) or "", variable)


def _after(pattern: re.Pattern[bytes], data: bytes, at: int) -> int:
    """Where what the pattern finds at a place ends; there if it finds nothing."""
    found = pattern.match(data, at)
    return found.end() if found else at
