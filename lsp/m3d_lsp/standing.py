"""What the statements around a place of the text have made: the records of the blocks that it stands in.

An item is run again, alone and only as far as the place asked for, with its variables as they are before it. So what
is told of a block is what it is where it stands, whatever a later statement makes of it. Only of an item with a long
table the values are those that it has as a whole, but for matrices.
"""

from __future__ import annotations

from bisect import bisect_right
from typing import NamedTuple

from m3dc.analysis import Analysis
from m3dc.diagnostics import Findings
from m3dc.meaning import program
from m3dc.meaning.evaluate import Evaluator, Made, value_at_first
from m3dc.meaning.transform import IDENTITY, Transform
from m3dc.meaning.values import Record, Value
from m3dc.text.places import Places

# Tables with more rows are not read again.
LONG = 5000


class Standing(NamedTuple):
    """The blocks around a place, from the outermost inwards.

    `item` is the top-level item and `made` what all of it makes; `records` are the values of the blocks around the
    place, without TRANSFORM, each as far as it was run; `blocks` are the blocks inside of the item. `member` is the
    statement or table at the place, `transform` the matrix of the innermost record.
    """

    item: program.Item
    made: Made
    records: tuple[Record, ...]
    blocks: tuple[program.Block, ...]
    member: program.Statement | program.Table | None
    transform: Transform
    places: Places

    @property
    def innermost(self) -> Record:
        return self.records[-1]

    @property
    def whole(self) -> Record:
        """The value of the item, after all of it."""
        record = _record(self.made)
        assert record is not None
        return record


def standing(analysis: Analysis, offset: int) -> Standing | None:
    """What the blocks around a byte have made; None at top level, and where what is there is wrong."""
    index = bisect_right(analysis.program, offset, key=lambda item: item.start) - 1
    if index < 0:
        return None
    item, made = analysis.program[index], analysis.world.made[index]
    content, at = item.content, offset - item.start
    if not isinstance(content, (program.Block, program.Assignment)):
        return None
    if content.body is None or at > content.span.end or _record(made) is None:
        return None
    body, blocks, member = _cut(content.body, at, in_transform=_type(content) == "TRANSFORM")
    short = _without_long_tables(body)
    evaluator = Evaluator(Findings(), _variables_before(analysis, index))
    run = evaluator.run([item._replace(content=content._replace(body=short))], frozenset())
    record = _record(run.made[0])
    assert record is not None
    records = [record]
    for block in blocks:
        keyword = block.entry.keyword
        if keyword != "TRANSFORM":
            inner = records[-1].parts[-1] if block.entry.adds else records[-1].nested[keyword]
            records.append(inner)
    transform = records[-1].transform
    if short is not body:
        records = _as_made(item, made, blocks) or records
    return Standing(item, made, tuple(records), tuple(blocks), member, transform, analysis.places)


def in_scene(here: Standing) -> Transform:
    """What takes the innermost record's own coordinates to those of the scene, or of the variable assigned to."""
    if len(here.records) == 1:
        return here.transform
    outer = here.whole.transform if here.whole.block in ("SOLID", "LIGHT") else IDENTITY
    return here.transform.then(outer)


def _record(made: Made) -> Record | None:
    if isinstance(made.value, Record):
        return made.value
    return made.scene or next(iter((*made.solids, *made.lights)), None)


def _type(content: program.Block | program.Assignment) -> str:
    return content.type if isinstance(content, program.Assignment) else content.entry.keyword


def _cut(
    body: tuple[program.Member, ...], at: int, *, in_transform: bool
) -> tuple[tuple[program.Member, ...], list[program.Block], program.Statement | program.Table | None]:
    """A body without what follows the block that holds a place, or, among transformations, the statement; the blocks
    around the place, and the statement or table there."""
    for number, member in enumerate(body):
        if not member.span.start <= at < member.span.end:
            continue
        if isinstance(member, program.Block):
            inner, blocks, found = _cut(member.body, at, in_transform=member.entry.keyword == "TRANSFORM")
            return (*body[:number], member._replace(body=inner)), [member, *blocks], found
        return (body[: number + 1] if in_transform else body), [], member
    return body, [], None


def _without_long_tables(body: tuple[program.Member, ...]) -> tuple[program.Member, ...]:
    """The same body, if it has none."""
    kept: list[program.Member] = []
    for member in body:
        if isinstance(member, program.Block):
            inner = _without_long_tables(member.body)
            kept.append(member if inner is member.body else member._replace(body=inner))
        elif not isinstance(member, program.Table) or member.bulk is None or len(member.bulk.offsets) <= LONG:
            kept.append(member)
    same = len(kept) == len(body) and all(new is old for new, old in zip(kept, body, strict=True))
    return body if same else tuple(kept)


def _as_made(item: program.Item, made: Made, blocks: list[program.Block]) -> list[Record] | None:
    """The records of the blocks as the whole item has made them."""
    record = _record(made)
    assert record is not None
    records = [record]
    for block in blocks:
        keyword = block.entry.keyword
        if keyword == "TRANSFORM":
            continue
        if block.entry.adds:
            place = block.span.at(item.base)
            record = next((part for part in record.parts if part.span == place), None)
        else:
            record = record.nested.get(keyword)
        if record is None:
            return None
        records.append(record)
    return records


def _variables_before(analysis: Analysis, index: int) -> dict[str, Value]:
    """What every variable is worth before an item of the program."""
    values: dict[str, Value] = {}
    for item, made in zip(analysis.program[:index], analysis.world.made, strict=False):
        content = item.content
        if isinstance(content, program.Assignment):
            if made.value is not None:
                values[content.target.text] = made.value
        elif not isinstance(content, program.Block):
            for declaration in content:
                place = declaration.name.span.at(item.base)
                values[declaration.name.text] = value_at_first(declaration.type, place)
    return values
