"""What a scene consists of, as a person would list it: its variables, blocks and tables, each with a name.

A block is named by the comment that stands with it, or by the variable that it is a copy of; its detail tells it from
others of its kind: what it holds, where that is placed, and the surface. All of it is made of the syntax alone, so that
files that are not open can be listed as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import NamedTuple

from m3d_language.table import LANGUAGE
from m3dc.analysis import Analysis
from m3dc.syntax.parse import ast
from m3dc.text.span import Local

from .comments import Comments, comments
from .text import Span

LONGEST_VALUE = 40  # characters

# The transformations that place a thing.
_MOVES = ("TRANSLATE", "TRANSX", "TRANSY", "TRANSZ")


class Entry(NamedTuple):
    """One thing: `name` as people know it, `detail` beside it; `keyword` is what it is: of a variable its type, if that
    is known. `span` is all of it, `place` what to go to. `is_variable` also where it is only assigned to."""

    name: str
    detail: str
    keyword: str
    is_variable: bool
    span: Span
    place: Span
    children: tuple[Entry, ...]


@lru_cache(maxsize=8)
def outline(analysis: Analysis) -> tuple[Entry, ...]:
    """The outline of an analysed document."""
    return outline_of(analysis.source.data, analysis.items, comments(analysis))


def outline_of(data: bytes, items: Iterable[ast.TopLevel], remarks: Comments) -> tuple[Entry, ...]:
    """The outline of a text's items."""
    items = list(items)
    types = {
        name.text: declaration.type.text
        for top in items
        if isinstance(top.item, ast.Variables)
        for declaration in top.item.declarations
        for name in declaration.names
    }
    made = (_Maker(data, top.start, remarks, types).entry(top.item) for top in items)
    return tuple(entry for entry in made if entry is not None)


class _Maker:
    """Makes the entries of one top-level item, which begins at byte `start`."""

    def __init__(self, data: bytes, start: int, remarks: Comments, types: dict[str, str]) -> None:
        self._data = data
        self._start = start
        self._remarks = remarks
        self._types = types

    def entry(self, item: ast.Item) -> Entry | None:
        """The entry of an item; None of a statement."""
        match item:
            case ast.Variables():
                children = tuple(
                    Entry(
                        name.text,
                        declaration.type.text,
                        declaration.type.text,
                        True,
                        self._real(name.span),
                        self._real(name.span),
                        (),
                    )
                    for declaration in item.declarations
                    for name in declaration.names
                )
                return self._entry(item.keyword.text, "", item.keyword.text, item.span, item.keyword.span, children)
            case ast.Assignment():
                type_ = self._types.get(item.target.text, "")
                detail = self._value(item.value) if item.value is not None and item.body is None else type_
                entry = self._entry(
                    item.target.text, detail, type_, item.span, item.target.span, self._children(item.body)
                )
                return entry._replace(is_variable=True)
            case ast.Block():
                return self._block(item)
            case ast.Table():
                return self._entry(item.keyword.text, "", item.keyword.text, item.span, item.keyword.span, ())
            case ast.Statement():
                return None

    def _block(self, item: ast.Block) -> Entry:
        keyword = item.keyword.text
        head = f"{keyword} {item.name.text}" if item.name is not None else keyword
        body = None if item.body is None else self._real(item.body.span)[0]
        title = self._remarks.title(self._real(item.span), body)
        children = self._children(item.body)
        name, detail = (title, head) if title is not None else (head, self._detail(item))
        return self._entry(name, detail, keyword, item.span, item.keyword.span, children)

    def _detail(self, item: ast.Block) -> str:
        """What tells a block from others of its kind: `SPHERE at < 0, 0, 1 >, PLANE, matt`."""
        place = self._place(item)
        found = [place]
        for keyword, part in self._added(item):
            where = self._place(part) if not place else ""
            found.append(f"{keyword} {where}".rstrip())
            place = place or where
        surface = next((block for block in _blocks(item) if block.keyword.text == "SURFACE"), None)
        if surface is not None:
            found.append(self._surface(surface))
        return ", ".join(dict.fromkeys(part for part in found if part))

    def _added(self, item: ast.Block) -> Iterator[tuple[str, ast.Block]]:
        """The first of each kind of thing in a block that there may be many of, or that has a place."""
        seen = set[str]()
        for block in _blocks(item):
            keyword = block.keyword.text
            placed = keyword in LANGUAGE.types and self._place(block)
            if (_adds(keyword) or placed) and keyword not in seen:
                seen.add(keyword)
                yield keyword, block

    def _place(self, item: ast.Block) -> str:
        """Where a block is, as its first point says, or else what moves it: `at < 0, 0, 1 >`, `TRANSX 1`; '' where
        neither is written."""
        entry = LANGUAGE.blocks.get(item.keyword.text)
        if entry is None or entry.keyword == "TRANSFORM":
            return ""
        for statement in _statements(item):
            known = entry.statements.get(statement.keyword.text)
            if known is not None and known.arguments and known.arguments[0].kind == "point" and statement.arguments:
                return f"at {self._value(statement.arguments[0])}"
        for block in _blocks(item):
            for statement in _statements(block) if block.keyword.text == "TRANSFORM" else ():
                if statement.keyword.text in _MOVES and statement.arguments:
                    value = self._value(statement.arguments[0])
                    return (
                        f"at {value}" if statement.keyword.text == "TRANSLATE" else f"{statement.keyword.text} {value}"
                    )
        return ""

    def _surface(self, surface: ast.Block) -> str:
        """A surface as one would name it: its variable, or its colour and texture."""
        if surface.name is not None:
            return surface.name.text
        colors = (s.arguments[0] for s in _statements(surface) if s.keyword.text == "COLOR" and s.arguments)
        textures = (b for b in _blocks(surface) if b.keyword.text == "TEXTURE")
        kinds = (kind.keyword.text for texture in textures for kind in _blocks(texture))
        return " ".join([*(f"COLOR {self._value(color)}" for color in colors), *kinds])

    def _children(self, body: ast.Body | None) -> tuple[Entry, ...]:
        entries = (self.entry(item) for item in (body.items if body is not None else ()))
        return tuple(entry for entry in entries if entry is not None)

    def _entry(
        self, name: str, detail: str, keyword: str, span: Local, place: Local, children: tuple[Entry, ...]
    ) -> Entry:
        return Entry(name, detail, keyword, False, self._real(span), self._real(place), children)

    def _real(self, span: Local) -> Span:
        return span.within(self._start)

    def _value(self, value: ast.Argument) -> str:
        start, end = self._real(value.span)
        text = " ".join(self._data[start:end].decode("utf-8", "replace").split())
        return text if len(text) <= LONGEST_VALUE else text[: LONGEST_VALUE - 1] + "…"


def _blocks(item: ast.Block) -> Iterator[ast.Block]:
    return (member for member in (item.body.items if item.body is not None else ()) if isinstance(member, ast.Block))


def _statements(item: ast.Block) -> Iterator[ast.Statement]:
    members = item.body.items if item.body is not None else ()
    return (member for member in members if isinstance(member, ast.Statement))


def _adds(keyword: str) -> bool:
    """Whether a keyword begins a thing of which there can be many: a primitive, a texture, a wave."""
    return keyword in LANGUAGE.blocks and LANGUAGE.blocks[keyword].adds
