"""The braces of blocks: opening one, closing it, and what is said where either is missing."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...diagnostics import catalogue
from ...diagnostics.words import members
from .. import ast
from . import skip, wording
from .braces import brace_faults
from .cursor import Cursor
from .lexer import Token


class AgainError(Exception):
    """The item is to be read again: with braces closed at other places, or with every top-level keyword ending it."""

    def __init__(self, closed: Sequence[int] = ()) -> None:
        self.closed = closed


def open_block(cursor: Cursor, keyword: Token, *, variable: bool = False) -> bool:
    """Pass the opening brace of a block; report it where it is missing. Whether the block goes on."""
    token = cursor.peek()
    if token.kind == "{":
        cursor.open.append(cursor.next())
        return True
    if cursor.cut and token.kind == "end":
        cursor.doubtful = True
        return False
    also = "; the name of a variable could stand here too" if variable else ""
    if token.text in ("(", "[", ":"):
        also = "; what belongs to a block stands between { and }"
    cursor.faults.add(catalogue.MISSING_MARK, cursor.place(token), f"{wording.found(token)}{also}", fill="{")
    if token.text in ("(", "["):
        cursor.doubtful = True
        skip.all_brackets(cursor)
        if cursor.peek().kind == "{":
            skip.group(cursor)
        return False
    if token.text == ":":
        token = cursor.next() and cursor.peek()
    if not _has_more_closed(cursor, token.start):
        cursor.doubtful = True
        if token.first:
            skip.indented(cursor, keyword)
        return False
    cursor.open.append(Token("{", cursor.before, cursor.before, "", False, False))
    return True


def _has_more_closed(cursor: Cursor, start: int) -> bool:
    """Whether braces from here on to the next item close more than is open."""
    lexer, depth = cursor.look(start), len(cursor.open)
    while (token := lexer.next()).kind != "end" and not (token.first and token.text in members(None)):
        depth += (token.kind == "{") - (token.kind == "}")
        if depth < 0:
            return True
    return False


def close_block(cursor: Cursor) -> None:
    """Pass the closing brace of a block."""
    brace = cursor.next()
    opened = cursor.open.pop()
    if brace.start == brace.end:
        cursor.report_unclosed(opened, brace.start, "this block is not closed")
    if len(cursor.open) == 0:
        cursor.blocks[cursor.start] = (_keyword_at_start(cursor), brace.start)


def _keyword_at_start(cursor: Cursor) -> str:
    match = re.compile(rb"[A-Z]+").match(cursor.data, cursor.start)
    return match[0].decode() if match else ""


def end_unclosed(cursor: Cursor, token: Token) -> None:
    """Report that a block is not closed before a token."""
    if cursor.cut and token.kind == "end":
        cursor.doubtful = True
        cursor.open.pop()
        return
    if not cursor.strict and cursor.nested_top:
        raise AgainError
    if not cursor.closed and cursor.misfit is not None and len(cursor.open) == 1:
        raise AgainError([cursor.misfit])
    marked = cursor.faults.marks.get(cursor.start, 0)
    # What stands in no table may well stand in the block around it: of that one nothing is known yet.
    outside = token.kind == "end" or cursor.ends_all(token) or not cursor.around
    if outside and not cursor.closed and len(cursor.faults.findings.found) == marked and len(cursor.open):
        end = token.start if token.kind != "end" else cursor.lexer.end
        faults = brace_faults(cursor.blanked(cursor.start, end))
        if faults and all(fault.missing for fault in faults) and len(faults) == len(cursor.open):
            raise AgainError([cursor.start + fault.offset for fault in faults])
    opened = cursor.open.pop()
    cursor.report_unclosed(opened, cursor.before, wording.found(token))


def pass_too_deep(cursor: Cursor, keyword: Token) -> None:
    """Pass a block that is nested too deeply."""
    if not cursor.too_deep:
        span = (keyword.start, min(cursor.peek().end, cursor.lexer.end))
        cursor.faults.add(catalogue.NESTED_TOO_DEEPLY, span, f"no scene needs more than {ast.DEEPEST} levels")
    cursor.too_deep = cursor.doubtful = True
    cursor.open.pop()
    depth = 1
    while depth and (token := cursor.next()).kind != "end":
        depth += (token.kind == "{") - (token.kind == "}")
