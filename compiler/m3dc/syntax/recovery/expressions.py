"""Expressions, which the language does not have: each is reported as a whole, with its result if that is constant."""

from __future__ import annotations

from ...diagnostics import catalogue
from . import skip
from .calculation import calculated
from .cursor import Cursor
from .lexer import CLOSERS, Token

OPERATORS = frozenset([*"+-*/^%", "**"])
PARTS = frozenset(["(", "[", ".", "::"])  # what follows a name that something is made or taken of


def operand_follows(cursor: Cursor, ahead: int) -> bool:
    token = cursor.peek(ahead)
    return token.kind in ("number", "word", "<") or token.text in ("(", "-", "+")


def pass_part(cursor: Cursor) -> None:
    """Pass what follows a name in `f(x)`, `a[0]`, `a.x` and `a::b`."""
    while (token := cursor.peek()).text in PARTS and not token.gap:
        if token.text in CLOSERS:
            skip.brackets(cursor)
            continue
        cursor.next()
        if cursor.peek().kind in ("word", "keyword", "number") and not cursor.peek().gap:
            cursor.next()


def report_expression(cursor: Cursor, first: Token) -> None:
    """The rest of an expression: reported as one."""
    while True:
        token = cursor.peek()
        if token.kind == "number" and token.text[0] in "+-":
            cursor.next()
        elif token.text in OPERATORS and token.kind == "other" and operand_follows(cursor, 1):
            cursor.next()
            while cursor.peek().text in ("-", "+"):
                cursor.next()
            operand = cursor.peek()
            if operand.text in ("(", "["):
                skip.brackets(cursor)
            elif operand.kind == "<":
                skip.vector(cursor)
            else:
                cursor.next()
                if cursor.peek().text == "(" and operand.kind == "word":
                    skip.brackets(cursor)
        else:
            break
    span = (first.start, cursor.before)
    text = cursor.data[span[0] : span[1]]
    result = calculated(text)
    says = f"found {text.decode('utf-8', 'replace')!r}; write "
    says += f"its result, {result}" if result else "its result, or the name of a variable that has it"
    edits = [(span, result)] if result else None
    cursor.faults.add(catalogue.NO_EXPRESSIONS, span, says, edits=edits, title=f"Write {result}")
    cursor.doubtful = True


def report_percent(cursor: Cursor, number: Token, sign: Token) -> None:
    text = calculated(number.text.encode() + b"/100") if number.kind == "number" else None
    span = (number.start, sign.end)
    says = "found '%'; a proportion is a number between 0 and 1"
    cursor.invalid_here(sign.span, says, edits=[(span, text)] if text else None, title=f"Write {text}")
    cursor.doubtful = True
