"""The arguments of a statement."""

from __future__ import annotations

from m3d_language.table import Block, Statement

from ...diagnostics import catalogue
from ...diagnostics.spelling import certain
from ...diagnostics.words import members, takes
from .. import ast
from . import skip, wording
from .cursor import Cursor
from .values import is_bracketed, read_value, report_bare_vector, starts_value


def read_arguments(
    cursor: Cursor, entry: Statement | None, block: Block | None, keyword: str
) -> tuple[ast.Argument, ...]:
    found: list[ast.Argument] = []
    first = cursor.peek()
    wanted = len(entry.arguments) if entry else 4
    shape = None if entry is None or entry.is_flag else entry.arguments[0].shape
    if shape is not None:
        _extra_commas(cursor, wanted)
    while starts_value(cursor) and _is_argument(cursor, entry, block):
        value = read_value(cursor, "vector" if shape == "vector" else "number" if shape else None)
        found += [value] if value is not None else []
        token = cursor.peek()
        if token.kind == ",":
            comma = cursor.next()
            omitted = len(found) < wanted and _extra_commas(cursor, wanted)
            if not starts_value(cursor) or not _is_argument(cursor, entry, block):
                if not omitted:
                    cursor.faults.superfluous(comma, "statements follow one another without a comma")
                break
        elif len(found) < wanted and token.kind == "number" and shape != "vector" and value is not None:
            cursor.missing(",")
        else:
            break
    token = cursor.peek()
    if token.kind in (">", "number") and shape == "vector" and first.kind == "number":
        report_bare_vector(cursor, first)
        return tuple(found)
    if token.kind in ("number", "<") and found and entry is not None:
        cursor.faults.invalid(block, token.span, f"{wording.found(token)}; {keyword} {takes(entry)}")
        cursor.doubtful = True
        skip.values(cursor)
    return tuple(found)


def _extra_commas(cursor: Cursor, wanted: int) -> bool:
    """Pass commas where one of the numbers that are `wanted` should stand. Among several numbers a comma is no more
    likely one too many than a number is missing: whether that was reported."""
    omitted = cursor.peek().kind == "," and wanted > 1
    if omitted:
        cursor.faults.add(
            catalogue.EXPECTED_NUMBER, cursor.peek().span, "found ','; a number stands before and after each comma"
        )
        cursor.doubtful = True
    while cursor.peek().kind == ",":
        comma = cursor.next()
        if wanted == 1:
            cursor.faults.superfluous(comma, "a keyword is followed by its value, with nothing between them")
    return omitted


def _is_argument(cursor: Cursor, entry: Statement | None, block: Block | None) -> bool:
    """Whether a word here is an argument, not a keyword that is written in another way."""
    token = cursor.peek()
    if token.kind == "{":
        return is_bracketed(cursor)
    if token.kind == "string":
        return cursor.peek(1).text not in (":", "=")
    if token.kind != "word":
        return True
    if cursor.peek(1).kind in ("{", "="):
        return False
    near = certain(token.text, members(block))
    return not (near and (token.first or (entry is not None and entry.is_flag)))
