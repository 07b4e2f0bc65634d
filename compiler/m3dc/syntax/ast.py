"""The abstract syntax tree: what is written, before anything is known of what it means.

The tree knows no single keyword: a `SPHERE` is a Block whose keyword is "SPHERE". Its places count from the
beginning of the top-level item that a node stands in, so that an item that an edit only moved can be used as it is.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

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

    items: tuple[Item, ...]
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


# --- nodes and where they stand -----------------------------------------------------------------------------------

Node: TypeAlias = Item | Argument | Keyword | Body | Declaration


class Located(NamedTuple):
    """A node, the nodes that it stands in, the outermost first, and the top-level item that all of them are part of."""

    node: Node
    around: tuple[Node, ...]
    top: TopLevel

    @property
    def span(self) -> Span:
        """Where the node is, in bytes of the text."""
        return self.top.place(self.node.span)

    @property
    def parent(self) -> Located | None:
        """The node that this one is a part of; None of a top-level item."""
        return Located(self.around[-1], self.around[:-1], self.top) if self.around else None

    @property
    def item(self) -> Located:
        """The innermost item that the node is part of, which may be itself."""
        at: Located | None = self
        while at is not None and not isinstance(at.node, Item):
            at = at.parent
        assert at is not None
        return at

    @property
    def path(self) -> tuple[Item, ...]:
        """The items that the node is part of, from the top-level one inwards; the last one may be the node itself."""
        return tuple(each for each in (*self.around, self.node) if isinstance(each, Item))


def children(node: Node) -> Sequence[Node]:
    """The parts of a node, in the order of the text."""
    return _PARTS[type(node)](node)


def _block(block: Block) -> Sequence[Node]:
    return tuple(node for node in (block.keyword, block.name, block.body) if node is not None)


def _assignment(assignment: Assignment) -> Sequence[Node]:
    return tuple(node for node in (assignment.target, assignment.value, assignment.body) if node is not None)


_PARTS: dict[type, Callable[[Any], Sequence[Node]]] = {
    Number: lambda _: (),
    Name: lambda _: (),
    Keyword: lambda _: (),
    Vector: lambda vector: vector.components,
    Statement: lambda statement: (statement.keyword, *statement.arguments),
    Table: lambda table: (table.keyword, *table.entries),
    Body: lambda body: body.items,
    Block: _block,
    Declaration: lambda declaration: (declaration.type, *declaration.names),
    Variables: lambda variables: (variables.keyword, *variables.declarations),
    Assignment: _assignment,
}


def walk(items: Iterable[TopLevel], *kinds: type[Node]) -> Iterator[Located]:
    """Every node of some items, or those of some kinds, each before its parts, in the order of the text."""
    wanted = frozenset(kinds or _PARTS)
    for top in items:
        left: list[tuple[Node, tuple[Node, ...]]] = [(top.item, ())]
        while left:
            node, around = left.pop()
            kind = type(node)
            if kind in wanted:
                yield Located(node, around, top)
            parts = _PARTS[kind](node)
            if parts:
                inside = (*around, node)
                left += [(part, inside) for part in reversed(parts)]


def locate(items: Sequence[TopLevel], span: Span) -> Located | None:
    """The innermost node that holds a range of bytes of the text; None where no item does. Of two that touch at an
    empty range it is the one that begins there. `items` are all of a text, in order."""
    start, end = span
    index = bisect_right(items, start, key=lambda top: top.place(top.item.span)[0]) - 1
    if index < 0 or end > items[index].place(items[index].item.span)[1]:
        return None
    top = items[index]
    node: Node = top.item
    around: list[Node] = []
    start, end = start - top.start, end - top.start
    while True:
        parts = children(node)
        number = bisect_right(parts, start, key=lambda part: part.span.start) - 1
        if number < 0 or end > parts[number].span.end:
            return Located(node, tuple(around), top)
        around.append(node)
        node = parts[number]
