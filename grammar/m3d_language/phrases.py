"""Phrases about statements, in Markdown: what one takes, its default, what is allowed. The reference pages and what an
editor shows are made of them."""

from __future__ import annotations

from collections.abc import Iterable

from .table import Argument, Bounds, Default, Statement, Table


def listed(words: Iterable[str]) -> str:
    """`a, b and c`."""
    *before, last = words
    return f"{', '.join(before)} and {last}" if before else last


def takes(arguments: Iterable[Argument], *, capital: bool = True) -> str:
    """What arguments are: `Takes a number `radius` in scene units`."""
    words = [
        f"{'an' if argument.shape == 'integer' else 'a'} {argument.shape} `{argument.name}`"
        + (f" in {argument.unit}" if argument.unit else "")
        for argument in arguments
    ]
    return f"{'Takes ' if capital else ''}{listed(words)}"


def written(value: Default) -> str:
    """A value as it is written in a scene: `0.5`, `< 1, 0, 0 >`, `0, 0, 199, 319`."""
    if isinstance(value, tuple):
        numbers = ", ".join(f"{number:g}" for number in value)
        return f"< {numbers} >" if len(value) == 3 else numbers
    return f"{value:g}"


def facts(statement: Statement) -> list[str]:
    """All there is to know of a statement's arguments, a sentence each."""
    found = [takes(statement.arguments)] if statement.arguments else []
    if statement.default is True:
        found.append("On by default")
    elif statement.default is not None and statement.default is not False:
        found.append(f"Default: `{written(statement.default)}`")
    bounds = [statement.bounds] if statement.bounds else [argument.bounds for argument in statement.arguments]
    found += dict.fromkeys(allowed(bound) for bound in bounds if bound)
    # What is often wanted of any argument of a kind need not be said of each.
    known = set(statement.arguments[0].often) if len(statement.arguments) == 1 else set[str]()
    if not set(statement.often) <= known:
        values = ", ".join(f"`{written(value)}` {label}" for label, value in statement.often.items())
        found.append(f"Often: {values}")
    return found


def table_facts(table: Table) -> list[str]:
    """All there is to know of what a table holds."""
    head = f"first {takes(table.head, capital=False)}; " if table.head else ""
    found = [f"Holds {head}rows of {takes(table.row, capital=False)}"]
    found += dict.fromkeys(
        f"`{argument.name}`: {allowed(argument.bounds, capital=False)}"
        for argument in (*table.head, *table.row)
        if argument.bounds
    )
    return found


def allowed(bounds: Bounds, *, capital: bool = True) -> str:
    """Which values are allowed, and what becomes of others."""
    outside = {
        "error": "anything else is an error",
        "default": "anything else is replaced by the default, with a warning",
        "limit": "anything else is replaced by the nearest of these, with a warning",
        "warn": "anything else is taken, with a warning",
    }[bounds.policy]
    return f"{'Allowed' if capital else 'allowed'}: {bounds.interval}; {outside}: *{bounds.message}*"
