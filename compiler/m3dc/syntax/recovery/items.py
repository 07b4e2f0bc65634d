"""Items of the top level."""

from __future__ import annotations

from m3d_language.table import LANGUAGE

from ...diagnostics import catalogue
from ...diagnostics.spelling import certain, meant_type, nearest
from ...diagnostics.words import CAPITALS, members, place_of
from .. import ast
from . import skip, wording
from .blocks import read_assignment, read_keyword_member, read_word_member
from .cursor import Cursor
from .misplaced import pass_misplaced
from .stray import pass_stray_brace
from .variables import read_variables

_CHANGES = frozenset(["++", "--", "+=", "-=", "*=", "/="])


def read_item(cursor: Cursor) -> ast.Item | None:
    token = cursor.peek()
    match token.kind:
        case "keyword" if token.text == "VARIABLES":
            return read_variables(cursor)
        case "keyword" if _is_declaration(cursor):
            return _declared_outside(cursor)
        case "keyword":
            return read_keyword_member(cursor, None)
        case "word":
            return _word(cursor)
        case "}":
            pass_stray_brace(cursor)
            return None
        case _:
            pass_misplaced(cursor, None)
            return None


def _word(cursor: Cursor) -> ast.Item | None:
    word, after = cursor.peek(), cursor.peek(1)
    if cursor.hyphen_follows(1):
        word = cursor.hyphened()
        cursor.faults.add(catalogue.INVALID_NAME, word.span, f"found {word.text!r}; {wording.LETTERS}")
        skip.group(cursor) if cursor.peek().kind == "{" else skip.lines(cursor)
        cursor.doubtful = True
        return None
    if after.kind == "=" or (after.text == ":" and cursor.peek(2).kind == "="):
        return read_assignment(cursor)
    opens = after.kind == "{" or (after.kind == "word" and cursor.peek(2).kind == "{")
    known = certain(word.text, LANGUAGE.keywords)
    if opens or (known == word.text.upper() and known in members(None)):
        return read_word_member(cursor, None)
    if after.kind in ("number", "<"):
        return read_assignment(cursor)
    if after.text == ":" and cursor.peek(2).kind in ("number", "<", "word"):
        return read_assignment(cursor)
    if after.text in _CHANGES or (after.text in ("+", "-") and cursor.peek(2).text == after.text):
        return _changed(cursor)
    if after.kind == "word" and cursor.peek(2).kind in ("=", ";", ",") and not after.first:
        return _declared_outside(cursor)
    cursor.next()
    near = nearest(word.text, members(None))
    says = LANGUAGE.elsewhere.get(word.text.lower())
    if says is None and word.text.upper() in LANGUAGE.keywords:
        says = f"{place_of(word.text.upper(), ())}; {CAPITALS}"
    says = says or (f"did you mean {near}?" if near else f"a file holds {wording.TOP_LEVEL}")
    cursor.faults.add(catalogue.INVALID_AT_TOP, word.span, f"found {word.text!r}; {says}")
    skip.lines(cursor)
    cursor.doubtful = True
    return None


def _changed(cursor: Cursor) -> None:
    """`size += 1`, `size++`."""
    name = cursor.next()
    cursor.next()
    while not cursor.peek().first and cursor.peek().kind not in ("end", "}", ";"):
        cursor.next()
    span = (name.start, cursor.before)
    text = cursor.data[span[0] : span[1]].decode("utf-8", "replace")
    cursor.faults.add(catalogue.NO_EXPRESSIONS, span, f"found {text!r}; write the result: {name.text} = ..")
    if cursor.peek().kind == ";":
        cursor.next()
    cursor.doubtful = True
    cursor.names.add(name.text)


def _is_declaration(cursor: Cursor) -> bool:
    """Whether a type at the top level begins a declaration: `NUMBER size = 2`, `SPHERE ball;`."""
    if cursor.peek().text not in LANGUAGE.types or cursor.peek(1).kind != "word":
        return False
    after = cursor.peek(2)
    basic = cursor.peek().text in LANGUAGE.basics
    return (after.kind in ("=", ";", ",") and not cursor.peek(1).first) or (basic and after.kind != "{")


def _declared_outside(cursor: Cursor) -> None:
    first = cursor.next()
    name = cursor.next()
    cursor.names.add(name.text)
    type_ = (
        first.text
        if first.text in LANGUAGE.types
        else meant_type(first.text) or nearest(first.text, LANGUAGE.types) or "NUMBER"
    )
    says = f"variables are declared in VARIABLES {{ {type_} {name.text}; }} and assigned to after it"
    cursor.faults.add(
        catalogue.INVALID_AT_TOP, first.span, f"{wording.found(first)}; {says}", kind="declaration outside"
    )
    cursor.doubtful = True
    while (token := cursor.peek()).kind not in ("end", "}"):
        if token.kind == ";":
            cursor.next()
            break
        if token.first or token.text in members(None):
            break
        cursor.next() if token.kind != "{" else skip.group(cursor)
