"""What the language table says of a place in a scene: which block's members stand there, which statement or table it is
in, and which of its arguments."""

from __future__ import annotations

from typing import NamedTuple

from m3d_language.table import LANGUAGE, Argument, Block, Statement, Table
from m3dc.analysis import Analysis
from m3dc.syntax import ast

from .names import names


class Slot(NamedTuple):
    """A value in a list of arguments: of which argument, which `component` if it is one of a vector, and its `number`
    when every component is counted."""

    argument: Argument
    component: int | None
    number: int


class Entry(NamedTuple):
    """The block whose members stand at a place, None at top level; the statement or table there, and its argument."""

    block: Block | None
    member: Statement | Table | None
    slot: Slot | None


def entry_of(at: ast.Located, analysis: Analysis) -> Entry:
    """What a node of the tree is. A keyword belongs to the block that its item stands in."""
    *outer, item = at.path
    block = block_of(outer[-1], analysis) if outer else None
    if block is None:
        return Entry(None, None, None)
    match item:
        case ast.Statement():
            member, arguments = block.statements.get(item.keyword.text), item.arguments
        case ast.Table():
            member, arguments = block.tables.get(item.keyword.text), item.entries
        case _:
            return Entry(block, None, None)
    return Entry(block, member, None if member is None else _slot_of(at, member, arguments))


def block_of(item: ast.Item, analysis: Analysis) -> Block | None:
    """The block of the language that an item is, or is the value of: its members may stand in the item's braces."""
    match item:
        case ast.Block():
            return LANGUAGE.blocks.get(item.keyword.text)
        case ast.Assignment():
            return LANGUAGE.blocks.get(names(analysis).type(item.target.text) or "")
        case _:
            return None


def _slot_of(at: ast.Located, member: Statement | Table, arguments: tuple[ast.Argument, ...]) -> Slot | None:
    """The argument that a node is, or is part of."""
    nodes = (*at.around, at.node)
    number = next((n for n, argument in enumerate(arguments) if any(argument is node for node in nodes)), None)
    if number is None:
        return None
    vector, component = arguments[number], None
    if isinstance(vector, ast.Vector) and at.node is not vector:
        component = next((n for n, each in enumerate(vector.components) if each is at.node), None)
    return slot(member, number, component)


def slot(member: Statement | Table, number: int, component: int | None) -> Slot | None:
    """The argument that value `number` is, from 0, a vector counted as one; the last one where there are fewer. None
    of a statement that takes none."""
    head, row = (member.arguments, ()) if isinstance(member, Statement) else (member.head, member.row)
    arguments = [*head, *row]
    if not arguments:
        return None
    if row and number >= len(arguments):
        number = len(head) + (number - len(head)) % len(row)
    number = min(number, len(arguments) - 1)
    argument = arguments[number]
    component = min(component, len(argument.components) - 1) if component is not None and argument.components else None
    return Slot(argument, component, values(arguments[:number]) + (component or 0))


def values(arguments: list[Argument] | tuple[Argument, ...]) -> int:
    """How many numbers a list of arguments has, the components of vectors counted one by one."""
    return sum(max(len(argument.components), 1) for argument in arguments)
