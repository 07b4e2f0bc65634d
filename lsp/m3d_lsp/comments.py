"""The comments of a document: where they are, and which of them tells what a thing is."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from m3dc.analysis import Analysis
from m3dc.syntax.parse import ast
from m3dc.text.comments import Comments, text_of

from .text import Span

__all__ = ["Comments", "about_variable", "comments"]


@lru_cache(maxsize=8)
def comments(analysis: Analysis) -> Comments:
    """The comments of an analysed document."""
    return Comments(analysis.source.data)


def about_variable(analysis: Analysis, name: str, assignment: Span | None = None) -> list[str]:
    """What comments say of a variable: those with its declaration, and those with the assignment whose target stands at
    a place. Each is a text of one line; none is there twice."""
    found = [*_at_declaration(analysis, name), *_at_assignment(analysis, assignment)]
    data = analysis.source.data
    texts = (" ".join(text_of(data[start:end].decode("utf-8", "replace"))) for start, end in found)
    return list(dict.fromkeys(text for text in texts if text))


def _at_declaration(analysis: Analysis, name: str) -> list[Span]:
    """The comment right behind the name, or else behind the line of its declaration, or else above that."""
    places = _declarations(analysis).get(name)
    if places is None:
        return []
    own, (start, end) = places
    remarks = comments(analysis)
    behind = remarks.behind(own[1], b",;")
    if behind is None and b"\n" not in analysis.source.data[start:end]:
        behind = remarks.behind(end)
    return [behind] if behind is not None else _above(analysis, start)


def _at_assignment(analysis: Analysis, target: Span | None) -> Iterator[Span]:
    """The comments right above an assignment, and the one behind it."""
    place = _assignments(analysis).get(target) if target is not None else None
    if place is not None:
        remarks = comments(analysis)
        yield from _above(analysis, place[0])
        behind = remarks.behind(place[1])
        if behind is not None:
            yield behind


def _above(analysis: Analysis, start: int) -> list[Span]:
    """The comments right before something, unless something else stands before them on their line."""
    remarks, data = comments(analysis), analysis.source.data
    first = remarks.before(start)
    shared = data[data.rfind(b"\n", 0, first) + 1 : first].strip()
    return [] if shared else list(remarks.within((first, start)))


@lru_cache(maxsize=2)
def _declarations(analysis: Analysis) -> dict[str, tuple[Span, Span]]:
    """Where each variable's name is first declared, and in which declaration."""
    found: dict[str, tuple[Span, Span]] = {}
    for top in analysis.items:
        for declaration in top.item.declarations if isinstance(top.item, ast.Variables) else ():
            for name in declaration.names:
                found.setdefault(name.text, (top.place(name.span), top.place(declaration.span)))
    return found


@lru_cache(maxsize=2)
def _assignments(analysis: Analysis) -> dict[Span, Span]:
    """Where each assignment is, by the place of its target."""
    assigned = ((top, top.item) for top in analysis.items if isinstance(top.item, ast.Assignment))
    return {top.place(item.target.span): top.place(item.span) for top, item in assigned}
