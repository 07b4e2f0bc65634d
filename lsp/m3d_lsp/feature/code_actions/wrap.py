"""Putting what stands at the top level, but may not, into the block that it belongs in: a SPHERE into a SOLID."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3d_language.table import LANGUAGE
from m3dc.diagnostics import catalogue
from m3dc.syntax.parse import ast

from .action import Action, Edit, Site

INDENT = "    "


def find(site: Site) -> Iterator[Action]:
    """For the misplaced thing here, with those that follow or precede it and belong into the same block."""
    top = site.top
    parent = None if top is None else _parent(top.item)
    mended = [d for d in site.analysis.diagnostics if d.code == catalogue.INVALID_AT_TOP.code]
    if top is None or parent is None or not any(d in site.found for d in mended) or _is_taken(site, parent):
        return
    items = site.analysis.items
    first = last = items.index(top)
    while first > 0 and _belongs(items[first - 1].item, parent):
        first -= 1
    while last + 1 < len(items) and _belongs(items[last + 1].item, parent):
        last += 1
    start, end = items[first].start, items[last].place(items[last].item.span)[1]
    mends = tuple(d for d in mended if start <= d.span.start < end)
    title = f"Put {'this' if first == last else f'these {last - first + 1}'} into a {parent}"
    yield Action(title, types.CodeActionKind.QuickFix, list(_edits(site, parent, start, end)), mends)


def _parent(item: ast.Item) -> str | None:
    """The block of the top level that a misplaced item belongs in: the first one that holds it."""
    if not isinstance(item, ast.Block) or item.keyword.text in LANGUAGE.top:
        return None
    return next((parent for parent in LANGUAGE.parents.get(item.keyword.text, ()) if parent in LANGUAGE.top), None)


def _belongs(item: ast.Item, parent: str) -> bool:
    keyword = item.keyword.text if isinstance(item, (ast.Block, ast.Statement)) else ""
    return keyword not in LANGUAGE.top and parent in LANGUAGE.parents.get(keyword, ())


def _is_taken(site: Site, parent: str) -> bool:
    """Whether there may be one such block, and is."""
    blocks = (top.item.keyword.text for top in site.analysis.items if isinstance(top.item, ast.Block))
    return LANGUAGE.blocks[parent].once is not None and parent in blocks


def _edits(site: Site, parent: str, start: int, end: int) -> Iterator[Edit]:
    """Braces around a stretch: on its line, or on lines of their own, with what is between them further in."""
    if b"\n" not in site.data[start:end]:
        yield (start, start), f"{parent} {{ "
        yield (end, end), " }"
        return
    line = site.data[site.data.rfind(b"\n", 0, start) + 1 : start]
    margin = line.decode() if not line.strip() else ""
    yield (start, start), f"{parent}\n{margin}{{\n{margin}{INDENT}"
    at = site.data.find(b"\n", start, end)
    while at >= 0:
        if site.data[at + 1 : at + 2] not in (b"\n", b"\r"):
            yield (at + 1, at + 1), INDENT
        at = site.data.find(b"\n", at + 1, end)
    yield (end, end), f"\n{margin}}}"
