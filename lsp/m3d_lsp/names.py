"""The variables of a document: where each is declared, assigned to and used.

Where the text is broken, its tokens tell where a name stands: every name of the language is that of a variable.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from enum import Enum
from functools import lru_cache
from typing import NamedTuple

from m3d_language.table import LANGUAGE
from m3dc.analysis import Analysis
from m3dc.syntax import ast
from m3dc.syntax.recovery import lexer
from m3dc.text import long_tables

from .comments import comments
from .text import Span


class Role(Enum):
    """What a name is there for."""

    DECLARATION = "declaration"
    ASSIGNMENT = "assignment"
    USE = "use"


class Occurrence(NamedTuple):
    """A name in the text. Where it is a declaration, `type` is what it is declared as, and `type_span` where that
    stands."""

    name: str
    span: Span
    role: Role
    type: str = ""
    type_span: Span | None = None


class Names:
    """All names of a document, in the order of the text."""

    def __init__(self, analysis: Analysis) -> None:
        self.occurrences: list[Occurrence] = []
        for at in ast.walk(analysis.items, ast.Name):
            if (occurrence := _occurrence(at)) is not None:
                self.occurrences.append(occurrence)
        if analysis.tree.root_node.has_error or not analysis.items:
            known = {occurrence.span for occurrence in self.occurrences}
            known |= {o.type_span for o in self.occurrences if o.type_span is not None}
            self.occurrences += (o for o in _tokens(analysis) if o.span not in known)
            self.occurrences.sort(key=lambda occurrence: occurrence.span)
        self._by_name: dict[str, list[Occurrence]] = {}
        for occurrence in self.occurrences:
            self._by_name.setdefault(occurrence.name, []).append(occurrence)

    def at(self, offset: int) -> Occurrence | None:
        """The name that a byte belongs to, or that ends before it."""
        index = bisect_left(self.occurrences, offset, key=lambda occurrence: occurrence.span[1])
        found = self.occurrences[index] if index < len(self.occurrences) else None
        return found if found is not None and found.span[0] <= offset else None

    def of(self, name: str) -> list[Occurrence]:
        """Every occurrence of a name."""
        return self._by_name.get(name, [])

    def before(self, name: str, offset: int) -> Occurrence | None:
        """The last occurrence of a name before a byte."""
        places = self.of(name)
        index = bisect_left(places, offset, key=lambda occurrence: occurrence.span[0])
        return places[index - 1] if index else None

    def declaration(self, name: str) -> Occurrence | None:
        """Where a name is first declared."""
        return next((o for o in self.of(name) if o.role is Role.DECLARATION), None)

    def declared(self) -> dict[str, Occurrence]:
        """The first declaration of every variable."""
        found: dict[str, Occurrence] = {}
        for occurrence in self.occurrences:
            if occurrence.role is Role.DECLARATION:
                found.setdefault(occurrence.name, occurrence)
        return found

    def type(self, name: str) -> str | None:
        """The declared type of a variable."""
        declaration = self.declaration(name)
        return declaration.type if declaration is not None else None

    def last_assignment(self, name: str, offset: int) -> Occurrence | None:
        """The last assignment to a variable before a byte."""
        before = [o for o in self.of(name) if o.role is Role.ASSIGNMENT and o.span[0] < offset]
        return before[-1] if before else None


@lru_cache(maxsize=8)
def names(analysis: Analysis) -> Names:
    """The names of an analysed document."""
    return Names(analysis)


def _tokens(analysis: Analysis) -> Iterator[Occurrence]:
    """The names in a text, whatever stands about them."""
    data = analysis.source.data
    remarks = comments(analysis)
    for start, end in long_tables.outside(data):
        for word in lexer.words(data, start, end):
            if word.text not in LANGUAGE.keywords and remarks.at(word.span[0]) is None:
                yield Occurrence(word.text, word.span, Role.ASSIGNMENT if word.is_target else Role.USE)


def _occurrence(at: ast.Located) -> Occurrence | None:
    """What a name of the tree is there for; None of what stands where a type does."""
    name = at.node
    assert isinstance(name, ast.Name)
    match at.around[-1]:
        case ast.Declaration(type=type_):
            if name is type_:
                return None
            return Occurrence(name.text, at.span, Role.DECLARATION, type_.text, at.top.place(type_.span))
        case ast.Assignment(target=target) if name is target:
            return Occurrence(name.text, at.span, Role.ASSIGNMENT)
        case _:
            return Occurrence(name.text, at.span, Role.USE)
