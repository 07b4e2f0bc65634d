"""The variables of a document: where each is declared, assigned to and used, and what it is worth.

Where the text is broken, its tokens tell where a name stands: every name of the language is that of a variable.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_left
from collections.abc import Iterator
from enum import Enum
from functools import cached_property, lru_cache
from typing import NamedTuple

from m3d_language.table import LANGUAGE
from m3dc.analysis import Analysis
from m3dc.meaning import program
from m3dc.meaning.values import Value, Vector
from m3dc.syntax.parse import ast
from m3dc.text import long_tables

from .comments import comments
from .text import Span

# A numeral, or a name with what makes it the target of an assignment.
_TOKEN = re.compile(rb"[+-]?\.?[0-9](?:[eE][+-]|[A-Za-z0-9_.])*|([A-Za-z][A-Za-z0-9_]*)(\s*=)?")


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


class _Assigned(NamedTuple):
    """The value that a variable has after the assignment from `start` to `end`, and in its target."""

    start: int
    target_end: int
    end: int
    value: Value


class Names:
    """All names of a document, in the order of the text."""

    def __init__(self, analysis: Analysis) -> None:
        self._analysis = analysis
        self.occurrences: list[Occurrence] = []
        for top in analysis.items:
            for name, role, declared in _names_of(top.item):
                type_, type_span = ("", None) if declared is None else (declared.text, top.place(declared.span))
                self.occurrences.append(Occurrence(name.text, top.place(name.span), role, type_, type_span))
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

    def value(self, name: str, offset: int) -> Value | None:
        """What a variable is worth at a byte, in the statement that holds it: for the target of an assignment, what it
        is worth after it. None if it has not been assigned to, or not with what could be read."""
        for value in reversed(self._values.get(name, ())):
            if value.start <= offset and (offset >= value.end or offset <= value.target_end):
                return value.value
        return None

    def component(self, component: ast.Number | ast.Name, offset: int) -> float | None:
        """What a component of a vector is worth, in the statement at a byte; None where it is no number."""
        value = component.value if isinstance(component, ast.Number) else self.value(component.text, offset)
        return value if isinstance(value, (int, float)) and math.isfinite(value) else None

    def vector(self, vector: ast.Vector, offset: int) -> Vector | None:
        """What a vector is worth, in the statement at a byte; None where a component is not known."""
        x, y, z = (self.component(component, offset) for component in vector.components)
        return None if x is None or y is None or z is None else (x, y, z)

    @cached_property
    def _values(self) -> dict[str, list[_Assigned]]:
        """The values of each variable, in the order of the text."""
        found: dict[str, list[_Assigned]] = {}
        for item, made in zip(self._analysis.program, self._analysis.world.made, strict=True):
            content = item.content
            if isinstance(content, program.Assignment) and made.value is not None:
                _, end = content.span.within(item.start)
                _, target_end = content.target.span.within(item.start)
                found.setdefault(content.target.text, []).append(_Assigned(item.start, target_end, end, made.value))
        return found


@lru_cache(maxsize=8)
def names(analysis: Analysis) -> Names:
    """The names of an analysed document."""
    return Names(analysis)


def _tokens(analysis: Analysis) -> Iterator[Occurrence]:
    """The names in a text, whatever stands about them."""
    data = analysis.source.data
    remarks = comments(analysis)
    for start, end in long_tables.outside(data):
        for match in _TOKEN.finditer(data, start, end):
            if match[1] is None or remarks.at(match.start()) is not None:
                continue
            name = match[1].decode("ascii")
            if name not in LANGUAGE.keywords:
                yield Occurrence(name, match.span(1), Role.ASSIGNMENT if match[2] else Role.USE)


class _Named(NamedTuple):
    """A name of an item, what it is there for, and the type it is declared as."""

    name: ast.Name
    role: Role
    type: ast.Keyword | ast.Name | None = None


def _names_of(item: ast.Item) -> Iterator[_Named]:
    match item:
        case ast.Variables():
            for declaration in item.declarations:
                for name in declaration.names:
                    yield _Named(name, Role.DECLARATION, declaration.type)
        case ast.Assignment():
            yield _Named(item.target, Role.ASSIGNMENT)
            if item.value is not None:
                yield from _uses(item.value)
            yield from _body(item.body)
        case ast.Block():
            if item.name is not None:
                yield from _uses(item.name)
            yield from _body(item.body)
        case ast.Statement():
            for argument in item.arguments:
                yield from _uses(argument)
        case ast.Table():
            for entry in item.entries:
                yield from _uses(entry)


def _body(body: ast.Body | None) -> Iterator[_Named]:
    for item in body.items if body is not None else ():
        yield from _names_of(item)


def _uses(argument: ast.Argument) -> Iterator[_Named]:
    match argument:
        case ast.Name():
            yield _Named(argument, Role.USE)
        case ast.Vector():
            for component in argument.components:
                yield from _uses(component)
        case ast.Number():
            pass
