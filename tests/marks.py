"""Expected diagnostics written into a scene as comments under the text they are about.

    RADIUS -5
    /*     ^^ M3D0401 Sphere radius must be > 0 */

The carets stand under the place; a mark belongs to the nearest line above that holds no mark. A place that spans
several lines is marked to the end of its first line. What stands after the code is the headline.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from m3dc import Diagnostic, Source

MARK = re.compile(r"^(?P<lead>\s*/\*\s*)(?P<carets>\^+) (?P<code>M3D\d{4}) (?P<headline>.*?) \*/\s*$")


class Mark(NamedTuple):
    line: int
    column: int
    width: int
    code: str
    headline: str


def marks(text: str) -> list[Mark]:
    """The marks of a scene, in the order of their places."""
    found: list[Mark] = []
    line = 0
    for number, content in enumerate(text.split("\n"), 1):
        match = MARK.match(content)
        if match is None:
            line = number
            continue
        found.append(Mark(line, match.start("carets") + 1, len(match["carets"]), match["code"], match["headline"]))
    return sorted(found)


def mark(diagnostic: Diagnostic, source: Source) -> Mark:
    """The mark that a diagnostic calls for."""
    start, end = (source.position(offset) for offset in diagnostic.span.bytes)
    last = end.column if end.line == start.line else len(source.line(start.line)) + 1
    return Mark(start.line, start.column, max(last - start.column, 1), diagnostic.code, diagnostic.headline)


def without_marks(text: str) -> str:
    return "\n".join(line for line in text.split("\n") if not MARK.match(line))


def with_marks(text: str, wanted: list[Mark]) -> str:
    """The text with marks added; their lines are those of the text without any. A mark left of column 4 can not be
    written: indent the text."""
    lines: list[str] = []
    for number, content in enumerate(text.split("\n"), 1):
        lines.append(content)
        for m in sorted(m for m in wanted if m.line == number):
            if m.column < 4:
                raise ValueError(f"line {number}: no room for a mark at column {m.column}; indent the line")
            lines.append(f"/*{' ' * (m.column - 3)}{'^' * m.width} {m.code} {m.headline} */")
    return "\n".join(lines)
