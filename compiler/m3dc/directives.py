"""Directives in comments: `/* m3d: allow CODE, CODE */` keeps warnings back.

Before the first item of a file it holds for the whole file; elsewhere for its own line and the next. Errors can not be
kept back.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from .diagnostics import Diagnostic
from .source import Source

ALLOW = re.compile(rb"/\*\s*m3d:\s*allow\s+([A-Z0-9,\s]+?)\s*\*/")
_COMMENT = re.compile(rb"\s*/\*(?:(?!/\*|\*/).)*\*/", re.DOTALL)


def without_allowed(diagnostics: list[Diagnostic], source: Source) -> Iterable[Diagnostic]:
    """The diagnostics but for those that the text allows."""
    if all(diagnostic.severity == "error" for diagnostic in diagnostics) or b"m3d:" not in source.data:
        return diagnostics
    top = heading_end(source.data)
    everywhere: set[str] = set()
    by_line: dict[int, set[str]] = {}
    for match in ALLOW.finditer(source.data):
        codes = set(match[1].decode().replace(",", " ").split())
        if match.end() <= top:
            everywhere |= codes
        else:
            line = source.position(match.end()).line
            for covered in (line, line + 1):
                by_line.setdefault(covered, set()).update(codes)

    def allowed(diagnostic: Diagnostic) -> bool:
        line = source.position(diagnostic.span[0]).line
        return diagnostic.severity != "error" and diagnostic.code in everywhere | by_line.get(line, set())

    return (diagnostic for diagnostic in diagnostics if not allowed(diagnostic))


def heading_end(data: bytes) -> int:
    """Where the comments at the beginning of the file end."""
    end = 0
    while match := _COMMENT.match(data, end):
        end = match.end()
    return end
