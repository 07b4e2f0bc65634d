"""Comments, which nest: `/* one /* within */ another */`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any


def blank_comments(text: str) -> str:
    """The text with every comment made of spaces; lines and offsets stay. A comment that is not closed is left."""
    if "/*" not in text:
        return text
    parts: list[str] = []
    done = 0
    for begin, end in outermost(text):
        if end is not None:
            parts += [text[done:begin], re.sub(r"[^\n]", " ", text[begin:end])]
            done = end
    return "".join([*parts, text[done:]])


def outermost(text: str | bytes, ranges: Iterable[tuple[int, int]] | None = None) -> Iterator[tuple[int, int | None]]:
    """Where each comment of a text begins and ends that is not within another; one that is never closed has no end.
    With `ranges`, only the `/*` and `*/` in them count."""
    opening = b"/*" if isinstance(text, bytes) else "/*"
    marks: re.Pattern[Any] = re.compile(rb"/\*|\*/" if isinstance(text, bytes) else r"/\*|\*/")
    whole = [(0, len(text))]
    begin = depth = 0
    for mark in (m for start, end in (whole if ranges is None else ranges) for m in marks.finditer(text, start, end)):
        if mark[0] == opening:
            if depth == 0:
                begin = mark.start()
            depth += 1
        elif depth > 0:
            depth -= 1
            if depth == 0:
                yield begin, mark.end()
    if depth > 0:
        yield begin, None
