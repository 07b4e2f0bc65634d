"""Removing a variable that nothing uses: its declaration, and the assignments to it."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3dc.diagnostics import catalogue
from m3dc.syntax.parse import ast
from m3dc.text.cut import cut
from m3dc.text.span import Local

from ...names import Role, names
from ...text import Span
from .action import Action, Site


def find(site: Site) -> Iterator[Action]:
    """For each unused variable here."""
    for diagnostic in site.found:
        if diagnostic.code != catalogue.UNUSED_VARIABLE.code:
            continue
        name = site.text(diagnostic.span.bytes)
        if not any(o.role is Role.USE for o in names(site.analysis).of(name)):
            edits = [(span, "") for span in places_of(site, name)]
            title = f"Remove the unused variable {name}"
            yield Action(title, types.CodeActionKind.QuickFix, edits, (diagnostic,))


def places_of(site: Site, name: str) -> list[Span]:
    """What to cut out so that a variable is neither declared nor assigned to."""
    found: list[Span] = []
    for top in site.analysis.items:
        item = top.item
        if isinstance(item, ast.Assignment) and item.target.text == name:
            found.append(cut(site.data, *top.place(item.span)))
        elif isinstance(item, ast.Variables):
            places = [(d, n) for d in item.declarations for n, given in enumerate(d.names) if given.text == name]
            if len(places) == sum(len(d.names) for d in item.declarations):
                found.append(cut(site.data, *top.place(item.span)))
            else:
                found += [_name(site, top, declaration, number) for declaration, number in places]
    return found


def _name(site: Site, top: ast.TopLevel, declaration: ast.Declaration, number: int) -> Span:
    """One name of a declaration, with its comma; or the declaration."""
    given = declaration.names
    if len(given) == 1:
        return cut(site.data, *top.place(declaration.span))
    if number:
        return top.place(Local(given[number - 1].span.end, given[number].span.end))
    return top.place(Local(given[0].span.start, given[1].span.start))
