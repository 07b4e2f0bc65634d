"""The checked program: what is right of the syntax tree, each node bound to its entry in the language table.

Whoever reads it need not ask whether a keyword may stand where it stands, whether an argument has the right shape, or
whether a name is declared with the right type: what did not pass is not in it.
"""

from collections.abc import Iterator
from typing import NamedTuple, TypeAlias

from m3d_language import TableData
from m3d_language import table as language

from ..syntax.ast import Argument, Keyword, Name
from ..text.span import Base, Local


class Statement(NamedTuple):
    entry: language.Statement
    arguments: tuple[Argument, ...]
    span: Local


class Table(NamedTuple):
    """A table's numbers: `bulk` read at once, when its item began at byte `origin`; or as arguments, a tuple a row.

    A `broken` one could not be read; it is here so that nobody reports it missing.
    """

    entry: language.Table
    bulk: TableData | None
    origin: int
    head: tuple[Argument, ...]
    rows: tuple[tuple[Argument, ...], ...]
    keyword: Keyword
    span: Local
    broken: bool = False


class Block(NamedTuple):
    """A block; `source` is the variable it is a copy of, `body` what then changes it.

    `broken` are the keywords of members that were left out because they are wrong; nobody is to miss them.
    """

    entry: language.Block
    source: Name | None
    body: tuple["Member", ...]
    broken: frozenset[str]
    keyword: Keyword
    span: Local


Member: TypeAlias = Statement | Table | Block


class Declaration(NamedTuple):
    """A variable with its type: a key of the language table's basics or blocks."""

    name: Name
    type: str


class Assignment(NamedTuple):
    """`value` for a NUMBER or VECTOR; for a structure, `value` is the variable copied and `body` what changes it.

    `broken` is as a Block's.
    """

    target: Name
    type: str
    value: Argument | None
    body: tuple[Member, ...] | None
    broken: frozenset[str]
    span: Local


Content: TypeAlias = tuple[Declaration, ...] | Assignment | Block


def leaves(content: Content) -> Iterator[Statement | Table]:
    """Every statement and table of an item, however deep it stands, in the order of the text."""
    if isinstance(content, (Assignment, Block)):
        yield from _leaves(content.body or ())


def _leaves(body: tuple[Member, ...]) -> Iterator[Statement | Table]:
    for member in body:
        if isinstance(member, Block):
            yield from _leaves(member.body)
        else:
            yield member


def blocks(body: tuple[Member, ...]) -> Iterator[Block]:
    """Every block of a body, however deep it stands, in the order of the text."""
    for member in body:
        if isinstance(member, Block):
            yield member
            yield from blocks(member.body)


class Item(NamedTuple):
    """One top-level item, the byte it starts at, and its base among all items (see span.py). What is below it has
    places in it."""

    start: int
    base: Base
    content: Content
