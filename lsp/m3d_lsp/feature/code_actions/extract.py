"""Extracting a block, a number or a vector to a variable of its own, which is declared and assigned to before it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsprotocol import types

from m3d_language.table import LANGUAGE
from m3dc.syntax.parse import ast
from m3dc.text.span import Local

from .action import Action, Edit, Site
from .declaring import declared, new_before, unused_name
from .freshness import is_fresh


def find(site: Site) -> Iterator[Action]:
    """For the block whose keyword is here, or that is selected, and for the number or vector here."""
    item = site.path[-1] if site.path and site.is_sound else None
    match item:
        case ast.Block() if item.body is not None and item.keyword.text in LANGUAGE.types and _is_meant(site, item):
            yield from _block(site, item)
        case ast.Statement():
            argument = next((a for a in item.arguments if _touches(site.real(a.span), site.span)), None)
            if isinstance(argument, (ast.Number, ast.Vector)):
                yield from _value(site, item, argument)
        case _:
            pass


def _is_meant(site: Site, item: ast.Block) -> bool:
    return site.span == site.real(item.span) or _touches(site.real(item.keyword.span), site.span)


def _touches(span: tuple[int, int], place: tuple[int, int]) -> bool:
    return span[0] <= place[0] and place[1] <= span[1]


def _block(site: Site, item: ast.Block) -> Iterator[Action]:
    keyword = item.keyword.text
    if item.name is None and not is_fresh(site, site.path):
        return
    name = unused_name(site, keyword.lower())
    start, end = site.real(Local(item.keyword.span.end, item.span.end))
    value = _moved(site, start, end)
    yield from _extracted(site, name, keyword, (start, end), f" {name}", f"{name} ={value}")


def _moved(site: Site, start: int, end: int) -> str:
    """A part of the text as it stands at top level, its lines indented as much less as the line on which it begins."""
    line = site.data[site.data.rfind(b"\n", 0, start) + 1 : start].decode("utf-8", "replace")
    margin = line[: len(line) - len(line.lstrip())]
    text = re.sub(rf"\n{re.escape(margin)}", "\n", site.text((start, end)))
    return text if text[:1].isspace() else f" {text}"


def _value(site: Site, item: ast.Statement, argument: ast.Number | ast.Vector) -> Iterator[Action]:
    type_ = "VECTOR" if isinstance(argument, ast.Vector) else "NUMBER"
    name = unused_name(site, item.keyword.text.lower())
    span = site.real(argument.span)
    yield from _extracted(site, name, type_, span, name, f"{name} = {site.text(span)}")


def _extracted(site: Site, name: str, type_: str, span: tuple[int, int], use: str, assignment: str) -> Iterator[Action]:
    assert site.top is not None
    edits = declared(site, name, type_, site.top.start)
    if edits is not None:
        own: list[Edit] = [*edits, new_before(site, site.top.start, f"{assignment}\n"), (span, use)]
        yield Action(f"Extract to the {type_} {name}", types.CodeActionKind.RefactorExtract, own)
