"""Comments, which nest: `/* one /* within */ another */`."""

from __future__ import annotations

import re

_MARK = re.compile(r"/\*|\*/")
_INK = re.compile(r"[^\n]")


def blank_comments(text: str) -> str:
    """The text with every comment made of spaces; lines and offsets stay. A comment that is not closed is left."""
    if "/*" not in text:
        return text
    parts: list[str] = []
    done = begin = depth = 0
    for mark in _MARK.finditer(text):
        if mark[0] == "/*":
            if depth == 0:
                begin = mark.start()
            depth += 1
        elif depth > 0:
            depth -= 1
            if depth == 0:
                parts += [text[done:begin], _INK.sub(" ", text[begin : mark.end()])]
                done = mark.end()
    return "".join([*parts, text[done:]])
