"""Declaring a variable that is used but not declared, with the type that its use asks for.

A number or vector is also given a value, the default of the statement that uses it: that of a variable alone, 0, is
often no value there.
"""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3d_language.table import LANGUAGE, Argument, Default
from m3dc import Diagnostic
from m3dc.diagnostics import catalogue
from m3dc.meaning.values import spelled
from m3dc.syntax.parse import ast

from ...entry import block_of, slot
from ...names import names
from ...text import Span
from .action import Action, Site
from .declaring import declared, new_before

MOST = 3  # types to choose from, where a use does not tell


def find(site: Site) -> Iterator[Action]:
    """For each undeclared name here."""
    for diagnostic in site.found:
        if diagnostic.code != catalogue.UNDEFINED_NAME.code:
            continue
        use = site.at(diagnostic.span.start)
        name = site.text(diagnostic.span.bytes)
        if use.top is None or names(site.analysis).declaration(name) is not None:
            continue
        for type_, value in list(_wanted(use, diagnostic))[:MOST]:
            edits = declared(site, name, type_, use.top.start)
            if edits is not None:
                if value:
                    edits.append(new_before(site, _first_use(site, name), f"{name} = {value}\n"))
                title = f"Declare the {type_} {name}" + (f", {value}" if value else "")
                yield Action(title, types.CodeActionKind.QuickFix, edits, (diagnostic,))


def _first_use(site: Site, name: str) -> int:
    """Where the top-level item begins that first uses a name."""
    use = names(site.analysis).of(name)[0].span[0]
    return next(top.start for top in reversed(site.analysis.items) if top.start <= use)


def _wanted(use: Site, diagnostic: Diagnostic) -> Iterator[tuple[str, str]]:
    """The types that the name at a place can have, likeliest first, each with a value to give it, or ''."""
    item = use.path[-1]
    at = diagnostic.span.bytes
    match item:
        case ast.Block() if item.name is not None and use.real(item.name.span) == at:
            if item.keyword.text in LANGUAGE.types:
                yield item.keyword.text, ""
        case ast.Assignment() if use.real(item.target.span) == at:
            yield from ((type_, "") for type_ in _types_of(use, item))
        case ast.Assignment() if isinstance(item.value, ast.Name):
            type_ = names(use.analysis).type(item.target.text)
            if type_ is not None:
                yield type_, _value(LANGUAGE.basics[type_].default) if type_ in LANGUAGE.basics else ""
        case ast.Statement() | ast.Table():
            yield from _argument(use, item, at)
        case _:
            if isinstance(item, ast.Assignment):
                yield "NUMBER", "0"


def _types_of(use: Site, item: ast.Assignment) -> Iterator[str]:
    """What a variable can be that is given this value."""
    match item.value:
        case ast.Number():
            yield "NUMBER"
        case ast.Vector():
            yield "VECTOR"
        case ast.Name():
            type_ = names(use.analysis).type(item.value.text)
            yield from [type_] if type_ else []
        case None:
            inside: tuple[ast.Item, ...] = item.body.items if item.body is not None else ()
            members = {member.keyword.text for member in inside if not isinstance(member, ast.Assignment)}
            for type_ in LANGUAGE.types:
                if type_ in LANGUAGE.blocks and members and members <= set(LANGUAGE.blocks[type_].members()):
                    yield type_


def _argument(use: Site, item: ast.Statement | ast.Table, at: Span) -> Iterator[tuple[str, str]]:
    """The shape and default of the argument that a name stands for."""
    arguments = item.arguments if isinstance(item, ast.Statement) else item.entries
    number = next((n for n, a in enumerate(arguments) if use.real(a.span)[0] <= at[0] < use.real(a.span)[1]), None)
    if number is None:
        return
    if isinstance(arguments[number], ast.Vector):
        yield "NUMBER", "0"
        return
    block = block_of(use.path[-2], use.analysis) if len(use.path) > 1 else None
    if block is None:
        return
    if isinstance(item, ast.Statement):
        member = block.statements.get(item.keyword.text)
        if member is None or number >= len(member.arguments):
            return
        default = member.default
        if isinstance(default, tuple) and len(member.arguments) > 1:
            default = default[number]
    else:
        member, default = block.tables.get(item.keyword.text), None
    found = None if member is None else slot(member, number, None)
    if found is not None:
        yield _of_shape(found.argument, default)


def _of_shape(expected: Argument, default: Default) -> tuple[str, str]:
    if expected.shape == "vector":
        return "VECTOR", _value(default if isinstance(default, tuple) else (0.0, 0.0, 0.0))
    return "NUMBER", _value(default if isinstance(default, (int, float)) else 0.0)


def _value(value: Default) -> str:
    return f"< {', '.join(map(spelled, value))} >" if isinstance(value, tuple) else spelled(value or 0.0)
