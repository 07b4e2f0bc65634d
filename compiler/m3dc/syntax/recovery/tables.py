"""Tables of numbers."""

from __future__ import annotations

import re

from m3d_language.table import Block

from ...diagnostics import catalogue
from ...diagnostics.words import members
from ...text.span import Span
from .. import ast
from . import skip, wording
from .cursor import Cursor
from .lexer import CLOSERS, Token, comment_end
from .misplaced import pass_misplaced
from .nesting import close_block, end_unclosed, open_block
from .values import read_value, starts_value

_BULK = re.compile(rb"[0-9eE+\-.<>,\s]*")


def read_table(cursor: Cursor, keyword: ast.Keyword, token: Token, block: Block | None) -> ast.Table | None:
    """The table whose keyword has been passed; None where no brace opens it."""
    if cursor.peek().kind != "{":
        if not open_block(cursor, token):
            skip.values(cursor)
            return None
    else:
        cursor.open.append(cursor.next())
    bulk = _bulk(cursor)
    if bulk is not None:
        if cursor.peek().kind == "}":
            close_block(cursor)
        else:
            end_unclosed(cursor, cursor.peek())
        return ast.Table(keyword, cursor.relative(bulk), (), cursor.since(token))
    entries: list[ast.Argument] = []
    while (next_ := cursor.peek()).kind not in ("}", "end") and not cursor.ends_all(next_):
        if next_.kind == "keyword" or (next_.kind == "word" and cursor.peek(1).kind in ("{", "=")):
            if next_.kind != "keyword" or next_.text in members(block) or not _is_closed(cursor):
                break
            says = f"{wording.found(next_)}; a table holds numbers and vectors"
            cursor.faults.add(catalogue.EXPECTED_NUMBER, next_.span, says, kind="table words")
            cursor.doubtful = True
            while cursor.peek().kind != "}":
                cursor.next()
            break
        if starts_value(cursor) and next_.kind != "{":
            value = read_value(cursor, None, table=True)
            entries += [value] if value is not None else []
        elif next_.kind in CLOSERS or next_.text in CLOSERS or next_.text in CLOSERS.values():
            says = f"{wording.found(next_)}; a table holds numbers and vectors, without braces between them"
            cursor.faults.add(catalogue.EXPECTED_NUMBER, next_.span, says, kind="table braces")
            cursor.doubtful = True
            cursor.next()
            if next_.kind == "{":
                _flatten(cursor, entries)
        elif next_.kind == ",":
            cursor.faults.superfluous(cursor.next(), "the numbers of a table are separated by blanks")
        else:
            pass_misplaced(cursor, block)
    if cursor.peek().kind == "}":
        close_block(cursor)
    else:
        end_unclosed(cursor, cursor.peek())
    return ast.Table(keyword, None, tuple(entries), cursor.since(token))


def _is_closed(cursor: Cursor) -> bool:
    """Whether the table goes on to a closing brace of its own: none opens before."""
    lexer = cursor.look(cursor.peek().start)
    while (token := lexer.next()).kind not in ("end", "{"):
        if token.kind == "}":
            return True
    return False


def _flatten(cursor: Cursor, entries: list[ast.Argument]) -> None:
    """The values in braces within a table."""
    while (token := cursor.peek()).kind not in ("}", "end", "keyword", "{"):
        value = read_value(cursor, None, table=True) if starts_value(cursor) else None
        if value is not None:
            entries.append(value)
        elif cursor.peek() is token:
            cursor.next()
    if cursor.peek().kind == "}":
        cursor.next()


def _bulk(cursor: Cursor) -> Span | None:
    """Where the numbers of a table stand, if there is nothing else in its braces but comments; passed then."""
    start = cursor.peek().start
    at, end = start, start
    limit = cursor.lexer.closed[0] if cursor.lexer.closed else cursor.lexer.end
    while True:
        match = _BULK.match(cursor.data, at)
        at = match.end() if match else at
        stripped = len(cursor.data[start:at].rstrip()) + start
        end = max(end, stripped) if match and match[0].strip() else end
        comment = comment_end(cursor.data, at) if cursor.data.startswith(b"/*", at) else None
        if comment is None:
            break
        at = comment
    closes = cursor.data[at : at + 1] == b"}" and at not in cursor.lexer.ignored
    if not closes or at > limit or not any(0x30 <= byte <= 0x39 for byte in cursor.data[start:end][:1000]):
        return None
    cursor.jump(end)
    return start, end
