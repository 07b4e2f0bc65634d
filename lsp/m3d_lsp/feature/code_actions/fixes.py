"""The fixes that the compiler knows: one, or all that the file has."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3dc import Diagnostic

from .action import Action, Edit, Site


def find(site: Site) -> Iterator[Action]:
    """The fix of each diagnostic here."""
    for diagnostic in site.found:
        fix = diagnostic.fix
        if fix is not None:
            edit = fix.span, fix.text
            yield Action(fix.title, types.CodeActionKind.QuickFix, [edit], (diagnostic,), True)


def find_all(site: Site) -> Iterator[Action]:
    """All fixes of the file as one; of those that get in each other's way, the first."""
    mended = list(_apart(site.analysis.diagnostics))
    if mended:
        edits = [edit for _, edit in mended]
        title = "Fix all that can be fixed"
        yield Action(title, types.CodeActionKind.SourceFixAll, edits, tuple(d for d, _ in mended))


def _apart(diagnostics: tuple[Diagnostic, ...]) -> Iterator[tuple[Diagnostic, Edit]]:
    with_fix = [(d, (d.fix.span, d.fix.text)) for d in diagnostics if d.fix is not None]
    done = -1
    for diagnostic, edit in sorted(with_fix, key=lambda pair: pair[1][0]):
        if edit[0][0] > done:
            yield diagnostic, edit
            done = edit[0][1]
