"""Keeping a warning back: with a comment on its line, or with one for the whole file."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3dc.diagnostics.directives import ALLOW, heading_end

from ...comments import comments
from .action import Action, Edit, Site


def find(site: Site) -> Iterator[Action]:
    """For each code of a warning or hint here."""
    first = {d.code: d for d in reversed(site.found) if d.severity != "error"}
    for code, diagnostic in first.items():
        here, everywhere = _here(site, diagnostic.span.start, code), _everywhere(site, code)
        kind = types.CodeActionKind.QuickFix
        if here is not None:
            yield Action(f"Allow {code} here", kind, [here], (diagnostic,))
        yield Action(f"Allow {code} in this file", kind, [everywhere], (diagnostic,))


def _here(site: Site, offset: int, code: str) -> Edit | None:
    """A comment at the end of the line, or, where that is within one, on a line before; or the code put into one that
    is there. None where a comment would be taken to mean the whole file."""
    text = site.snapshot.text
    top = heading_end(site.data)
    line = text.line_of(offset)
    for match in ALLOW.finditer(site.data, max(text.line_start(max(line - 1, 0)), top), text.line_end(line)):
        if text.line_of(match.end()) in (line - 1, line):
            return (match.end(1), match.end(1)), f", {code}"
    end = text.line_end(line)
    if comments(site.analysis).at(end) is None:
        return (end, end), f" /* m3d: allow {code} */"
    start = text.line_start(line)
    if start <= top or comments(site.analysis).at(start) is not None:
        return None
    return (start, start), f"/* m3d: allow {code} */\n"


def _everywhere(site: Site, code: str) -> Edit:
    match = ALLOW.search(site.data, 0, heading_end(site.data))
    if match is not None:
        return (match.end(1), match.end(1)), f", {code}"
    return (0, 0), f"/* m3d: allow {code} */\n"
