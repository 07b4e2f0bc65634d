"""What a scene consists of, as a person would list it: its variables, blocks and tables, each with a name.

A block is named by the comment that stands with it, or by the variable that it is a copy of. It is made of the syntax
alone, so that files that are not open can be listed as well.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple

from m3dc import ast
from m3dc.analysis import Analysis
from tree_sitter_m3d.table import LANGUAGE

from .comments import Comments, comments
from .text import Span

LONGEST_VALUE = 40  # characters


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
        body = None if item.body is None else self._start + item.body.span[0]
        title = self._remarks.title(self._real(item.span), body)
        children = self._children(item.body)
        if title is not None:
            name, detail = title, head
        else:
            name, detail = head, ", ".join(dict.fromkeys(child.keyword for child in children if _adds(child.keyword)))
        return self._entry(name, detail, keyword, item.span, item.keyword.span, children)

    def _children(self, body: ast.Body | None) -> tuple[Entry, ...]:
        entries = (self.entry(item) for item in (body.items if body is not None else ()))
        return tuple(entry for entry in entries if entry is not None)

    def _entry(
        self, name: str, detail: str, keyword: str, span: Span, place: Span, children: tuple[Entry, ...]
    ) -> Entry:
        return Entry(name, detail, keyword, False, self._real(span), self._real(place), children)

    def _real(self, span: Span) -> Span:
        return span[0] + self._start, span[1] + self._start

    def _value(self, value: ast.Argument) -> str:
        start, end = self._real(value.span)
        text = " ".join(self._data[start:end].decode("utf-8", "replace").split())
        return text if len(text) <= LONGEST_VALUE else text[: LONGEST_VALUE - 1] + "…"


def _adds(keyword: str) -> bool:
    """Whether a keyword begins a thing of which there can be many: a primitive, a texture, a wave."""
    return keyword in LANGUAGE.blocks and LANGUAGE.blocks[keyword].adds
