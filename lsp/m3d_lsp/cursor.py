"""The place of a cursor in text that is being typed: what it stands in, and what could stand there.

The tree is of little use where the text is broken, so the text before the cursor is read by the formal grammar, from
the beginning of the top-level item that the cursor is in.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from tree_sitter import Tree

from m3d_language import blank_comments
from m3d_language.prefix import NOTHING, Prefix, Token, read_prefix
from m3d_language.table import LANGUAGE, Block, Statement, Table
from m3dc.syntax import numerals
from m3dc.syntax.recovery import lexer

from .entry import Slot, slot, values
from .names import names
from .snapshot import Snapshot
from .text import Span

# What begins an item: nothing else stands at the top level, and these stand nowhere else, but for SOLID and LIGHT as
# types of variables.
_KEYWORDS = "|".join(sorted(LANGUAGE.keywords))
_ITEM = re.compile(rf"\b(?:{'|'.join(LANGUAGE.top)})\b|\b(?!(?:{_KEYWORDS})\b)[A-Za-z]\w*\s*=")
_COMPLETE = re.compile(rf"\b(?:{_KEYWORDS})\b\s*(?:[A-Za-z]\w*\s*)?\{{[^{{}}]*\}}")
_OPEN_TABLE = re.compile(r"\{[^{}A-DF-Za-df-z]{500,}\Z")

# How far back the beginning of the item is looked for.
_NEAR, _FAR = 2_000, 200_000


# So many numbers are whole rows in every table.
_WHOLE_ROWS = math.lcm(*(values(table.row) for block in LANGUAGE.blocks.values() for table in block.tables.values()))


class Cursor(NamedTuple):
    """A place in the text. `word` is what is being typed there, up to the cursor, in bytes; `block` the block of the
    language whose members may stand there, `entry` the statement or table that was begun, `slot` its argument."""

    prefix: Prefix
    word: Span
    block: Block | None
    entry: Statement | Table | None
    slot: Slot | None

    @property
    def last(self) -> Token | None:
        """The token before the word."""
        return self.prefix.member[-1] if self.prefix.member else None


def read(snapshot: Snapshot, offset: int) -> Cursor:
    """The place of a byte of the text."""
    data = snapshot.text.data
    start = lexer.word_start(data, offset)
    item = None if _in_comment(snapshot.analysis.tree, offset) else _item_before(data, snapshot.analysis.tree, start)
    prefix = NOTHING if item is None else read_prefix(item)
    block = _block(snapshot, prefix)
    entry = _entry(prefix, block)
    return Cursor(prefix, (start, offset), block, entry, _slot(prefix, entry))


def instead(place: Cursor) -> Cursor:
    """The same place, were what was begun there not begun."""
    return place._replace(prefix=place.prefix._replace(expected=place.prefix.instead, member=()), entry=None, slot=None)


def _in_comment(tree: Tree, offset: int) -> bool:
    node = tree.root_node.descendant_for_byte_range(max(offset - 1, 0), offset)
    return node is not None and node.type == "comment" and node.start_byte < offset < node.end_byte


def _item_before(data: bytes, tree: Tree, end: int) -> str | None:
    """The text from the beginning of a top-level item, the one that a byte is in or the one before, up to the byte;
    long tables are left out, but for the ends of one that goes on. None inside of a very long one."""
    pieces: list[str] = []
    at, reach, total = end, _NEAR, 0
    while total < _FAR:
        start = max(at - reach, 0)
        token = tree.root_node.descendant_for_byte_range(start, start)
        before = start
        if token is not None and token.type in ("comment", "numeric_table") and token.start_byte < start:
            before = token.start_byte
            closed = token.type == "comment" or b"}" in data[token.end_byte : at]
            start = token.end_byte if token.end_byte <= at and closed else before
            if at - start > _FAR:
                return None
        pieces.append(data[start:at].decode("utf-8", "replace"))
        total += at - start
        text = blank_comments("".join(reversed(pieces)))
        item = _last_item(text)
        if before == 0 or item:
            return _OPEN_TABLE.sub(_shortened, _without_complete(text[item or 0 :]))
        if before < start:
            pieces.append(" ")
        at, reach = before, 4 * reach
    return None


def _without_complete(text: str) -> str:
    """A text without its complete blocks and tables: they tell nothing of what may follow them."""
    found = 1
    while found:
        text, found = _COMPLETE.subn("", text)
    return text


def _shortened(table: re.Match[str]) -> str:
    """A table that goes on at the cursor, without most of its rows: as many numbers are left out as make whole rows."""
    data = table[0].encode()
    starts = [start for start, _ in numerals.scalars(data, 0, len(data))]
    left_out = (len(starts) - 2 * _WHOLE_ROWS) // _WHOLE_ROWS * _WHOLE_ROWS
    if left_out <= 0:
        return table[0]
    return (data[: starts[_WHOLE_ROWS]] + data[starts[_WHOLE_ROWS + left_out] :]).decode()


def _last_item(text: str) -> int | None:
    """Where the last item begins whose beginning is certain."""
    starts = list(_ITEM.finditer(text))
    for number in range(len(starts) - 1, -1, -1):
        match = starts[number]
        is_target = match[0].endswith("=")
        if match[0] not in LANGUAGE.types and not is_target:
            return match.start()
        if is_target and match[0][:-1].rstrip().upper() in LANGUAGE.keywords:
            continue
        # Is it a type, or a name with a value, among declarations? They hold no brace.
        opening = text.rfind("{", 0, match.start())
        closing = text.rfind("}", 0, match.start())
        if opening < 0 and closing < 0:
            if is_target:
                return match.start()
            continue
        if closing > opening or not text[:opening].rstrip().endswith("VARIABLES"):
            return match.start()
    return None


def _block(snapshot: Snapshot, prefix: Prefix) -> Block | None:
    """The innermost block; for a table the one it belongs to."""
    for opened in reversed(prefix.opened):
        if opened.target is not None:
            return LANGUAGE.blocks.get(names(snapshot.analysis).type(opened.target) or "")
        keyword = opened.keyword
        if keyword is None or keyword in LANGUAGE.blocks:
            return LANGUAGE.blocks.get(keyword or "")
    return None


def _entry(prefix: Prefix, block: Block | None) -> Statement | Table | None:
    if block is None:
        return None
    innermost = prefix.opened[-1].keyword
    if innermost is not None and innermost in block.tables:
        return block.tables[innermost]
    return block.statements.get(prefix.member[0].text) if prefix.member else None


def _slot(prefix: Prefix, entry: Statement | Table | None) -> Slot | None:
    """The argument that the next value is, or the last one, if none can follow."""
    if entry is None:
        return None
    number, component = 0, None
    for token in prefix.member[1:] if isinstance(entry, Statement) else prefix.member:
        match token.terminal:
            case "LANGLE":
                component = 0
            case "COMMA" if component is not None:
                component += 1
            case "RANGLE":
                component, number = None, number + 1
            case "NUMERAL" | "IDENTIFIER" if component is None:
                number += 1
            case _:
                pass
    return slot(entry, number, component)
