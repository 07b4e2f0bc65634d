"""The fixes that the compiler knows: each where it stands, and at once all of the file that are certain."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3dc.diagnostics import all_certain

from .action import Action, Edit, Site


def find(site: Site) -> Iterator[Action]:
    """The fix of each diagnostic here."""
    for diagnostic in site.found:
        fix = diagnostic.fix
        if fix is not None:
            edit = fix.span.bytes, fix.text
            yield Action(fix.title, types.CodeActionKind.QuickFix, [edit], (diagnostic,), fix.certain)


def find_all(site: Site) -> Iterator[Action]:
    """All certain fixes of the file as one."""
    mended = all_certain(site.analysis.diagnostics)
    if mended:
        edits: list[Edit] = [(d.fix.span.bytes, d.fix.text) for d in mended if d.fix is not None]
        title = "Fix all that is certain"
        yield Action(title, types.CodeActionKind.SourceFixAll, edits, tuple(mended))
