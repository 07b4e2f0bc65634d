"""What the formatter lays out: a scene as a line of atoms, and the items they make up.

An atom is a token, a comment, or all the rows of a table. Between two atoms there is nothing but white space, and white
space is all that the formatter changes.
"""

from __future__ import annotations

from typing import NamedTuple

from tree_sitter import Node

from ..diagnostics import catalogue
from ..syntax.ast import DEEPEST
from ..text.span import Span

COMMENT = "comment"
ROWS = "rows"


class FormatError(ValueError):
    """Text that is left alone because it has a syntax error: the first one's place, and what is wrong there."""

    def __init__(self, message: str, span: Span) -> None:
        super().__init__(message)
        self.message = message
        self.span = span


class Atom(NamedTuple):
    """A range of bytes that keeps its text. `kind` is COMMENT, ROWS, or the type of the token in the tree."""

    start: int
    end: int
    kind: str


class Item(NamedTuple):
    """A declaration, statement, assignment, block or table: the atoms `first` to `last`.

    With braces, `open` and `close` are theirs, and `members` what stands between them, but for comments and rows.
    """

    kind: str
    first: int
    last: int
    open: int = -1
    close: int = -1
    members: tuple[Item, ...] = ()


class Layers(NamedTuple):
    """The atoms of a scene, or a part of it, in order, and its top-level items."""

    atoms: list[Atom]
    items: tuple[Item, ...]


def read(data: bytes, nodes: list[Node]) -> Layers:
    """The atoms and items of nodes of the top level that follow one another, without errors. Raises FormatError where
    they are too deep."""
    reader = _Reader(data)
    items = reader.items(nodes, 0)
    return Layers(reader.atoms, items)


class _Reader:
    def __init__(self, data: bytes) -> None:
        self._data = data
        self.atoms: list[Atom] = []

    def items(self, nodes: list[Node], depth: int) -> tuple[Item, ...]:
        """The items among the nodes. What else there is, comments and braces, is only noted as atoms."""
        found: list[Item] = []
        for node in nodes:
            if node.child_count:
                found.append(self._table(node) if node.type == "table" else self._item(node, depth))
            else:
                self._leaf(node)
        return tuple(found)

    def _leaf(self, node: Node) -> None:
        self.atoms.append(Atom(node.start_byte, node.end_byte, node.type))

    def _leaves(self, node: Node) -> None:
        if node.child_count:
            for child in node.children:
                self._leaves(child)
        else:
            self._leaf(node)

    def _item(self, node: Node, depth: int) -> Item:
        if depth > DEEPEST:
            message = f"{catalogue.NESTED_TOO_DEEPLY.headline}: no scene needs more than {DEEPEST} levels"
            raise FormatError(message, (node.start_byte, node.end_byte))
        first = len(self.atoms)
        opened, members = -1, ()
        children = node.children
        for number, child in enumerate(children):
            if child.type == "body":
                opened = len(self.atoms)
                members = self.items(child.children, depth + 1)
            elif child.type == "{":
                # The declarations of variables stand among the block's own nodes; other blocks have a body.
                opened = len(self.atoms)
                members = self.items(children[number:], depth + 1)
                break
            else:
                self._leaves(child)
        last = self._last_token(first)
        return Item(node.type, first, last, opened, last if opened >= 0 else -1, members)

    def _table(self, node: Node) -> Item:
        first = len(self.atoms)
        children = node.children
        brace = next(number for number, child in enumerate(children) if child.type == "{")
        for child in children[: brace + 1]:
            self._leaf(child)
        opened = len(self.atoms) - 1
        close = next(child for child in reversed(children) if child.type == "}")
        inside = children[brace + 1 : children.index(close)]
        start = children[brace].end_byte
        # A comment that ends the brace's line is not part of the rows.
        for number, child in enumerate(inside):
            after = inside[number + 1].start_byte if number + 1 < len(inside) else close.start_byte
            if child.type != COMMENT or b"\n" in self._data[start : child.end_byte]:
                break
            if b"\n" in self._data[child.end_byte : after]:
                for comment in inside[: number + 1]:
                    self._leaf(comment)
                inside = inside[number + 1 :]
                break
        if inside:
            self.atoms.append(Atom(inside[0].start_byte, inside[-1].end_byte, ROWS))
        self._leaf(close)
        return Item(node.type, first, len(self.atoms) - 1, opened, len(self.atoms) - 1)

    def _last_token(self, first: int) -> int:
        """The item's last atom: a comment after it is not part of it."""
        last = len(self.atoms) - 1
        while last > first and self.atoms[last].kind == COMMENT:
            last -= 1
        return last
