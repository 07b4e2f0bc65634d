"""Values that are assigned to a variable and never used: overwritten first, or assigned after the last use.

A block assigned to a structure changes the members that it names, and so takes nothing away: only a number, a vector or
a copy of another variable replaces what was there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ..diagnostics import Findings, catalogue
from ..syntax import ast
from ..text.span import Span
from . import program


class Usage(NamedTuple):
    """What an item does with variables: the names that it uses; and, of an assignment, the variable that is given a
    value, whether nothing of the value before is left, and where it stands."""

    uses: frozenset[str]
    target: str | None = None
    replaces: bool = False
    span: Span = (0, 0)


def usage(content: program.Content) -> Usage:
    """What an item does with variables."""
    match content:
        case program.Assignment():
            value = () if content.value is None else (content.value,)
            uses = frozenset((*_names(value), *_used(content.body or ())))
            return Usage(uses, content.target.text, content.value is not None, content.span)
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


class _Pending(NamedTuple):
    base: int
    span: Span


def report_unused_values(items: Iterable[tuple[int, Usage]], findings: Findings) -> None:
    """Report the assignments whose value nothing uses, given the base and the usage of each item in the order of the
    file. Of a variable that is never used nothing is said: that is another diagnostic."""
    pending: dict[str, list[_Pending]] = {}
    lost: list[tuple[str, _Pending, str]] = []
    used: set[str] = set()
    for base, item in items:
        used |= item.uses
        for name in item.uses:
            pending.pop(name, None)
        if item.target is not None:
            before = pending.setdefault(item.target, [])
            if item.replaces:
                detail = f"{item.target} is assigned to again before anything uses it"
                lost += [(item.target, each, detail) for each in before]
                before.clear()
            before.append(_Pending(base, item.span))
    for name, left in pending.items():
        lost += [(name, each, f"nothing uses {name} after this") for each in left]
    for name, (base, span), detail in lost:
        if name in used:
            findings.base = base
            findings.add(catalogue.UNUSED_VALUE, span, detail)
    findings.base = 0
