"""The abstract syntax tree: what is written, before anything is known of what it means.

The tree knows no single keyword: a `SPHERE` is a Block whose keyword is "SPHERE". Spans are ranges of bytes relative
to the top-level item that a node stands in, so that an item that an edit only moved can be used again as it is.
"""

from typing import NamedTuple, TypeAlias

from ..text.span import Span

# Deeper than any scene needs (SOLID > SURFACE > TEXTURE > CHECKER > TRANSFORM), and less than Python's stack allows.
DEEPEST = 40


class Number(NamedTuple):
    """A numeral; its value is NaN where it could not be read as one."""

    value: float
    span: Span


class Name(NamedTuple):
    text: str
    span: Span


class Vector(NamedTuple):
    components: tuple[Number | Name, ...]
    span: Span


Argument: TypeAlias = Number | Name | Vector


class Keyword(NamedTuple):
    text: str
    span: Span


class Statement(NamedTuple):
    """`KEYWORD argument, argument`; without arguments a flag."""

    keyword: Keyword
    arguments: tuple[Argument, ...]
    span: Span


class Table(NamedTuple):
    """`KEYWORD { ... }` with numbers in it: `bulk` is where they stand when there is nothing else; or `entries`."""

    keyword: Keyword
    bulk: Span | None
    entries: tuple[Argument, ...]
    span: Span


class Body(NamedTuple):
    """`{ ... }`"""

    items: tuple["Item", ...]
    span: Span


class Block(NamedTuple):
    """`KEYWORD { ... }`, `KEYWORD name` or `KEYWORD name { ... }`."""

    keyword: Keyword
    name: Name | None
    body: Body | None
    span: Span


class Declaration(NamedTuple):
    """`TYPE name, name;`"""

    type: Keyword | Name
    names: tuple[Name, ...]
    span: Span


class Variables(NamedTuple):
    """`VARIABLES { ... }`"""

    keyword: Keyword
    declarations: tuple[Declaration, ...]
    span: Span


class Assignment(NamedTuple):
    """`target = value`, or, for a structure, `target = source`, `target = { ... }`, `target = source { ... }`."""

    target: Name
    value: Argument | None
    body: Body | None
    span: Span


Item: TypeAlias = Statement | Table | Block | Variables | Assignment


class TopLevel(NamedTuple):
    """One item of the file, and the byte it starts at; its places count from `base` (see places.py)."""

    start: int
    base: int
    item: Item

    def place(self, span: Span) -> Span:
        """A span of the item as one of the whole text."""
        return span[0] + self.start, span[1] + self.start
