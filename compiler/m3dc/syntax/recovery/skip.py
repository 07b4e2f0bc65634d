"""Passing over what cannot be used: each function passes it, and reads none of it."""

from __future__ import annotations

from m3d_language.table import LANGUAGE

from ...diagnostics.spelling import certain
from ...diagnostics.words import members
from . import wording
from .cursor import Cursor, indent
from .lexer import CLOSERS, Token


def lines(cursor: Cursor) -> None:
    """Pass what belongs to something unknown: up to a line that begins an item."""
    while (token := cursor.peek()).kind not in ("end", "}"):
        begins = token.kind == "keyword" or (token.kind == "word" and cursor.peek(1).kind in ("=", "{"))
        if (token.first and begins) or (token.kind == "keyword" and token.text in members(None)):
            return
        cursor.next() if token.kind != "{" else group(cursor)


def indented(cursor: Cursor, keyword: Token) -> None:
    """Pass what belongs to a block without braces: at the top level all up to the next item, elsewhere the lines
    that are indented more than the keyword's."""
    margin = indent(cursor.data, keyword.start)
    while (token := cursor.peek()).kind not in ("end", "}"):
        item = token.text in members(None) or (token.kind == "word" and cursor.peek(1).kind == "=")
        if token.first and (item if not cursor.open else indent(cursor.data, token.start) <= margin):
            return
        cursor.next() if token.kind != "{" else group(cursor)


def declaration(cursor: Cursor) -> None:
    """Pass the rest of a declaration, with its semicolon."""
    while (token := cursor.peek()).kind not in ("end", "}", ";"):
        if token.first and token.kind in ("keyword", "word"):
            return
        cursor.next() if token.kind != "{" else group(cursor)
    if token.kind == ";":
        cursor.next()


def unknown(cursor: Cursor) -> None:
    """Pass what follows an unknown word: a block, or the rest of a statement."""
    while True:
        token = cursor.peek()
        if token.kind == "{":
            group(cursor)
            token = cursor.peek()
            if token.kind != ";":
                return
        if token.kind == ";":
            cursor.next()
            return
        if token.kind in ("}", "end", "keyword") or cursor.ends_all(token):
            return
        if token.first and token.kind not in ("<", "number", ","):
            return
        if token.kind == "word" and certain(token.text, LANGUAGE.keywords):
            return
        cursor.next()


def group(cursor: Cursor) -> None:
    """Pass braces and all that is between them, or, where they are not closed, what belongs to the item."""
    depth = 0
    first = cursor.peek()
    while True:
        token = cursor.peek()
        if token.kind == "end" or (depth and cursor.ends_all(token) and token.kind == "keyword"):
            if depth and not cursor.cut:
                cursor.report_unclosed(first, cursor.before, wording.found(token))
            return
        cursor.next()
        depth += (token.kind == "{") - (token.kind == "}")
        if depth == 0:
            return


def brackets(cursor: Cursor) -> None:
    """Pass brackets with all that is in them."""
    depth = 0
    while (token := cursor.peek()).kind not in ("end", "{", "}", "keyword"):
        cursor.next()
        depth += (token.text in ("(", "[")) - (token.text in (")", "]"))
        if depth <= 0:
            return


def all_brackets(cursor: Cursor) -> None:
    """Pass brackets with all that is in them, whatever it is; where they are not closed, the rest of the line."""
    lexer = cursor.look(cursor.peek().start)
    open_ = ""
    while (token := lexer.next()).kind != "end" and not (token.first and token.text in members(None)):
        if token.text in CLOSERS:
            open_ += token.text
        elif token.text in CLOSERS.values():
            if CLOSERS[open_[-1]] != token.text:
                break
            open_ = open_[:-1]
        if not open_:
            while cursor.peek().start <= token.start:
                cursor.next()
            return
    cursor.next()
    while not cursor.peek().first and cursor.peek().kind not in ("end", "}"):
        cursor.next()


def values(cursor: Cursor) -> None:
    """Pass values and what is between them."""
    while (token := cursor.peek()).kind in ("number", "<", ",", ">"):
        vector(cursor) if token.kind == "<" else cursor.next()


def vector(cursor: Cursor) -> None:
    """Pass a vector, as far as it is one."""
    cursor.next()
    while cursor.peek().kind in ("number", "word", ","):
        cursor.next()
    if cursor.peek().kind == ">":
        cursor.next()


def rest_of_vector(cursor: Cursor) -> None:
    """Pass what is left of a vector."""
    while (token := cursor.peek()).kind not in (">", "}", "{", "keyword", "end", "<") and not cursor.ends_all(token):
        cursor.next()
    if token.kind == ">":
        cursor.next()
