"""Values that are assigned to a variable and never used: overwritten first, or assigned after the last use.

A block assigned to a structure changes the members that it names, and so takes nothing away: only a number, a vector or
a copy of another variable replaces what was there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ..diagnostics import Findings, catalogue
from ..syntax import ast
from ..text.span import Base, Local, Placed
from . import program


class Given(NamedTuple):
    """The variable that an assignment gives a value, whether nothing of the value before is left, and where it
    stands."""

    target: str
    replaces: bool
    span: Local


class Usage(NamedTuple):
    """What an item does with variables: the names that it uses; and what it gives one, if it is an assignment."""

    uses: frozenset[str]
    gives: Given | None = None


def usage(content: program.Content) -> Usage:
    """What an item does with variables."""
    match content:
        case program.Assignment():
            value = () if content.value is None else (content.value,)
            uses = frozenset((*_names(value), *_used(content.body or ())))
            return Usage(uses, Given(content.target.text, content.value is not None, content.span))
        case program.Block():
            return Usage(frozenset(_used((content,))))
        case _:
            return Usage(frozenset())


def _used(members: Iterable[program.Member]) -> Iterator[str]:
    for member in members:
        match member:
            case program.Statement():
                yield from _names(member.arguments)
            case program.Table():
                yield from _names(member.head)
                for row in member.rows:
                    yield from _names(row)
            case program.Block():
                if member.source is not None:
                    yield member.source.text
                yield from _used(member.body)


def _names(arguments: Iterable[ast.Argument]) -> Iterator[str]:
    for argument in arguments:
        match argument:
            case ast.Name():
                yield argument.text
            case ast.Vector():
                yield from _names(argument.components)
            case ast.Number():
                pass


def report_unused_values(items: Iterable[tuple[Base, Usage]], findings: Findings) -> None:
    """Report the assignments whose value nothing uses, given the base and the usage of each item in the order of the
    file. Of a variable that is never used nothing is said: that is another diagnostic."""
    pending: dict[str, list[Placed]] = {}
    lost: list[tuple[str, Placed, str]] = []
    used: set[str] = set()
    for base, item in items:
        used |= item.uses
        for name in item.uses:
            pending.pop(name, None)
        if item.gives is not None:
            target, replaces, span = item.gives
            before = pending.setdefault(target, [])
            if replaces:
                detail = f"{target} is assigned to again before anything uses it"
                lost += [(target, place, detail) for place in before]
                before.clear()
            before.append(span.at(base))
    for name, left in pending.items():
        lost += [(name, place, f"nothing uses {name} after this") for place in left]
    for name, place, detail in lost:
        if name in used:
            findings.add_at(catalogue.UNUSED_VALUE, place, detail)
