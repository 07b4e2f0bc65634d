"""Blocks and what stands in them: statements, tables, blocks; and assignments, whose value may be a block."""

from __future__ import annotations

import re

from m3d_language.table import LANGUAGE, Block, Statement

from ...diagnostics import catalogue
from ...diagnostics.spelling import certain, nearest
from ...diagnostics.words import CAPITALS, members, place_of, statement_of, takes
from .. import ast, numerals
from . import skip, wording
from .arguments import read_arguments
from .calculation import colour_of
from .cursor import Cursor
from .lexer import Token
from .misplaced import is_tag, pass_misplaced, pass_quoted, pass_tag
from .nesting import close_block, end_unclosed, open_block, pass_too_deep
from .tables import read_table
from .values import HEX_COLOUR, is_bracketed, read_value, report_bare_vector, starts_value
from .variables import read_variables

_TABLES = frozenset(keyword for block in LANGUAGE.blocks.values() for keyword in block.tables)
_STATEMENTS = {keyword: entry for block in LANGUAGE.blocks.values() for keyword, entry in block.statements.items()}
_NUMBERS = re.compile(r"(?:[-+0-9.eE]+(?:, *)?)+")
_GLUED = re.compile(r"([A-Za-z]+)([0-9]+)")


def _body(cursor: Cursor, keyword: Token, block: Block | None) -> ast.Body | None:
    """The body of a block: its opening brace is the next token, or missing."""
    start = cursor.peek().start
    if not open_block(cursor, keyword, variable=block is not None and block.variable):
        skip.values(cursor)
        return None
    if len(cursor.open) > ast.DEEPEST + 1:
        pass_too_deep(cursor, keyword)
        return None
    cursor.around.append(block.keyword if block else "")
    items: list[ast.Item] = []
    while True:
        token = cursor.peek()
        if token.kind == "}":
            close_block(cursor)
            break
        if token.kind == "end" or cursor.ends_all(token):
            end_unclosed(cursor, token)
            break
        item = _member(cursor, block)
        items += [item] if item is not None else []
    cursor.around.pop()
    return ast.Body(tuple(items), cursor.relative((start, max(cursor.before, start))))


def _member(cursor: Cursor, block: Block | None) -> ast.Item | None:
    token = cursor.peek()
    if token.kind == "keyword" and (token.text in LANGUAGE.top or token.text == "VARIABLES"):
        cursor.nested_top = True
        inner = "" if block is None or not block.holds else f"; {block.keyword} holds {wording.some(block.holds)}"
        cursor.faults.invalid(block, token.span, f"{place_of(token.text, cursor.around)}{inner}")
        cursor.doubtful = True
        cursor.next()
        while cursor.peek().kind == "word":
            cursor.next()
        if cursor.peek().kind == "{":
            skip.group(cursor)
        return None
    if token.kind == "keyword":
        outer = LANGUAGE.blocks.get(cursor.around[-2]) if len(cursor.around) > 1 else None
        misfit = block is not None and outer is not None and token.text not in members(block)
        if misfit and cursor.misfit is None and outer is not None and token.text in members(outer):
            cursor.misfit = cursor.before
        return read_keyword_member(cursor, block)
    if token.kind == "word" and cursor.peek(1).kind == "=":
        near = certain(token.text, members(block))
        if near is None or near in LANGUAGE.blocks:
            cursor.nested_top = True
            cursor.faults.invalid(block, token.span, "variables are assigned to outside of all blocks")
            read_assignment(cursor)
            cursor.doubtful = True
            return None
    if token.kind == "word":
        return read_word_member(cursor, block)
    if token.kind == "string" and cursor.peek(1).text in (":", "="):
        return _quoted_key(cursor, block)
    if is_tag(cursor):
        pass_tag(cursor, block)
        return None
    if token.kind == "<" or token.kind == "number":
        holds = f": {block.keyword} holds {wording.some(block.members())}" if block is not None else ""
        cursor.faults.invalid(
            block, token.span, f"{wording.found(token)}; a value stands after its keyword{holds}", kind="value"
        )
        cursor.doubtful = True
        skip.values(cursor)
        return None
    pass_misplaced(cursor, block)
    return None


def read_keyword_member(
    cursor: Cursor, block: Block | None, word: Token | None = None, keyword: str = ""
) -> ast.Item | None:
    """A block, statement or table; its keyword is the next token, or meant by a `word` that has been passed."""
    token = word or cursor.next()
    keyword = keyword or token.text
    if keyword == "VARIABLES" and not cursor.around:
        return read_variables(cursor, token)
    known = ast.Keyword(keyword, cursor.relative(token.span))
    entry = (block.statements.get(keyword) if block else None) or _STATEMENTS.get(keyword)
    inner = LANGUAGE.blocks.get(keyword)
    if not (inner is not None and entry is None and cursor.peek().text == ":" and cursor.peek(1).first):
        cursor.superfluous_marks()
    if keyword in _TABLES:
        return read_table(cursor, known, token, block)
    if cursor.peek().kind in ("string", "name") and inner is not None:
        pass_quoted(cursor, cursor.next(), block)
    after = cursor.peek()
    if inner is not None and (after.kind == "{" or entry is None):
        if inner.variable and after.kind == "word" and _is_source(cursor, after):
            name = ast.Name(cursor.next().text, cursor.relative(after.span))
            cursor.check_length(name)
            if cursor.peek().kind != "{":
                return ast.Block(known, name, None, cursor.since(token))
            return ast.Block(known, name, _body(cursor, token, inner), cursor.since(token))
        body = _body(cursor, token, inner)
        return None if body is None else ast.Block(known, None, body, cursor.since(token))
    if inner is None and entry is None and keyword in LANGUAGE.keywords - set(LANGUAGE.types):
        entry = None
    return ast.Statement(known, read_arguments(cursor, entry, block, keyword), cursor.since(token))


def _quoted_key(cursor: Cursor, block: Block | None) -> ast.Item | None:
    """`"RADIUS": 2`, as in JSON."""
    word, mark = cursor.next(), cursor.next()
    inner = word.text[1:-1].strip()
    meant = certain(inner, members(block))
    if meant is None:
        says = LANGUAGE.elsewhere.get(inner.lower()) or "keywords stand without quotes and colons"
        cursor.faults.invalid(block, word.span, f"{wording.found(word)}; {says}")
        cursor.doubtful = True
        skip.unknown(cursor)
        return None
    edits = [((word.start, mark.end), meant)]
    says = f"{wording.found(word)}; keywords stand without quotes, and nothing stands between them and what follows"
    cursor.faults.invalid(block, word.span, says, edits=edits, title=f"Write {meant}", kind="quoted keyword")
    return read_keyword_member(cursor, block, word, meant)


def _is_source(cursor: Cursor, word: Token) -> bool:
    """Whether a word after a block's keyword is the variable that the block copies."""
    after = cursor.peek(1)
    if after.kind == "{":
        return True
    return after.kind != "=" and not (word.first and word.text.upper() in LANGUAGE.keywords)


def read_word_member(cursor: Cursor, block: Block | None) -> ast.Item | None:
    """What begins with a word that is no keyword: what is meant by it, if that can be told."""
    word = cursor.hyphened()
    glued = _GLUED.fullmatch(word.text)
    if glued and block is not None and glued[1].upper() in block.statements and word.text not in members(block):
        meant = glued[1].upper()
        at = word.start + len(meant)
        detail = f"{wording.found(word)}; a blank stands between a keyword and its value"
        new = f"{meant} {glued[2]}"
        cursor.faults.invalid(block, word.span, detail, edits=[(word.span, new)], title=f"Write {new}")
        cursor.jump(at)
        return read_keyword_member(cursor, block, word._replace(end=at, text=meant), meant)
    fits = [keyword for keyword in members(block) if _fits(cursor, keyword, block)]
    spelt = word.text.upper()
    meant = certain(word.text, fits)
    entry = catalogue.INVALID_IN_BLOCK if block is not None else catalogue.INVALID_AT_TOP
    fill = statement_of(block.keyword) if block is not None else ""
    if block is None and cursor.around and spelt in LANGUAGE.keywords:
        # What holds this block is not known, because the variable is not declared: its words are.
        meant, cursor.doubtful = spelt, True
    if meant is not None and block is not None and meant in block.statements and cursor.peek().text == "(":
        _call(cursor, block, word, block.statements[meant])
        return None
    if meant is not None:
        capitals = meant == spelt
        says = f"did you mean {meant}?" + (f" {CAPITALS}" if capitals else "")
        title = f"Replace with {meant}" if not capitals else f"Write {meant}"
        kind = "capitals" if capitals else None
        edits = [(word.span, meant)]
        cursor.faults.add(
            entry, word.span, f"{wording.found(word)}; {says}", fill=fill, edits=edits, title=title, kind=kind
        )
        return read_keyword_member(cursor, block, word, meant)
    cursor.doubtful = True
    near = nearest(word.text, fits) if "-" not in word.text else None
    unfit = certain(word.text, block.statements) if block is not None else None
    if unfit is not None and block is not None:
        _unfit(cursor, block, word, block.statements[unfit])
        return None
    if spelt in LANGUAGE.keywords:
        says = f"{place_of(spelt, cursor.around)}; {CAPITALS}"
    elif near is not None and word.text.lower() not in LANGUAGE.elsewhere:
        says = f"did you mean {near}?"
    else:
        says = _unknown(cursor, word, block)
    cursor.faults.add(entry, word.span, f"{wording.found(word)}; {says}", fill=fill)
    if near is not None and spelt not in LANGUAGE.keywords and word.text.lower() not in LANGUAGE.elsewhere:
        return read_keyword_member(cursor, block, word, near)
    skip.unknown(cursor)
    return None


def _unfit(cursor: Cursor, block: Block, word: Token, entry: Statement) -> None:
    """A statement in small letters or misspelt, before what it does not take."""
    says = f"{wording.found(word)}; did you mean {entry.keyword}? It {takes(entry)}"
    value = cursor.peek()
    edits = None
    if value.kind == "number" and not entry.is_flag and entry.arguments[0].name == "color":
        edits = [((word.start, value.end), f"{entry.keyword} < {value.text}, {value.text}, {value.text} >")]
    title = f"Write {edits[0][1]}" if edits else ""
    cursor.faults.add(
        catalogue.INVALID_IN_BLOCK,
        word.span,
        says,
        fill=statement_of(block.keyword),
        edits=edits,
        title=title,
        sure=False,
    )
    skip.unknown(cursor)


def _call(cursor: Cursor, block: Block, word: Token, entry: Statement) -> None:
    """A statement written as a call: `color("red")`, `radius(2)`."""
    opener = cursor.peek()
    skip.all_brackets(cursor)
    value = _argument_of_call(cursor.data[opener.end : cursor.before - 1].decode("utf-8", "replace"), entry)
    says = f"{wording.found(word)}; a statement is a keyword and what it takes, without brackets"
    span = (word.start, cursor.before)
    edits = [(span, f"{entry.keyword} {value}")] if value else None
    title = f"Write {entry.keyword} {value}"
    cursor.faults.invalid(block, word.span, says, edits=edits, title=title)
    cursor.doubtful = True
    if cursor.peek().kind == ";":
        cursor.next()


def _argument_of_call(text: str, entry: Statement) -> str | None:
    """What stands in the brackets of a call, as the statement takes it; None where that is not plain."""
    inner = text.strip().strip("\"'[]").strip()
    if entry.is_flag:
        return None
    if entry.arguments[0].shape == "vector":
        if inner.startswith("#"):
            return colour_of(inner) if HEX_COLOUR.fullmatch(inner) else None
        vector = f"< {inner} >" if _NUMBERS.fullmatch(inner) and inner.count(",") == 2 else None
        return LANGUAGE.colours.get(inner.lower()) or vector
    return inner if _NUMBERS.fullmatch(inner) and inner.count(",") == len(entry.arguments) - 1 else None


def _unknown(cursor: Cursor, word: Token, block: Block | None) -> str:
    """What to say of a word that looks like no keyword that could stand there."""
    says = LANGUAGE.elsewhere.get(word.text.lower())
    if says is not None:
        return says
    if word.text in numerals.UNITS and not word.first:
        return numerals.UNITS_SAY
    elsewhere = certain(word.text, LANGUAGE.keywords) or nearest(word.text, LANGUAGE.keywords)
    if elsewhere is not None and LANGUAGE.parents.get(elsewhere):
        return place_of(elsewhere, cursor.around)
    if block is None and cursor.around:
        return f"no statement is called that; {CAPITALS}"
    if block is None:
        return f"a file holds {wording.TOP_LEVEL}; {CAPITALS}"
    return f"a {block.keyword} holds {wording.some(block.members())}; {CAPITALS}"


def _fits(cursor: Cursor, keyword: str, block: Block | None) -> bool:
    """Whether what comes next can follow a keyword of a block."""
    after = cursor.peek()
    inner = LANGUAGE.blocks.get(keyword)
    entry = None if block is None else block.statements.get(keyword)
    if after.text in ("=", ":"):
        after = cursor.peek(1)
    if after.kind == "{":
        return inner is not None or keyword in _TABLES or keyword == "VARIABLES"
    vector = entry is not None and not entry.is_flag and entry.arguments[0].shape == "vector"
    if after.kind == "<":
        return vector
    if after.kind == "number":
        return entry is not None and not entry.is_flag and not vector
    return keyword not in _TABLES


def read_assignment(cursor: Cursor) -> ast.Assignment | None:
    target = cursor.next()
    if cursor.peek().text == ":":
        colon = cursor.next()
        equals = cursor.peek()
        if equals.kind == "=":
            cursor.faults.superfluous(colon, "an assignment is written with = alone")
            cursor.next()
        else:
            edits = [(colon.span, " =")]
            cursor.faults.add(catalogue.MISSING_MARK, colon.span, "found ':'", fill="=", edits=edits, title="Write '='")
    elif cursor.peek().kind == "=":
        cursor.next()
    elif cursor.peek().kind in ("number", "<"):
        cursor.missing("=")
    while cursor.peek().kind == "=" and not cursor.peek().gap:
        cursor.faults.superfluous(cursor.next(), "an assignment is written with one =")
    name = ast.Name(target.text, cursor.relative(target.span))
    value: ast.Argument | None = None
    body: ast.Body | None = None
    token = cursor.peek()
    if token.kind == "keyword" and token.text in LANGUAGE.types and cursor.peek(1).kind == "{":
        edits = [((token.start, cursor.peek(1).start), "")]
        detail = f"{wording.found(token)}; the variable's type is known, its block stands alone"
        cursor.faults.add(catalogue.SUPERFLUOUS, token.span, detail, fill=token.text, edits=edits, title="Remove it")
        cursor.next()
        body = _body(cursor, token, LANGUAGE.blocks.get(token.text))
    elif token.kind == "{" and not is_bracketed(cursor):
        body = _body(cursor, target, _type_of(cursor, target))
    elif starts_value(cursor) and not (token.kind == "word" and token.first and cursor.peek(1).kind == "="):
        value = read_value(cursor, None)
        if isinstance(value, ast.Name) and cursor.peek().kind == "{":
            body = _body(cursor, target, _type_of(cursor, target))
        elif cursor.peek().kind in (",", "number") and isinstance(value, ast.Number):
            report_bare_vector(cursor, token)
            value = None
    else:
        says = f"{wording.found(token)}; a vector < x, y, z > or a block could stand here too"
        cursor.faults.add(catalogue.EXPECTED_NUMBER, cursor.place(token), says)
        cursor.doubtful = True
    if value is None and body is None:
        cursor.doubtful = True
        cursor.names.add(target.text)
        return None
    return ast.Assignment(name, value, body, cursor.since(target))


def _type_of(cursor: Cursor, variable: Token) -> Block | None:
    """The block that a variable holds, if it has been declared with such a type."""
    return LANGUAGE.blocks.get(cursor.types.get(variable.text, "").upper())
