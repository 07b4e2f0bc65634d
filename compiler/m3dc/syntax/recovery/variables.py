"""VARIABLES blocks and their declarations."""

from __future__ import annotations

from m3d_language.table import LANGUAGE

from ...diagnostics import catalogue
from .. import ast
from . import skip, wording
from .cursor import Cursor
from .lexer import Token
from .misplaced import pass_misplaced
from .nesting import close_block, end_unclosed, open_block


def read_variables(cursor: Cursor, word: Token | None = None) -> ast.Variables:
    """A VARIABLES block; its keyword is the next token, or meant by a `word` that has been passed."""
    keyword = word or cursor.next()
    known = ast.Keyword("VARIABLES", cursor.relative(keyword.span))
    cursor.superfluous_marks()
    declarations: list[ast.Declaration] = []
    opened = open_block(cursor, keyword)
    while opened:
        token = cursor.peek()
        if token.kind == "}":
            close_block(cursor)
            break
        if token.kind == "end" or _ends_declarations(cursor, token):
            end_unclosed(cursor, token)
            break
        if token.kind in ("keyword", "word"):
            declaration = _declaration(cursor)
            declarations += [declaration] if declaration else []
        else:
            pass_misplaced(cursor, None, catalogue.INVALID_TYPE)
    for declaration in declarations:
        cursor.types |= {name.text: declaration.type.text for name in declaration.names}
    return ast.Variables(known, tuple(declarations), cursor.since(keyword))


def _ends_declarations(cursor: Cursor, token: Token) -> bool:
    """Whether a token begins an item of the top level, as one can tell where a VARIABLES block is not closed."""
    if not token.first or not cursor.is_outside(token):
        return False
    if token.text in ("SCENE", "VARIABLES"):
        return True
    after = cursor.peek(1)
    if token.text in LANGUAGE.top:
        return after.kind == "{" or (after.kind == "word" and cursor.peek(2).kind not in (";", ",", "="))
    return token.kind == "word" and after.kind == "="


def _declaration(cursor: Cursor) -> ast.Declaration | None:
    first = cursor.next()
    after = cursor.peek()
    type_: ast.Keyword | ast.Name = (
        cursor.keyword(first) if first.kind == "keyword" else ast.Name(first.text, cursor.relative(first.span))
    )
    if after.text == ":" and cursor.peek(1).kind == "keyword" and first.kind == "word":
        cursor.next()
        kind = cursor.next()
        edits = [((first.start, kind.end), f"{kind.text} {first.text}")]
        cursor.faults.add(
            catalogue.INVALID_TYPE,
            first.span,
            "the type comes first",
            edits=edits,
            title="Put the type first",
            kind="type first",
        )
        _declaration_end(cursor)
        return ast.Declaration(
            cursor.keyword(kind), (ast.Name(first.text, cursor.relative(first.span)),), cursor.since(first)
        )
    if first.kind == "word" and after.kind not in ("word", "keyword", "name", "number"):
        cursor.names.add(first.text)
        detail = f"found {first.text!r}; a declaration is a type and a name, such as NUMBER {first.text};"
        if after.kind == "=":
            detail = f"{first.text} is assigned a value here; that is done outside VARIABLES"
        cursor.faults.add(catalogue.INVALID_TYPE, first.span, detail, kind="no type")
        skip.declaration(cursor)
        return None
    if first.kind == "word" and after.kind == "keyword" and not after.first and cursor.peek(1).kind == "word":
        detail = f"found {first.text!r}; a declaration is a type and a name, such as {after.text} size;"
        edits = [((first.start, after.start), "")]
        cursor.faults.add(
            catalogue.INVALID_TYPE, first.span, detail, edits=edits, title="Remove it", kind="before a type", sure=False
        )
        first = cursor.next()
        type_ = cursor.keyword(first)
    names: list[ast.Name] = []
    while True:
        name = cursor.peek()
        if name.kind != "word":
            _no_name(cursor, name)
            break
        if cursor.hyphen_follows(1):
            name = cursor.hyphened()
            cursor.faults.add(catalogue.INVALID_NAME, name.span, f"found {name.text!r}; {wording.LETTERS}")
            cursor.names.add(name.text)
            skip.declaration(cursor)
            break
        names.append(ast.Name(cursor.next().text, cursor.relative(name.span)))
        cursor.check_length(names[-1])
        if cursor.peek().kind == ",":
            cursor.next()
        elif cursor.peek().kind == "word" and not cursor.peek().first and cursor.peek(1).kind in (",", ";", "word"):
            cursor.missing(",")
        else:
            _declaration_end(cursor)
            break
    return ast.Declaration(type_, tuple(names), cursor.since(first))


def _no_name(cursor: Cursor, token: Token) -> None:
    cursor.faults.add(
        catalogue.INVALID_NAME, token.span, f"{wording.found(token)}; a name starts with a letter and is not a keyword"
    )
    cursor.doubtful = True
    if token.kind not in ("}", "end", ";") and not (token.first and token.kind == "keyword"):
        cursor.next()
        if token.kind in ("name", "number", "keyword") and cursor.peek().kind != ";":
            skip.declaration(cursor)
    if cursor.peek().kind == ";":
        cursor.next()


def _declaration_end(cursor: Cursor) -> None:
    """The semicolon after a declaration, or what stands there in its place."""
    token = cursor.peek()
    if token.kind == ";":
        cursor.next()
        return
    value = token.kind == "=" or token.text == ":"
    if not value and (token.first or token.kind in ("}", "end", "keyword")):
        cursor.missing(";")
        return
    detail = wording.found(token)
    if value or token.kind in ("<", "number"):
        detail += "; a variable is assigned to outside VARIABLES, after it"
    name = cursor.data[: cursor.before].rsplit(None, 1)[-1] if cursor.before < 300 else _last_word(cursor)
    cursor.names.add(name.decode("utf-8", "replace").rsplit(",", 1)[-1])
    cursor.faults.add(catalogue.MISSING_MARK, token.span, detail, fill=";", kind="value")
    skip.declaration(cursor)


def _last_word(cursor: Cursor) -> bytes:
    return cursor.data[cursor.before - 300 : cursor.before].rsplit(None, 1)[-1]
