"""What can stand nowhere in a scene, such as marks, texts in quotes and directives of other languages."""

from __future__ import annotations

from m3d_language.table import LANGUAGE, Block

from ...diagnostics import catalogue
from ...diagnostics.catalogue import Entry
from ...diagnostics.spelling import certain
from ...diagnostics.words import members
from . import skip, wording
from .cursor import Cursor
from .lexer import CLOSERS, Token

_GOES_ON = frozenset(["end", "endif", "else", "elif", "elseif", "break", "case", "range"])  # a directive before
_NO_SELECTOR = "a block begins with its keyword, and what a thing is called stands in a comment"


def pass_misplaced(cursor: Cursor, block: Block | None, entry: Entry | None = None) -> None:
    """Pass what can not stand here, and say so."""
    if is_tag(cursor):
        pass_tag(cursor, block)
        return
    token = cursor.next()
    after = cursor.peek()
    if (
        token.text in ("-", "+", "*", "\u2022")
        and after.kind in ("keyword", "word")
        and (token.first or not cursor.open)
    ):
        if cursor.peek(1).text == ":" and cursor.peek(2).first:
            cursor.next()
            says = f"found '{token.text} {after.text}:'; what belongs to a block stands between {{ and }}"
            cursor.faults.invalid(block, (token.start, cursor.next().end), says)
            cursor.doubtful = True
            skip.indented(cursor, token)
            return
        cursor.faults.superfluous(token, "statements follow one another without a mark before them", sure=False)
        return
    if token.text in (".", "$", "@", "\\") and after.kind in ("keyword", "word") and not after.gap:
        cursor.next()
        text = token.text + after.text
        meant = certain(after.text, members(block)) if token.text == "." else None
        if token.text == "\\" and after.text in ("begin", "end"):
            _environment(cursor, block, token)
            return
        says = LANGUAGE.elsewhere.get(text.lower())
        if says is None and meant is None and token.text in (".", "@") and _opens_block(cursor):
            says = _NO_SELECTOR
        says = f"found {text!r}; {says or wording.LETTERS}"
        says += f"; did you mean {meant}?" if meant else ""
        cursor.faults.invalid(block, (token.start, after.end), says)
        cursor.doubtful = True
        skip.unknown(cursor) if cursor.open else skip.lines(cursor)
        return
    if token.kind == ";":
        cursor.faults.superfluous(token, "nothing ends with a ; but a declaration in VARIABLES")
    elif token.kind == ",":
        cursor.faults.superfluous(token, "statements and blocks follow one another without a comma")
    elif token.text == "*/":
        detail = "this closes a comment that was never opened"
        cursor.faults.add(
            catalogue.UNBALANCED_COMMENT,
            token.span,
            detail,
            edits=[(token.span, "")],
            title="Remove it",
            kind="*/",
            sure=False,
        )
    elif token.kind == "hash":
        _directive(cursor, token)
    elif token.kind == "string":
        pass_quoted(cursor, token, block)
    else:
        says = wording.found(token)
        if token.kind == "{":
            says += "; a block begins with its keyword"
        elif token.kind in ("number", "<"):
            says += "; a value stands after its keyword"
        elif token.kind == "name":
            says += f"; {wording.LETTERS}"
        elif (number := wording.other_number(token.text)) is not None:
            says += f"; a number is written with the digits 0 to 9: {number}"
        elif token.text == "~":
            says += "; a blank stands between a keyword and its value"
        elif token.text == "-" and not cursor.open:
            says += "; a scene needs no marks between its parts"
        elif token.kind == "other" and token.text not in CLOSERS.values():
            says += "; it has no meaning in a scene: remove it"
        if entry is not None:
            cursor.faults.add(entry, token.span, says)
        else:
            cursor.faults.invalid(block, token.span, says)
        cursor.doubtful = True
        if token.kind == "{":
            cursor.push_back(token)
            skip.group(cursor)
        elif cursor.around and token.kind == "other":
            skip.unknown(cursor)
        elif not cursor.around and not cursor.open:
            skip.lines(cursor)


def _opens_block(cursor: Cursor) -> bool:
    """Whether a brace opens on the line, as after a selector of CSS."""
    token = cursor.peek()
    return token.kind == "{" and not token.first


def is_tag(cursor: Cursor) -> bool:
    """Whether a tag of HTML or XML comes next: `<sphere radius="1"/>`, `</solid>`, `<?xml ..?>`, `<!DOCTYPE ..>`."""
    token, after = cursor.peek(), cursor.peek(1)
    if token.kind != "<" or after.gap:
        return False
    if after.text in ("/", "!", "?"):
        return True
    then = cursor.peek(2)
    return after.kind in ("word", "keyword") and (then.kind in (">", "word", "keyword") or then.text in ("/", ":"))


def pass_tag(cursor: Cursor, block: Block | None) -> None:
    """Pass a tag, and those that follow it with what is between them."""
    start = cursor.peek().start
    word = cursor.peek(1).text
    _pass_one_tag(cursor)
    meant = certain(word, LANGUAGE.blocks)
    says = "a scene is written in blocks, not in tags" + (f": {meant} {{ .. }}" if meant else "")
    cursor.faults.invalid(block, (start, cursor.before), f"found a tag; {says}", kind="tag")
    cursor.doubtful = True
    while (token := cursor.peek()).kind not in ("end", "{", "}", "keyword"):
        if is_tag(cursor):
            _pass_one_tag(cursor)
        elif token.first and token.kind == "word" and cursor.peek(1).kind in ("=", "{"):
            return
        else:
            cursor.next()


def _pass_one_tag(cursor: Cursor) -> None:
    while cursor.peek().kind not in (">", "end", "{", "}"):
        cursor.next()
    if cursor.peek().kind == ">":
        cursor.next()


def _environment(cursor: Cursor, block: Block | None, start: Token) -> None:
    """`\\begin{solid} .. \\end{solid}` of LaTeX; its first word has been passed."""
    named = cursor.peek(1) if cursor.peek().kind == "{" and cursor.peek(1).kind in ("word", "keyword") else None
    meant = certain(named.text, LANGUAGE.blocks) if named is not None else None
    if cursor.peek().kind == "{":
        skip.group(cursor)
    says = f"a block is a keyword and braces: {meant or 'SOLID'} {{ .. }}"
    cursor.faults.invalid(block, (start.start, cursor.before), f"found an environment of LaTeX; {says}", kind="latex")
    cursor.doubtful = True
    lexer = cursor.look(cursor.peek().start)
    while (token := lexer.next()).kind != "end":
        if token.text == "\\" and lexer.next().text == "end":
            while cursor.peek().kind != "end" and cursor.peek().start < lexer.at:
                cursor.next()
            if cursor.peek().kind == "{":
                skip.group(cursor)
            return


def _directive(cursor: Cursor, token: Token) -> None:
    """`#declare name = value;` and its like."""
    word = token.text[1:].lower()
    if word in _GOES_ON and cursor.in_directive:
        return
    cursor.in_directive |= word not in _GOES_ON
    if word in ("declare", "local", "define", "let", "var", "const"):
        if cursor.peek().kind in ("word", "keyword"):
            name = cursor.next().text
            cursor.names.add(name)
            says = (
                f"{wording.found(token)}; a variable is declared in VARIABLES {{ NUMBER {name}; }} and then assigned to"
            )
        else:
            says = f"{wording.found(token)}; a variable is declared in VARIABLES"
    elif word in LANGUAGE.elsewhere:
        says = f"{wording.found(token)}; {LANGUAGE.elsewhere[word]}"
    elif _opens_block(cursor):
        says = (
            f"{wording.found(token)}; a block begins with its keyword, and what a thing is called stands in a comment"
        )
    elif not cursor.open and token.first:
        says = f"{wording.found(token)}; a comment stands between /* and */"
    else:
        says = wording.found(token)
    cursor.faults.add(catalogue.INVALID_AT_TOP, token.span, says)
    cursor.doubtful = True
    while (next_ := cursor.peek()).kind not in ("end", "}", "keyword") and not next_.first:
        if next_.kind == "{":
            skip.group(cursor)
        elif cursor.next().kind == ";":
            return


def pass_quoted(cursor: Cursor, token: Token, block: Block | None) -> None:
    """A text in quotes: the name of something, as other languages have it."""
    if token.kind == "name":
        cursor.faults.invalid(
            block, token.span, f"{wording.found(token)}; names are of the letters A to Z, digits and underscores"
        )
        cursor.doubtful = True
        return
    inner = token.text.strip("\"'\u201c\u201d").strip()
    edits = [(token.span, f"/* {inner} */")] if "*/" not in inner and "/*" not in inner and inner.isascii() else None
    says = f"found {wording.shown(token)}; what a thing is called stands in a comment"
    cursor.faults.invalid(block, token.span, says, edits=edits, title="Make a comment of it")
