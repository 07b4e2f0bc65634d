"""Comments, which nest: `/* one /* within */ another */`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import AnyStr

# Compiled when they are first used: m3dc reads this file whenever it starts, and seldom blanks a comment.
_MARK = r"/\*|\*/"
_INK = r"[^\n]"


def blank_comments(text: str) -> str:
    """The text with every comment made of spaces; lines and offsets stay. A comment that is not closed is left."""
    if "/*" not in text:
        return text
    parts: list[str] = []
    done = 0
    for begin, end in outermost(re.finditer(_MARK, text)):
        if end is not None:
            parts += [text[done:begin], re.sub(_INK, " ", text[begin:end])]
            done = end
    return "".join([*parts, text[done:]])


def outermost(marks: Iterable[re.Match[AnyStr]]) -> Iterator[tuple[int, int | None]]:
    """Where each comment begins and ends that is not within another, of all `/*` and `*/` of a text in order; one that
    is never closed has no end."""
    begin = depth = 0
    for mark in marks:
        if mark[0][:1] in ("/", b"/"):
            if depth == 0:
                begin = mark.start()
            depth += 1
        elif depth > 0:
            depth -= 1
            if depth == 0:
                yield begin, mark.end()
    if depth > 0:
        yield begin, None
