"""Inlining a variable: its value in place of its name, here or everywhere."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3dc.syntax.parse import ast
from m3dc.text.span import Local

from ...names import Occurrence, Role, names
from ...text import Span
from .action import Action, Edit, Site
from .freshness import is_fresh, is_new
from .unused import places_of


def find(site: Site) -> Iterator[Action]:
    """For the variable here."""
    known = names(site.analysis)
    at = known.at(site.span[0])
    if at is None or site.span[1] > at.span[1]:
        return
    if at.role is Role.USE:
        edit = _inlined(site, at)
        if edit is not None:
            yield Action(f"Inline {at.name} here", types.CodeActionKind.RefactorInline, [edit])
    uses = [occurrence for occurrence in known.of(at.name) if occurrence.role is Role.USE]
    assigned = sum(occurrence.role is Role.ASSIGNMENT for occurrence in known.of(at.name))
    if assigned == 1 and uses:
        edits = [_inlined(site, use) for use in uses]
        whole = [edit for edit in edits if edit is not None]
        if len(whole) == len(edits):
            own: list[Edit] = [*whole, *((span, "") for span in places_of(site, at.name))]
            yield Action(f"Inline {at.name} everywhere", types.CodeActionKind.RefactorInline, own)


def _inlined(site: Site, use: Occurrence) -> Edit | None:
    """The edit that puts the value in place of a use; None where that would not be the same."""
    last = _assignment(site, use)
    place = Site(site.snapshot, use.span)
    if last is None or place.top is None or not place.is_sound or not site.at(last[0]).is_sound:
        return None
    start, assignment = last
    value, body = assignment.value, assignment.body
    first = value or body
    span = Local(0 if first is None else first.span.start, assignment.span.end).within(start)
    if any(_changes(site, other, span[1], place.top.start) for other in _names_in(site, span)):
        return None
    text = site.text(span)
    item = place.path[-1]
    match item:
        case ast.Block() if item.name is not None and place.real(item.name.span) == use.span:
            if value is None and not is_fresh(place, place.path):
                return None
            return _structure(place, use, text, body, item.body)
        case ast.Assignment():
            if body is None and item.body is None:
                return use.span, text
            if value is None and not is_new(place, item):
                return None
            return _structure(place, use, text, body, item.body)
        case ast.Statement() | ast.Table():
            return (use.span, text) if body is None else None
        case _:
            return None


def _structure(place: Site, use: Occurrence, text: str, body: ast.Body | None, more: ast.Body | None) -> Edit:
    """The value of a structure in place of its name; what changes the copy goes on in the same braces."""
    if body is None or more is None:
        return use.span, text
    opened = place.real(more.span)[0]
    return (use.span[0], opened + 1), text[:-1].rstrip()


def _assignment(site: Site, use: Occurrence) -> tuple[int, ast.Assignment] | None:
    """The assignment, and where its item begins, that alone makes a variable's value at its use."""
    before = [
        (top.start, top.item)
        for top in site.analysis.items
        if isinstance(top.item, ast.Assignment)
        and top.item.target.text == use.name
        and top.place(top.item.span)[1] <= use.span[0]
    ]
    if not before or (before[-1][1].value is None and len(before) > 1):
        return None
    start, last = before[-1]
    _, end = last.span.within(start)
    whole = last.body is None or site.data[end - 1 : end] == b"}"
    return before[-1] if whole and (last.value is not None or last.body is not None) else None


def _names_in(site: Site, span: Span) -> Iterator[str]:
    return (o.name for o in names(site.analysis).occurrences if span[0] <= o.span[0] < span[1])


def _changes(site: Site, name: str, start: int, end: int) -> bool:
    """Whether something is assigned to a variable in a range, or it is not declared before it."""
    known = names(site.analysis)
    return any(o.role is Role.ASSIGNMENT and start <= o.span[0] < end for o in known.of(name))
