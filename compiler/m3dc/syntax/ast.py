"""The abstract syntax tree: what is written, before anything is known of what it means.

The tree knows no single keyword: a `SPHERE` is a Block whose keyword is "SPHERE". Its places count from the
beginning of the top-level item that a node stands in, so that an item that an edit only moved can be used as it is.
"""

from typing import NamedTuple, TypeAlias

from ..text.span import Base, Local, Span

# Deeper than any scene needs (SOLID > SURFACE > TEXTURE > CHECKER > TRANSFORM), and less than Python's stack allows.
DEEPEST = 40


class Number(NamedTuple):
    """A numeral; its value is NaN where it could not be read as one."""

    value: float
    span: Local


class Name(NamedTuple):
    text: str
    span: Local


class Vector(NamedTuple):
    components: tuple[Number | Name, ...]
    span: Local


Argument: TypeAlias = Number | Name | Vector


class Keyword(NamedTuple):
    text: str
    span: Local


class Statement(NamedTuple):
    """`KEYWORD argument, argument`; without arguments a flag."""

    keyword: Keyword
    arguments: tuple[Argument, ...]
    span: Local


class Table(NamedTuple):
    """`KEYWORD { ... }` with numbers in it: `bulk` is where they stand when there is nothing else; or `entries`."""

    keyword: Keyword
    bulk: Local | None
    entries: tuple[Argument, ...]
    span: Local


class Body(NamedTuple):
    """`{ ... }`"""

    items: tuple["Item", ...]
    span: Local


class Block(NamedTuple):
    """`KEYWORD { ... }`, `KEYWORD name` or `KEYWORD name { ... }`."""

    keyword: Keyword
    name: Name | None
    body: Body | None
    span: Local


class Declaration(NamedTuple):
    """`TYPE name, name;`"""

    type: Keyword | Name
    names: tuple[Name, ...]
    span: Local


class Variables(NamedTuple):
    """`VARIABLES { ... }`"""

    keyword: Keyword
    declarations: tuple[Declaration, ...]
    span: Local


class Assignment(NamedTuple):
    """`target = value`, or, for a structure, `target = source`, `target = { ... }`, `target = source { ... }`."""

    target: Name
    value: Argument | None
    body: Body | None
    span: Local


Item: TypeAlias = Statement | Table | Block | Variables | Assignment


class TopLevel(NamedTuple):
    """One item of a file, the byte it starts at, and its base among all items (see span.py)."""

    start: int
    base: Base
    item: Item

    def place(self, span: Local) -> Span:
        """Where a part of the item stands in the text of its file."""
        return span.within(self.start)
