"""A closing brace at the top level: where the one stands that is too many."""

from __future__ import annotations

from m3d_language.table import LANGUAGE

from ...diagnostics import catalogue
from ...diagnostics.words import members
from .braces import brace_faults
from .cursor import Cursor


class ElsewhereError(Exception):
    """A brace before the current place was one too many: reading goes on from there, as if it were not there."""

    def __init__(self, start: int) -> None:
        self.start = start


def pass_stray_brace(cursor: Cursor) -> None:
    """Pass a closing brace and report it, or the brace before it that is the one too many."""
    brace = cursor.peek()
    start, (keyword, close) = max(_blocks_before(cursor, brace.start), default=(brace.start, ("", brace.start)))
    faults = brace_faults(cursor.blanked(start, brace.end))
    extra = start + faults[0].offset if len(faults) == 1 and not faults[0].missing else brace.start
    detail = "found '}', which closes more than was opened"
    between = _first_member(cursor, close + 1, brace.start)
    if extra == brace.start and between is not None and between in members(LANGUAGE.blocks.get(keyword)):
        extra, detail = close, f"this brace closes the {keyword}, and {between} after it stands in it"
    edits, kind = [((extra, extra + 1), "")], "}" if extra == brace.start else None
    cursor.faults.add(
        catalogue.INVALID_AT_TOP,
        (extra, extra + 1),
        detail,
        edits=edits,
        title="Remove this brace",
        kind=kind,
        sure=False,
    )
    if extra == brace.start:
        cursor.next()
        return
    cursor.faults.settle()
    fault = cursor.faults.findings.found[-1]
    for item in [item for item in cursor.faults.marks if item >= start]:
        del cursor.faults.findings.found[cursor.faults.marks.pop(item) :]
    cursor.faults.findings.found.append(fault)
    cursor.lexer.ignored.add(extra)
    cursor.faults.marks[start] = len(cursor.faults.findings.found)
    raise ElsewhereError(start)


def _blocks_before(cursor: Cursor, end: int) -> list[tuple[int, tuple[str, int]]]:
    """The top-level block that stands last before a byte: where it begins, its keyword and closing brace."""
    cursor.lexer.budget.spend(len(cursor.blocks) + len(cursor.whole))
    before = [(start, block) for start, block in cursor.blocks.items() if block[1] < end]
    whole = max((start for start in cursor.whole if start < end), default=None)
    if whole is not None and all(start < whole for start, _ in before):
        return [(start, block) for start in sorted(cursor.whole, reverse=True) if start < end
                if (block := _whole_block(cursor, start)) is not None][:1]  # fmt: skip
    return before


def _whole_block(cursor: Cursor, start: int) -> tuple[str, int] | None:
    """The keyword and closing brace of the top-level block at a byte; None where there is none."""
    lexer = cursor.look(start)
    keyword, depth = lexer.next(), 0
    if keyword.text not in LANGUAGE.top:
        return None
    while (token := lexer.next()).kind != "end":
        depth += (token.kind == "{") - (token.kind == "}")
        if depth == 0 and token.kind == "}":
            return keyword.text, token.start
        if depth == 0 and token.kind not in ("word", "{"):
            return None
    return None


def _first_member(cursor: Cursor, start: int, end: int) -> str | None:
    """The keyword that stands first in a stretch."""
    token = cursor.look(start, end).next()
    return token.text if token.kind == "keyword" else None
