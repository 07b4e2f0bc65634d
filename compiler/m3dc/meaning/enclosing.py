"""The blocks around a place of the checked program, and what they came to when the program was run."""

from __future__ import annotations

from typing import NamedTuple

from ..text.span import Local, Placed
from . import program
from .evaluate import Made
from .values import Record

TRANSFORM = "TRANSFORM"


class Path(NamedTuple):
    """The way to a place: the top-level item, the blocks in it that hold the place, the outermost first, and the
    statement or table there, if one is."""

    item: program.Item
    blocks: tuple[program.Block, ...]
    member: program.Statement | program.Table | None

    def place(self, span: Local) -> Placed:
        """A range of the item as records have it."""
        return span.at(self.item.base)

    @property
    def in_transform(self) -> bool:
        """Whether the place is in a TRANSFORM block, or in the value of a variable of that type."""
        return self.owners[-1] is not self.holders[-1] or _keyword(self.holders[-1]) == TRANSFORM

    @property
    def holders(self) -> tuple[program.Block | program.Assignment, ...]:
        """The item and the blocks."""
        assert isinstance(self.item.content, (program.Block, program.Assignment))
        return self.item.content, *self.blocks

    @property
    def owners(self) -> tuple[program.Block | program.Assignment, ...]:
        """Those of the holders that have a record of their own: a TRANSFORM block only changes what it stands in."""
        first, *inner = self.holders
        return first, *(block for block in inner if _keyword(block) != TRANSFORM)


def path_to(item: program.Item, span: Local) -> Path | None:
    """The way to a range of an item; None where the item is a declaration."""
    content = item.content
    if not isinstance(content, (program.Block, program.Assignment)):
        return None
    blocks: list[program.Block] = []
    body = content.body or ()
    while True:
        inner = next((member for member in body if _holds(member.span, span)), None)
        if not isinstance(inner, program.Block):
            return Path(item, tuple(blocks), inner)
        blocks.append(inner)
        body = inner.body


def records(path: Path, made: Made) -> tuple[Record, ...] | None:
    """The records of a path's owners, as the run of the whole item left them. None where there is none, or where what
    is wrong in a block has kept it from being made."""
    first = made.value if isinstance(made.value, Record) else made.scene
    record = first or next(iter((*made.solids, *made.lights)), None)
    found: list[Record] = []
    for owner in path.owners:
        if isinstance(owner, program.Block) and found:
            record = _part(found[-1], owner, path.place(owner.span))
        if record is None:
            return None
        found.append(record)
    return tuple(found)


def _part(record: Record, block: program.Block, place: Placed) -> Record | None:
    """What a block at a place made in the record of the block around it."""
    if not block.entry.adds:
        return record.nested.get(block.entry.keyword)
    return next((part for part in record.parts if part.span == place), None)


def transforming(path: Path) -> program.Block | program.Assignment:
    """The innermost owner, left with only its transformations up to the place."""
    owner = path.owners[-1]
    if _keyword(owner) == TRANSFORM:
        return owner._replace(body=_up_to(owner.body or (), path.member))
    body = tuple(member for member in owner.body or () if member.entry.keyword == TRANSFORM)
    if path.holders[-1] is owner:
        return owner._replace(body=body)
    last = path.blocks[-1]
    last_cut = last._replace(body=_up_to(last.body, path.member))
    return owner._replace(body=(*(member for member in body if member.span.start < last.span.start), last_cut))


def _up_to(
    body: tuple[program.Member, ...], member: program.Statement | program.Table | None
) -> tuple[program.Member, ...]:
    return body if member is None else tuple(each for each in body if each.span.start <= member.span.start)


def _keyword(holder: program.Block | program.Assignment) -> str:
    return holder.type if isinstance(holder, program.Assignment) else holder.entry.keyword


def _holds(outer: Local, inner: Local) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end
