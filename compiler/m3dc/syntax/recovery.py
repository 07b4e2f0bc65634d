"""Reading a stretch of text that tree-sitter could not: every item of it as far as it goes, and what is wrong.

The reader goes through the form of the language by recursive descent (the same form as grammar.js: which keyword may
stand where is for `check` to say). Where a token does not fit it takes the text for what it most likely means, says so
once, and goes on. An item in which that was not certain is marked `doubtful`: nothing more is said of it.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from tree_sitter import Node

from m3d_language.comments import blank_comments
from m3d_language.table import LANGUAGE, Block, Statement

from ..diagnostics import Findings, Fix, Related
from ..diagnostics.spelling import certain, nearest
from ..diagnostics.words import CAPITALS, members, place_of, statement_of, takes
from ..text.span import Span
from . import ast, numerals
from .braces import brace_faults
from .lexer import Lexer, Token, comment_end

_TABLES = frozenset(keyword for block in LANGUAGE.blocks.values() for keyword in block.tables)
_STATEMENTS = {keyword: entry for block in LANGUAGE.blocks.values() for keyword, entry in block.statements.items()}
_BULK = re.compile(rb"[0-9eE+\-.<>,\s]*")
_HEX_COLOUR = re.compile(r"#(?:[0-9a-fA-F]{3}|[0-9a-fA-F]{6})")
_VECTOR_WORDS = frozenset({"rgb", "rgba", "rgbf", "rgbt", "srgb", "color", "colour", "vec3", "float3", "vector"})
_GLUED = re.compile(r"([A-Za-z]+)([0-9]+)")
_WORDISH = re.compile(rb"[A-Za-z0-9_.+-]")
_NUMBERS = re.compile(r"[^\s,]+")
_DECIMAL_COMMA = re.compile(rb"[0-9],[0-9]")
_OPERATORS = frozenset([*"+-*/^%", "**"])
_CHANGES = frozenset(["++", "--", "+=", "-=", "*=", "/="])
_PARTS = frozenset(["(", "[", ".", "::"])  # what follows a name that something is made or taken of
_CLOSERS = {"(": ")", "[": "]", "{": "}"}
_DASHES = frozenset("\u2212\u2013\u2014\u2010\u2011\ufe63\uff0d")
_LETTERS = "words are of the letters A to Z, digits and underscores"
_TOP_LEVEL = "VARIABLES, SCENE, SOLID and LIGHT blocks, and assignments to variables"
_LONG_FIX = 10_000  # bytes: habits further apart are mended one by one


class Read(NamedTuple):
    """An item and where it begins and ends; None where nothing of it can be used. `unclosed`: a block of it is."""

    start: int
    end: int
    item: ast.Item | None
    doubtful: bool
    unclosed: bool


class Recovered(NamedTuple):
    """The items of all broken stretches, and the `names` that they may declare or assign to."""

    items: tuple[Read, ...]
    stretches: tuple[Span, ...]
    names: frozenset[str]


def recover(data: bytes, root: Node, end: int, findings: Findings, most: int) -> Recovered | None:
    """Read the stretches of a text, up to `end`, that have errors in its tree. None if there are more faults than
    `most`: the text is given up."""
    nodes = [node for node in root.children if node.type != "comment" and node.start_byte < end]
    whole = {node.start_byte for node in nodes if is_whole(node, root)}
    reader = Reader(data, end, findings, whole, most, _declared_types(nodes))
    done = 0
    try:
        for number, node in enumerate(nodes):
            if node.end_byte <= done or (node.start_byte >= done and node.start_byte in whole):
                continue
            start = max(node.start_byte, done)
            # What stands before may be the beginning of what is broken.
            for before in reversed(nodes[:number]):
                far = b"\n" in data[before.end_byte : start] and start < node.start_byte
                if before.start_byte < done or _has_body(before) or far:
                    break
                start = before.start_byte
            done = reader.run(start, node.start_byte + 1)
    except _TooManyError:
        return None
    return Recovered(tuple(reader.read), tuple(reader.stretches), frozenset(reader.names))


def _declared_types(nodes: Iterable[Node]) -> dict[str, str]:
    """The types of the variables that sound VARIABLES blocks declare."""
    types: dict[str, str] = {}
    for node in nodes:
        for declaration in node.children if node.type == "variables" else ():
            names = declaration.children_by_field_name("name")
            type_ = declaration.children[0].type if names else ""
            types |= {name.text.decode("latin-1"): type_ for name in names if name.text is not None}
    return types


def is_whole(node: Node, root: Node) -> bool:
    """Whether a node of the top level is an item without an error."""
    if node.has_error or node.is_missing or not node.child_count or node.type == "ERROR":
        return False
    return root.type != "ERROR" or node.type in ("variables", "assignment") or node.children[0].type in LANGUAGE.top


def _has_body(node: Node) -> bool:
    return node.type == "variables" or (node.child_count > 0 and node.children[-1].type == "body")


class _TooManyError(Exception):
    """More faults than are reported."""


class _AgainError(Exception):
    """The item is to be read again: with braces closed at other places, or with every top-level keyword ending it."""

    def __init__(self, closed: Sequence[int] = ()) -> None:
        self.closed = closed


class _ElsewhereError(Exception):
    """A brace before the current place was one too many: reading goes on from there, as if it were not there."""

    def __init__(self, start: int) -> None:
        self.start = start


class _Habit(NamedTuple):
    """Faults of one kind in an item: the first is reported, with one fix for all."""

    place: int  # among the findings
    title: str
    edits: list[tuple[Span, str]] | None
    certain: bool


class Reader:
    """Reads items one after the other. Places are bytes of the text; the spans of an item count from its start."""

    def __init__(
        self, data: bytes, end: int, findings: Findings, whole: set[int], most: int, types: dict[str, str]
    ) -> None:
        self.read: list[Read] = []
        self.stretches: list[Span] = []
        self.names: set[str] = set()
        self._data = data
        self._whole = whole
        self._cut = end < len(data)
        self._lexer = Lexer(data, end, self._passed)
        self._ahead: list[Token] = []
        self._before = 0  # where the last token ended
        self._findings = findings
        self._most = most
        self._types = types  # of variables, by name
        self._marks: dict[int, int] = {}  # by the starts of items, how much had been found
        self._blocks: dict[int, tuple[str, int]] = {}  # by the starts of top-level blocks, keyword and closing brace
        self._habits: dict[str, _Habit] = {}
        self._begin(0)

    def _begin(self, start: int) -> None:
        """Start to read the item at a byte, from nothing."""
        self._start = start
        self._lexer.at = self._before = start
        self._ahead = []
        self._around: list[str] = []
        self._open: list[Token] = []
        self._doubtful = False
        self._unclosed_block = False
        self._strict = False
        self._closed = False  # whether braces are taken to be where the indentation says
        self._nested_top = False
        self._too_deep = False
        self._misfit: int | None = None  # where something begins that stands in the block around this one

    # --- items --------------------------------------------------------------------------------------------------

    def run(self, start: int, past: int) -> int:
        """Read items from a byte on, at least up to `past`, until one that the tree has whole; returns its start."""
        self._begin(start)
        first = start
        while True:
            token = self._peek()
            if token.kind == "end" or (token.start >= past and token.start in self._whole):
                break
            try:
                self._item(token.start)
            except _ElsewhereError as elsewhere:
                self.read = [read for read in self.read if read.start < elsewhere.start]
                first = min(first, elsewhere.start)
                past = max(past, token.end)
                self._begin(elsewhere.start)
        end = self._peek().start
        self._settle()
        self.stretches = [span for span in self.stretches if span[1] <= first]
        self.stretches.append((first, end))
        return end

    def _item(self, start: int) -> None:
        found = self._findings.found
        mark = self._marks.setdefault(start, len(found))
        ignored = set(self._lexer.ignored)
        closed: Sequence[int] = ()
        strict = False
        while True:
            self._begin(start)
            self._strict = strict
            self._lexer.ignored = set(ignored)
            self._lexer.closed = sorted(closed)
            self._closed = bool(closed)
            try:
                item = self._top()
                break
            except _AgainError as again:
                del found[mark:]
                self._habits = {kind: habit for kind, habit in self._habits.items() if habit.place < mark}
                closed, strict = again.closed, True
        if self._peek().start == start and self._before <= start:
            self._fault("M3D0107", self._next().span, "this can not be read here")
        if item is not None:
            self._settle()
        if self._doubtful and isinstance(item, ast.Assignment):
            self.names.add(item.target.text)
        self.read.append(Read(start, self._before, item, self._doubtful, self._unclosed_block))

    def _top(self) -> ast.Item | None:
        token = self._peek()
        match token.kind:
            case "keyword" if token.text == "VARIABLES":
                return self._variables()
            case "keyword" if self._is_declaration():
                return self._declared_outside()
            case "keyword":
                return self._keyword_member(None)
            case "word":
                return self._top_word()
            case "}":
                return self._stray_brace()
            case _:
                self._junk(None)
                return None

    def _hyphened(self) -> Token:
        """The word that comes next, with all that hyphens join to it, passed."""
        word = self._next()
        while self._hyphen_follows(0):
            self._next()
            if self._peek().kind in ("word", "keyword"):
                self._next()
        return word._replace(end=self._before, text=self._data[word.start : self._before].decode("utf-8", "replace"))

    def _hyphen_follows(self, ahead: int) -> bool:
        hyphen, after = self._peek(ahead), self._peek(ahead + 1)
        joined = hyphen.text == "-" and after.kind in ("word", "keyword") and not after.gap
        return not hyphen.gap and (joined or (hyphen.kind == "number" and hyphen.text[0] == "-"))

    def _top_word(self) -> ast.Item | None:
        word, after = self._peek(), self._peek(1)
        if self._hyphen_follows(1):
            word = self._hyphened()
            self._fault("M3D0108", word.span, f"found {word.text!r}; {_LETTERS}")
            self._skip_group() if self._peek().kind == "{" else self._skip_lines()
            self._doubtful = True
            return None
        if after.kind == "=" or (after.text == ":" and self._peek(2).kind == "="):
            return self._assignment()
        opens = after.kind == "{" or (after.kind == "word" and self._peek(2).kind == "{")
        known = certain(word.text, LANGUAGE.keywords)
        if opens or (known == word.text.upper() and known in members(None)):
            return self._word_member(None)
        if after.kind in ("number", "<"):
            return self._assignment()
        if after.text == ":" and self._peek(2).kind in ("number", "<", "word"):
            return self._assignment()
        if after.text in _CHANGES or (after.text in "+-" and self._peek(2).text == after.text):
            return self._changed()
        if after.kind == "word" and self._peek(2).kind in ("=", ";", ",") and not after.first:
            return self._declared_outside()
        self._next()
        near = nearest(word.text, members(None))
        says = LANGUAGE.elsewhere.get(word.text.lower())
        if says is None and word.text.upper() in LANGUAGE.keywords:
            says = f"{place_of(word.text.upper(), ())}; {CAPITALS}"
        says = says or (f"did you mean {near}?" if near else f"a file holds {_TOP_LEVEL}")
        self._fault("M3D0107", word.span, f"found {word.text!r}; {says}")
        self._skip_lines()
        self._doubtful = True
        return None

    def _changed(self) -> None:
        """`size += 1`, `size++`."""
        name = self._next()
        self._next()
        while not self._peek().first and self._peek().kind not in ("end", "}", ";"):
            self._next()
        span = (name.start, self._before)
        text = self._data[span[0] : span[1]].decode("utf-8", "replace")
        self._fault("M3D0118", span, f"found {text!r}; write the result: {name.text} = ..")
        if self._peek().kind == ";":
            self._next()
        self._doubtful = True
        self.names.add(name.text)

    def _skip_lines(self) -> None:
        """Pass what belongs to something unknown: up to a line that begins an item."""
        while (token := self._peek()).kind not in ("end", "}"):
            begins = token.kind == "keyword" or (token.kind == "word" and self._peek(1).kind in ("=", "{"))
            if (token.first and begins) or (token.kind == "keyword" and token.text in members(None)):
                return
            self._next() if token.kind != "{" else self._skip_group()

    def _stray_brace(self) -> ast.Item | None:
        brace = self._peek()
        start, (keyword, close) = max(self._blocks_before(brace.start), default=(brace.start, ("", brace.start)))
        faults = brace_faults(self._blanked(start, brace.end))
        extra = start + faults[0].offset if len(faults) == 1 and not faults[0].missing else brace.start
        detail = "found '}', which closes more than was opened"
        between = self._first_member(close + 1, brace.start)
        if extra == brace.start and between is not None and between in members(LANGUAGE.blocks.get(keyword)):
            extra, detail = close, f"this brace closes the {keyword}, and {between} after it stands in it"
        edits, kind = [((extra, extra + 1), "")], "}" if extra == brace.start else None
        self._fault(
            "M3D0107", (extra, extra + 1), detail, edits=edits, title="Remove this brace", kind=kind, sure=False
        )
        if extra == brace.start:
            self._next()
            return None
        self._settle()
        fault = self._findings.found[-1]
        for item in [item for item in self._marks if item >= start]:
            del self._findings.found[self._marks.pop(item) :]
        self._findings.found.append(fault)
        self._lexer.ignored.add(extra)
        self._marks[start] = len(self._findings.found)
        raise _ElsewhereError(start)

    def _blocks_before(self, end: int) -> list[tuple[int, tuple[str, int]]]:
        """The top-level block that stands last before a byte: where it begins, its keyword and closing brace."""
        before = [(start, block) for start, block in self._blocks.items() if block[1] < end]
        whole = max((start for start in self._whole if start < end), default=None)
        if whole is not None and all(start < whole for start, _ in before):
            return [(start, block) for start in sorted(self._whole, reverse=True) if start < end
                    if (block := self._whole_block(start)) is not None][:1]  # fmt: skip
        return before

    def _whole_block(self, start: int) -> tuple[str, int] | None:
        lexer = Lexer(self._data, self._lexer.end, _unheard)
        lexer.at = start
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

    def _first_member(self, start: int, end: int) -> str | None:
        """The keyword that stands first in a stretch."""
        lexer = Lexer(self._data, end, _unheard)
        lexer.at = start
        token = lexer.next()
        return token.text if token.kind == "keyword" else None

    def _blanked(self, start: int, end: int) -> str:
        """A stretch of text, a character a byte, without its comments and the braces that are ignored."""
        text = bytearray(self._data[start:end])
        for at in self._lexer.ignored:
            if start <= at < end:
                text[at - start] = 0x20
        return blank_comments(text.decode("latin-1"))

    # --- variables ----------------------------------------------------------------------------------------------

    def _variables(self, word: Token | None = None) -> ast.Variables:
        """A VARIABLES block; its keyword is the next token, or meant by a `word` that has been passed."""
        keyword = word or self._next()
        known = ast.Keyword("VARIABLES", self._span(keyword.span))
        self._superfluous_marks()
        declarations: list[ast.Declaration] = []
        opened = self._opened(keyword)
        while opened:
            token = self._peek()
            if token.kind == "}":
                self._close()
                break
            if token.kind == "end" or self._ends_declarations(token):
                self._unclosed(token)
                break
            if token.kind in ("keyword", "word"):
                declaration = self._declaration()
                declarations += [declaration] if declaration else []
            else:
                self._junk(None, code="M3D0109")
        for declaration in declarations:
            self._types |= {name.text: declaration.type.text for name in declaration.names}
        return ast.Variables(known, tuple(declarations), self._from(keyword))

    def _ends_declarations(self, token: Token) -> bool:
        """Whether a token begins an item of the top level, as one can tell where a VARIABLES block is not closed."""
        if not token.first or not self._is_outside(token):
            return False
        if token.text in ("SCENE", "VARIABLES"):
            return True
        after = self._peek(1)
        if token.text in LANGUAGE.top:
            return after.kind == "{" or (after.kind == "word" and self._peek(2).kind not in (";", ",", "="))
        return token.kind == "word" and after.kind == "="

    def _declaration(self) -> ast.Declaration | None:
        first = self._next()
        after = self._peek()
        type_: ast.Keyword | ast.Name = (
            self._keyword(first) if first.kind == "keyword" else ast.Name(first.text, self._span(first.span))
        )
        if after.text == ":" and self._peek(1).kind == "keyword" and first.kind == "word":
            self._next()
            kind = self._next()
            edits = [((first.start, kind.end), f"{kind.text} {first.text}")]
            self._fault(
                "M3D0109",
                first.span,
                "the type comes first",
                edits=edits,
                title="Put the type first",
                kind="type first",
            )
            self._declaration_end()
            return ast.Declaration(
                self._keyword(kind), (ast.Name(first.text, self._span(first.span)),), self._from(first)
            )
        if first.kind == "word" and after.kind not in ("word", "keyword", "name", "number"):
            self.names.add(first.text)
            detail = f"found {first.text!r}; a declaration is a type and a name, such as NUMBER {first.text};"
            if after.kind == "=":
                detail = f"{first.text} is assigned a value here; that is done outside VARIABLES"
            self._fault("M3D0109", first.span, detail, kind="no type")
            self._skip_declaration()
            return None
        if first.kind == "word" and after.kind == "keyword" and not after.first and self._peek(1).kind == "word":
            detail = f"found {first.text!r}; a declaration is a type and a name, such as {after.text} size;"
            edits = [((first.start, after.start), "")]
            self._fault("M3D0109", first.span, detail, edits=edits, title="Remove it", kind="before a type", sure=False)
            first = self._next()
            type_ = self._keyword(first)
        names: list[ast.Name] = []
        while True:
            name = self._peek()
            if name.kind != "word":
                self._no_name(name)
                break
            if self._hyphen_follows(1):
                name = self._hyphened()
                self._fault("M3D0108", name.span, f"found {name.text!r}; {_LETTERS}")
                self.names.add(name.text)
                self._skip_declaration()
                break
            names.append(ast.Name(self._next().text, self._span(name.span)))
            self._check_length(names[-1])
            if self._peek().kind == ",":
                self._next()
            elif self._peek().kind == "word" and not self._peek().first and self._peek(1).kind in (",", ";", "word"):
                self._missing(",")
            else:
                self._declaration_end()
                break
        return ast.Declaration(type_, tuple(names), self._from(first))

    def _no_name(self, token: Token) -> None:
        self._fault("M3D0108", token.span, f"{_found(token)}; a name starts with a letter and is not a keyword")
        self._doubtful = True
        if token.kind not in ("}", "end", ";") and not (token.first and token.kind == "keyword"):
            self._next()
            if token.kind in ("name", "number", "keyword") and self._peek().kind != ";":
                self._skip_declaration()
        if self._peek().kind == ";":
            self._next()

    def _declaration_end(self) -> None:
        """The semicolon after a declaration, or what stands there in its place."""
        token = self._peek()
        if token.kind == ";":
            self._next()
            return
        value = token.kind == "=" or token.text == ":"
        if not value and (token.first or token.kind in ("}", "end", "keyword")):
            self._missing(";")
            return
        detail = _found(token)
        if value or token.kind in ("<", "number"):
            detail += "; a variable is assigned to outside VARIABLES, after it"
        name = self._data[: self._before].rsplit(None, 1)[-1] if self._before < 300 else self._last_word()
        self.names.add(name.decode("utf-8", "replace").rsplit(",", 1)[-1])
        self._fault("M3D0101", token.span, detail, fill=";", kind="value")
        self._skip_declaration()

    def _last_word(self) -> bytes:
        return self._data[self._before - 300 : self._before].rsplit(None, 1)[-1]

    def _skip_declaration(self) -> None:
        while (token := self._peek()).kind not in ("end", "}", ";"):
            if token.first and token.kind in ("keyword", "word"):
                return
            self._next() if token.kind != "{" else self._skip_group()
        if token.kind == ";":
            self._next()

    def _is_declaration(self) -> bool:
        """Whether a type at the top level begins a declaration: `NUMBER size = 2`, `SPHERE ball;`."""
        if self._peek().text not in LANGUAGE.types or self._peek(1).kind != "word":
            return False
        after = self._peek(2)
        basic = self._peek().text in LANGUAGE.basics
        return (after.kind in ("=", ";", ",") and not self._peek(1).first) or (basic and after.kind != "{")

    def _declared_outside(self) -> None:
        first = self._next()
        name = self._next()
        self.names.add(name.text)
        type_ = first.text if first.text in LANGUAGE.types else nearest(first.text, LANGUAGE.types) or "NUMBER"
        says = f"variables are declared in VARIABLES {{ {type_} {name.text}; }} and assigned to after it"
        self._fault("M3D0107", first.span, f"{_found(first)}; {says}", kind="declaration outside")
        self._doubtful = True
        while (token := self._peek()).kind not in ("end", "}"):
            if token.kind == ";":
                self._next()
                break
            if token.first or token.text in members(None):
                break
            self._next() if token.kind != "{" else self._skip_group()

    # --- assignments --------------------------------------------------------------------------------------------

    def _assignment(self) -> ast.Assignment | None:
        target = self._next()
        if self._peek().text == ":":
            colon = self._next()
            equals = self._peek()
            if equals.kind == "=":
                self._superfluous(colon, "an assignment is written with = alone")
                self._next()
            else:
                edits = [(colon.span, " =")]
                self._fault("M3D0101", colon.span, "found ':'", fill="=", edits=edits, title="Write '='")
        elif self._peek().kind == "=":
            self._next()
        elif self._peek().kind in ("number", "<"):
            self._missing("=")
        while self._peek().kind == "=" and not self._peek().gap:
            self._superfluous(self._next(), "an assignment is written with one =")
        name = ast.Name(target.text, self._span(target.span))
        value: ast.Argument | None = None
        body: ast.Body | None = None
        token = self._peek()
        if token.kind == "keyword" and token.text in LANGUAGE.types and self._peek(1).kind == "{":
            edits = [((token.start, self._peek(1).start), "")]
            detail = f"{_found(token)}; the variable's type is known, its block stands alone"
            self._fault("M3D0117", token.span, detail, fill=token.text, edits=edits, title="Remove it")
            self._next()
            body = self._body(token, LANGUAGE.blocks.get(token.text))
        elif token.kind == "{" and not self._is_bracketed():
            body = self._body(target, self._type_of(target))
        elif self._starts_value() and not (token.kind == "word" and token.first and self._peek(1).kind == "="):
            value = self._value(None)
            if isinstance(value, ast.Name) and self._peek().kind == "{":
                body = self._body(target, self._type_of(target))
            elif self._peek().kind in (",", "number") and isinstance(value, ast.Number):
                self._bare_vector(token)
                value = None
        else:
            at = token.span if not token.first and token.kind != "end" else (self._before, self._before)
            self._fault("M3D0103", at, f"{_found(token)}; a vector < x, y, z > or a block could stand here too")
            self._doubtful = True
        if value is None and body is None:
            self._doubtful = True
            self.names.add(target.text)
            return None
        return ast.Assignment(name, value, body, self._from(target))

    def _type_of(self, variable: Token) -> Block | None:
        """The block that a variable holds, if it has been declared with such a type."""
        return LANGUAGE.blocks.get(self._types.get(variable.text, "").upper())

    # --- blocks -------------------------------------------------------------------------------------------------

    def _opened(self, keyword: Token, *, variable: bool = False) -> bool:
        """Pass the opening brace of a block; report it where it is missing. Whether the block goes on."""
        token = self._peek()
        if token.kind == "{":
            self._open.append(self._next())
            return True
        if self._cut and token.kind == "end":
            self._doubtful = True
            return False
        also = "; the name of a variable could stand here too" if variable else ""
        if token.text in ("(", "[", ":"):
            also = "; what belongs to a block stands between { and }"
        at = token.span if not token.first and token.kind != "end" else (self._before, self._before)
        self._fault("M3D0101", at, f"{_found(token)}{also}", fill="{")
        if token.text in ("(", "["):
            self._doubtful = True
            self._skip_all_brackets()
            if self._peek().kind == "{":
                self._skip_group()
            return False
        if token.text == ":":
            token = self._next() and self._peek()
        if not self._has_more_closed(token.start):
            self._doubtful = True
            if token.first:
                self._skip_indented(keyword)
            return False
        self._open.append(Token("{", self._before, self._before, "", False, False))
        return True

    def _skip_indented(self, keyword: Token) -> None:
        """Pass what belongs to a block without braces: at the top level all up to the next item, elsewhere the lines
        that are indented more than the keyword's."""
        margin = _indent(self._data, keyword.start)
        while (token := self._peek()).kind not in ("end", "}"):
            item = token.text in members(None) or (token.kind == "word" and self._peek(1).kind == "=")
            if token.first and (item if not self._open else _indent(self._data, token.start) <= margin):
                return
            self._next() if token.kind != "{" else self._skip_group()

    def _has_more_closed(self, start: int) -> bool:
        """Whether braces from here on to the next item close more than is open."""
        lexer = Lexer(self._data, self._lexer.end, _unheard)
        lexer.at, depth = start, len(self._open)
        while (token := lexer.next()).kind != "end" and not (token.first and token.text in members(None)):
            depth += (token.kind == "{") - (token.kind == "}")
            if depth < 0:
                return True
        return False

    def _body(self, keyword: Token, block: Block | None) -> ast.Body | None:
        """The body of a block: its opening brace is the next token, or missing."""
        start = self._peek().start
        if not self._opened(keyword, variable=block is not None and block.variable):
            self._skip_values()
            return None
        if len(self._open) > ast.DEEPEST + 1:
            self._too_deep_at(keyword)
            return None
        self._around.append(block.keyword if block else "")
        items: list[ast.Item] = []
        while True:
            token = self._peek()
            if token.kind == "}":
                self._close()
                break
            if token.kind == "end" or self._ends_all(token):
                self._unclosed(token)
                break
            item = self._member(block)
            items += [item] if item is not None else []
        self._around.pop()
        return ast.Body(tuple(items), self._span((start, max(self._before, start))))

    def _close(self) -> None:
        brace = self._next()
        opened = self._open.pop()
        if brace.start == brace.end:
            self._report_unclosed(opened, brace.start, "this block is not closed")
        if len(self._open) == 0:
            self._blocks[self._start] = (self._keyword_at_start(), brace.start)

    def _keyword_at_start(self) -> str:
        match = re.compile(rb"[A-Z]+").match(self._data, self._start)
        return match[0].decode() if match else ""

    def _unclosed(self, token: Token) -> None:
        """Report that a block is not closed before a token."""
        if self._cut and token.kind == "end":
            self._doubtful = True
            self._open.pop()
            return
        if not self._strict and self._nested_top:
            raise _AgainError
        if not self._closed and self._misfit is not None and len(self._open) == 1:
            raise _AgainError([self._misfit])
        marked = self._marks.get(self._start, 0)
        # What stands in no table may well stand in the block around it: of that one nothing is known yet.
        outside = token.kind == "end" or self._ends_all(token) or not self._around
        if outside and not self._closed and len(self._findings.found) == marked and len(self._open):
            end = token.start if token.kind != "end" else self._lexer.end
            faults = brace_faults(self._blanked(self._start, end))
            if faults and all(fault.missing for fault in faults) and len(faults) == len(self._open):
                raise _AgainError([self._start + fault.offset for fault in faults])
        opened = self._open.pop()
        self._report_unclosed(opened, self._before, _found(token))

    def _report_unclosed(self, opened: Token, at: int, detail: str) -> None:
        begin = opened.start
        self._unclosed_block = True
        related = (Related((begin, begin + 1), "the block that is open begins here"),)
        new = _closing(self._data, begin, at)
        self._fault(
            "M3D0101",
            (at, at),
            detail,
            fill="}",
            related=related,
            edits=[((at, at), new)],
            title="Close the block",
            sure=False,
        )

    def _ends_all(self, token: Token) -> bool:
        """Whether a token, within a block, begins an item of the top level: the block is not closed then."""
        top = token.text in LANGUAGE.top or token.text == "VARIABLES"
        assigns = token.kind == "word" and self._peek(1).kind == "="
        if not (top and token.kind == "keyword") and not assigns:
            return False
        return (self._strict and (top or token.first)) or (token.first and self._is_outside(token))

    def _is_outside(self, token: Token) -> bool:
        """Whether the line of a token is indented no more than the one the item begins on."""
        return _indent(self._data, token.start) <= _indent(self._data, self._start)

    def _too_deep_at(self, keyword: Token) -> None:
        if not self._too_deep:
            span = (keyword.start, min(self._peek().end, self._lexer.end))
            self._fault("M3D0111", span, f"no scene needs more than {ast.DEEPEST} levels")
        self._too_deep = self._doubtful = True
        self._open.pop()
        depth = 1
        while depth and (token := self._next()).kind != "end":
            depth += (token.kind == "{") - (token.kind == "}")

    def _member(self, block: Block | None) -> ast.Item | None:
        token = self._peek()
        if token.kind == "keyword" and (token.text in LANGUAGE.top or token.text == "VARIABLES"):
            self._nested_top = True
            inner = "" if block is None or not block.holds else f"; {block.keyword} holds {_some(block.holds)}"
            self._invalid(block, token.span, f"{place_of(token.text, self._around)}{inner}")
            self._doubtful = True
            self._next()
            while self._peek().kind == "word":
                self._next()
            if self._peek().kind == "{":
                self._skip_group()
            return None
        if token.kind == "keyword":
            outer = LANGUAGE.blocks.get(self._around[-2]) if len(self._around) > 1 else None
            misfit = block is not None and outer is not None and token.text not in members(block)
            if misfit and self._misfit is None and outer is not None and token.text in members(outer):
                self._misfit = self._before
            return self._keyword_member(block)
        if token.kind == "word" and self._peek(1).kind == "=":
            near = certain(token.text, members(block))
            if near is None or near in LANGUAGE.blocks:
                self._nested_top = True
                self._invalid(block, token.span, "variables are assigned to outside of all blocks")
                self._assignment()
                self._doubtful = True
                return None
        if token.kind == "word":
            return self._word_member(block)
        if token.kind == "string" and self._peek(1).text in (":", "="):
            return self._quoted_key(block)
        if token.kind == "<" or token.kind == "number":
            holds = f": {block.keyword} holds {_some(block.members())}" if block is not None else ""
            self._invalid(block, token.span, f"{_found(token)}; a value stands after its keyword{holds}", kind="value")
            self._doubtful = True
            self._skip_values()
            return None
        self._junk(block)
        return None

    def _keyword_member(self, block: Block | None, word: Token | None = None, keyword: str = "") -> ast.Item | None:
        """A block, statement or table; its keyword is the next token, or meant by a `word` that has been passed."""
        token = word or self._next()
        keyword = keyword or token.text
        if keyword == "VARIABLES" and not self._around:
            return self._variables(token)
        known = ast.Keyword(keyword, self._span(token.span))
        entry = (block.statements.get(keyword) if block else None) or _STATEMENTS.get(keyword)
        inner = LANGUAGE.blocks.get(keyword)
        if not (inner is not None and entry is None and self._peek().text == ":" and self._peek(1).first):
            self._superfluous_marks()
        if keyword in _TABLES:
            return self._table(known, token, block)
        if self._peek().kind in ("string", "name") and inner is not None:
            self._quoted(self._next(), block)
        after = self._peek()
        if inner is not None and (after.kind == "{" or entry is None):
            if inner.variable and after.kind == "word" and self._is_source(after):
                name = ast.Name(self._next().text, self._span(after.span))
                self._check_length(name)
                if self._peek().kind != "{":
                    return ast.Block(known, name, None, self._from(token))
                return ast.Block(known, name, self._body(token, inner), self._from(token))
            body = self._body(token, inner)
            return None if body is None else ast.Block(known, None, body, self._from(token))
        if inner is None and entry is None and keyword in LANGUAGE.keywords - set(LANGUAGE.types):
            entry = None
        return ast.Statement(known, self._arguments(entry, block, keyword), self._from(token))

    def _quoted_key(self, block: Block | None) -> ast.Item | None:
        """`"RADIUS": 2`, as in JSON."""
        word, mark = self._next(), self._next()
        inner = word.text[1:-1].strip()
        meant = certain(inner, members(block))
        if meant is None:
            says = LANGUAGE.elsewhere.get(inner.lower()) or "keywords stand without quotes and colons"
            self._invalid(block, word.span, f"{_found(word)}; {says}")
            self._doubtful = True
            self._skip_unknown()
            return None
        edits = [((word.start, mark.end), meant)]
        says = f"{_found(word)}; keywords stand without quotes, and nothing stands between them and what follows"
        self._invalid(block, word.span, says, edits=edits, title=f"Write {meant}", kind="quoted keyword")
        return self._keyword_member(block, word, meant)

    def _is_source(self, word: Token) -> bool:
        """Whether a word after a block's keyword is the variable that the block copies."""
        after = self._peek(1)
        if after.kind == "{":
            return True
        return after.kind != "=" and not (word.first and word.text.upper() in LANGUAGE.keywords)

    def _word_member(self, block: Block | None) -> ast.Item | None:
        """What begins with a word that is no keyword: what is meant by it, if that can be told."""
        word = self._hyphened()
        glued = _GLUED.fullmatch(word.text)
        if glued and block is not None and glued[1].upper() in block.statements and word.text not in members(block):
            meant = glued[1].upper()
            at = word.start + len(meant)
            detail = f"{_found(word)}; a blank stands between a keyword and its value"
            new = f"{meant} {glued[2]}"
            self._invalid(block, word.span, detail, edits=[(word.span, new)], title=f"Write {new}")
            self._ahead = []
            self._lexer.at = self._before = at
            return self._keyword_member(block, word._replace(end=at, text=meant), meant)
        fits = [keyword for keyword in members(block) if self._fits(keyword, block)]
        spelt = word.text.upper()
        meant = certain(word.text, fits)
        code = "M3D0106" if block is not None else "M3D0107"
        fill = statement_of(block.keyword) if block is not None else ""
        if meant is not None:
            capitals = meant == spelt
            says = f"did you mean {meant}?" + (f" {CAPITALS}" if capitals else "")
            title = f"Replace with {meant}" if not capitals else f"Write {meant}"
            kind = "capitals" if capitals else None
            edits = [(word.span, meant)]
            self._fault(code, word.span, f"{_found(word)}; {says}", fill=fill, edits=edits, title=title, kind=kind)
            return self._keyword_member(block, word, meant)
        self._doubtful = True
        near = nearest(word.text, fits)
        if spelt in LANGUAGE.keywords:
            says = f"{place_of(spelt, self._around)}; {CAPITALS}"
        elif near is not None and word.text.lower() not in LANGUAGE.elsewhere:
            says = f"did you mean {near}?"
        else:
            says = self._unknown(word, block)
        self._fault(code, word.span, f"{_found(word)}; {says}", fill=fill)
        if near is not None and spelt not in LANGUAGE.keywords and word.text.lower() not in LANGUAGE.elsewhere:
            return self._keyword_member(block, word, near)
        self._skip_unknown()
        return None

    def _unknown(self, word: Token, block: Block | None) -> str:
        """What to say of a word that looks like no keyword that could stand there."""
        says = LANGUAGE.elsewhere.get(word.text.lower())
        if says is not None:
            return says
        if word.text in numerals.UNITS and not word.first:
            return numerals.UNITS_SAY
        elsewhere = certain(word.text, LANGUAGE.keywords) or nearest(word.text, LANGUAGE.keywords)
        if elsewhere is not None and LANGUAGE.parents.get(elsewhere):
            return place_of(elsewhere, self._around)
        if block is None and self._around:
            return f"no statement is called that; {CAPITALS}"
        if block is None:
            return f"a file holds {_TOP_LEVEL}; {CAPITALS}"
        return f"a {block.keyword} holds {_some(block.members())}; {CAPITALS}"

    def _fits(self, keyword: str, block: Block | None) -> bool:
        """Whether what comes next can follow a keyword of a block."""
        after = self._peek()
        inner = LANGUAGE.blocks.get(keyword)
        entry = None if block is None else block.statements.get(keyword)
        if after.text in ("=", ":"):
            after = self._peek(1)
        if after.kind == "{":
            return inner is not None or keyword in _TABLES or keyword == "VARIABLES"
        vector = entry is not None and not entry.is_flag and entry.arguments[0].shape == "vector"
        if after.kind == "<":
            return vector
        if after.kind == "number":
            return entry is not None and not entry.is_flag and not vector
        return keyword not in _TABLES

    def _skip_unknown(self) -> None:
        """Pass what follows an unknown word: a block, or the rest of a statement."""
        while True:
            token = self._peek()
            if token.kind == "{":
                self._skip_group()
                return
            if token.kind == ";":
                self._next()
                return
            if token.kind in ("}", "end", "keyword") or self._ends_all(token):
                return
            if token.first and token.kind not in ("<", "number", ","):
                return
            if token.kind == "word" and certain(token.text, LANGUAGE.keywords):
                return
            self._next()

    def _skip_group(self) -> None:
        """Pass braces and all that is between them, or, where they are not closed, what belongs to the item."""
        depth = 0
        first = self._peek()
        while True:
            token = self._peek()
            if token.kind == "end" or (depth and self._ends_all(token) and token.kind == "keyword"):
                if depth and not self._cut:
                    self._report_unclosed(first, self._before, _found(token))
                return
            self._next()
            depth += (token.kind == "{") - (token.kind == "}")
            if depth == 0:
                return

    # --- tables -------------------------------------------------------------------------------------------------

    def _table(self, keyword: ast.Keyword, token: Token, block: Block | None) -> ast.Table | None:
        if self._peek().kind != "{":
            if not self._opened(token):
                self._skip_values()
                return None
        else:
            self._open.append(self._next())
        bulk = self._bulk()
        if bulk is not None:
            if self._peek().kind == "}":
                self._close()
            else:
                self._unclosed(self._peek())
            return ast.Table(keyword, self._span(bulk), (), self._from(token))
        entries: list[ast.Argument] = []
        while (next_ := self._peek()).kind not in ("}", "end") and not self._ends_all(next_):
            if next_.kind == "keyword" or (next_.kind == "word" and self._peek(1).kind in ("{", "=")):
                break
            if self._starts_value() and next_.kind != "{":
                value = self._value(None, table=True)
                entries += [value] if value is not None else []
            elif next_.kind in _CLOSERS or next_.text in _CLOSERS or next_.text in _CLOSERS.values():
                says = f"{_found(next_)}; a table holds numbers and vectors, without braces between them"
                self._fault("M3D0103", next_.span, says, kind="table braces")
                self._doubtful = True
                self._next()
                if next_.kind == "{":
                    self._flatten(entries)
            elif next_.kind == ",":
                self._superfluous(self._next(), "the numbers of a table are separated by blanks")
            else:
                self._junk(block)
        if self._peek().kind == "}":
            self._close()
        else:
            self._unclosed(self._peek())
        return ast.Table(keyword, None, tuple(entries), self._from(token))

    def _flatten(self, entries: list[ast.Argument]) -> None:
        """The values in braces within a table."""
        while (token := self._peek()).kind not in ("}", "end", "keyword", "{"):
            value = self._value(None, table=True) if self._starts_value() else None
            if value is not None:
                entries.append(value)
            elif self._peek() is token:
                self._next()
        if self._peek().kind == "}":
            self._next()

    def _bulk(self) -> Span | None:
        """Where the numbers of a table stand, if there is nothing else in its braces but comments; passed then."""
        start = self._peek().start
        at, end = start, start
        limit = self._lexer.closed[0] if self._lexer.closed else self._lexer.end
        while True:
            match = _BULK.match(self._data, at)
            at = match.end() if match else at
            stripped = len(self._data[start:at].rstrip()) + start
            end = max(end, stripped) if match and match[0].strip() else end
            comment = comment_end(self._data, at) if self._data.startswith(b"/*", at) else None
            if comment is None:
                break
            at = comment
        closes = self._data[at : at + 1] == b"}" and at not in self._lexer.ignored
        if not closes or at > limit or not any(0x30 <= byte <= 0x39 for byte in self._data[start:end][:1000]):
            return None
        self._ahead = []
        self._lexer.at = self._before = end
        return start, end

    # --- values -------------------------------------------------------------------------------------------------

    def _arguments(self, entry: Statement | None, block: Block | None, keyword: str) -> tuple[ast.Argument, ...]:
        found: list[ast.Argument] = []
        first = self._peek()
        wanted = len(entry.arguments) if entry else 4
        shape = None if entry is None or entry.is_flag else entry.arguments[0].shape
        if shape is not None:
            self._extra_commas(wanted)
        while self._starts_value() and self._is_argument(entry, block):
            value = self._value("vector" if shape == "vector" else "number" if shape else None)
            found += [value] if value is not None else []
            token = self._peek()
            if token.kind == ",":
                comma = self._next()
                omitted = len(found) < wanted and self._extra_commas(wanted)
                if not self._starts_value() or not self._is_argument(entry, block):
                    if not omitted:
                        self._superfluous(comma, "statements follow one another without a comma")
                    break
            elif len(found) < wanted and token.kind == "number" and shape != "vector" and value is not None:
                self._missing(",")
            else:
                break
        token = self._peek()
        if token.kind in (">", "number") and shape == "vector" and first.kind == "number":
            self._bare_vector(first)
            return tuple(found)
        if token.kind in ("number", "<") and found and entry is not None:
            self._invalid(block, token.span, f"{_found(token)}; {keyword} {takes(entry)}")
            self._doubtful = True
            self._skip_values()
        return tuple(found)

    def _bare_vector(self, first: Token) -> None:
        """Report the numbers from `first` on, of which one is still to come, as a vector without its brackets."""
        while (token := self._peek()).kind in ("number", ","):
            self._next()
        numbers = _NUMBERS.findall(self._data[first.start : self._before].decode("utf-8", "replace"))
        if token.kind == ">":
            self._next()
        edits = [((first.start, self._before), f"< {', '.join(numbers)} >")] if len(numbers) == 3 else None
        title = f"Write {edits[0][1]}" if edits else ""
        span = (first.start, self._before)
        self._fault("M3D0102", span, "a vector stands between < and >", edits=edits, title=title)
        self._doubtful = True

    def _extra_commas(self, wanted: int) -> bool:
        """Pass commas where one of the numbers that are `wanted` should stand. Among several numbers a comma is no more
        likely one too many than a number is missing: whether that was reported."""
        omitted = self._peek().kind == "," and wanted > 1
        if omitted:
            self._fault("M3D0103", self._peek().span, "found ','; a number stands before and after each comma")
            self._doubtful = True
        while self._peek().kind == ",":
            comma = self._next()
            if wanted == 1:
                self._superfluous(comma, "a keyword is followed by its value, with nothing between them")
        return omitted

    def _is_argument(self, entry: Statement | None, block: Block | None) -> bool:
        """Whether a word here is an argument, not a keyword that is written in another way."""
        token = self._peek()
        if token.kind == "{":
            return self._is_bracketed()
        if token.kind == "string":
            return self._peek(1).text not in (":", "=")
        if token.kind != "word":
            return True
        if self._peek(1).kind in ("{", "="):
            return False
        near = certain(token.text, members(block))
        return not (near and (token.first or (entry is not None and entry.is_flag)))

    def _starts_value(self) -> bool:
        token = self._peek()
        if token.kind in ("number", "<", "word", "string", "hash"):
            return True
        if token.kind == "{":
            return self._is_bracketed()
        return token.text in ("-", "+", "(", "[") or token.text in _DASHES

    def _is_bracketed(self) -> bool:
        """Whether a brace is used as the bracket of a vector or number: `{ 1, 2, 3 }`."""
        return self._peek().kind == "{" and self._peek(1).kind == "number"

    def _value(self, shape: str | None, *, table: bool = False) -> ast.Argument | None:
        """A value, and what is taken for one; None where it stands for nothing certain."""
        first = self._peek()
        value = self._operand(shape)
        if table:
            return value
        token = self._peek()
        operator = token.text in _OPERATORS and token.kind == "other"
        signed = token.kind == "number" and token.text[0] in "+-" and (not token.gap or shape is not None)
        if token.text == "%" and not self._operand_follows(1):
            self._percent(first, self._next())
            return value
        if token.kind == "other" and token.text in ("\u00b0", "\u2032", "\u2033"):
            says = f"{_found(token)}; angles are in degrees, without a unit"
            edits = [(token.span, "")] if token.text == "\u00b0" else None
            self._invalid_here(token.span, says, edits=edits, title="Remove it")
            self._next()
            return value
        if token.text in _PARTS and first.kind == "word" and self._before == first.end and not token.gap:
            self._part()
            return self._expression(first)
        if token.text == "?" or (token.kind == ">" and self._peek(1).kind in ("number", "word") and shape == "number"):
            while (token := self._peek()).kind not in ("keyword", "{", "}", "end", ";") and not token.first:
                self._next()
            return self._expression(first)
        if (operator and self._operand_follows(1)) or (signed and isinstance(value, (ast.Number, ast.Name)) and shape):
            return self._expression(first)
        return value

    def _part(self) -> None:
        """Pass what follows a name in `f(x)`, `a[0]`, `a.x` and `a::b`."""
        while (token := self._peek()).text in _PARTS and not token.gap:
            if token.text in _CLOSERS:
                self._skip_brackets()
                continue
            self._next()
            if self._peek().kind in ("word", "keyword", "number") and not self._peek().gap:
                self._next()

    def _operand_follows(self, ahead: int) -> bool:
        token = self._peek(ahead)
        return token.kind in ("number", "word", "<") or token.text in ("(", "-", "+")

    def _expression(self, first: Token) -> None:
        """The rest of an expression: reported as one."""
        while True:
            token = self._peek()
            if token.kind == "number" and token.text[0] in "+-":
                self._next()
            elif token.text in _OPERATORS and token.kind == "other" and self._operand_follows(1):
                self._next()
                while self._peek().text in ("-", "+"):
                    self._next()
                operand = self._peek()
                if operand.text in ("(", "["):
                    self._skip_brackets()
                elif operand.kind == "<":
                    self._vector_skipped()
                else:
                    self._next()
                    if self._peek().text == "(" and operand.kind == "word":
                        self._skip_brackets()
            else:
                break
        span = (first.start, self._before)
        text = self._data[span[0] : span[1]]
        result = _calculated(text)
        says = f"found {text.decode('utf-8', 'replace')!r}; write "
        says += f"its result, {result}" if result else "its result, or the name of a variable that has it"
        edits = [(span, result)] if result else None
        self._fault("M3D0118", span, says, edits=edits, title=f"Write {result}")
        self._doubtful = True

    def _percent(self, number: Token, sign: Token) -> None:
        text = _calculated(number.text.encode() + b"/100") if number.kind == "number" else None
        span = (number.start, sign.end)
        says = "found '%'; a proportion is a number between 0 and 1"
        self._invalid_here(sign.span, says, edits=[(span, text)] if text else None, title=f"Write {text}")
        self._doubtful = True

    def _operand(self, shape: str | None) -> ast.Argument | None:
        token = self._next()
        if token.kind == "number":
            return self._number(token.span)
        if token.kind == "<":
            return self._vector(token)
        if token.kind == "word":
            return self._name_or_call(token, shape)
        if token.kind == "hash":
            return self._hash(token)
        if token.kind == "string":
            return self._string_value(token)
        if token.text in _CLOSERS:
            return self._bracketed(token, shape)
        return self._sign(token)

    def _number(self, span: Span) -> ast.Number:
        base = self._findings.base
        number = numerals.read(self._data[span[0] : span[1]], span, self._findings)
        self._findings.base = base
        return number._replace(span=self._span(span))

    def _name_or_call(self, token: Token, shape: str | None) -> ast.Argument | None:
        after = self._peek()
        is_word = token.text.lower() in _VECTOR_WORDS
        if after.kind == "<" and (shape == "vector" or is_word):
            says = "leave it out: a colour is three numbers" if is_word else "a vector stands alone"
            edits = [((token.start, after.start), "")] if is_word else None
            self._invalid_here(token.span, f"{_found(token)}; {says}", edits=edits, title="Remove it")
            if not is_word:
                self._doubtful = True
            return self._vector(self._next())
        if after.text == "(" and is_word:
            bracket = self._next()
            return self._bracketed(bracket, "vector", token)
        if is_word and after.kind == "number" and shape == "vector":
            self._next()
            text = f"< {after.text}, {after.text}, {after.text} >"
            span = (token.start, after.end)
            self._fault("M3D0102", span, "a colour is three numbers", edits=[(span, text)], title=f"Write {text}")
            self._doubtful = True
            return None
        name = ast.Name(token.text, self._span(token.span))
        self._check_length(name)
        return name

    def _hash(self, token: Token) -> ast.Argument | None:
        if _HEX_COLOUR.fullmatch(token.text):
            text = _colour(token.text)
            says = f"{_found(token)}; a colour is three numbers between 0 and 1: {text}"
            self._fault("M3D0102", token.span, says, edits=[(token.span, text)], title=f"Write {text}")
        else:
            self._fault("M3D0107", token.span, _found(token))
        self._doubtful = True
        return None

    def _string_value(self, token: Token) -> ast.Argument | None:
        inner = token.text[1:-1].strip()
        if _HEX_COLOUR.fullmatch(inner):
            return self._hash(token._replace(text=inner))
        self._invalid_here(token.span, f"found {_shown(token)}; there are no texts in quotes")
        self._doubtful = True
        return None

    def _sign(self, token: Token) -> ast.Argument | None:
        after = self._peek()
        if after.kind == "number":
            self._next()
            if after.text[0] in "+-":
                return self._expression(token)
            says = f"{_found(token)}; a minus sign is -" if token.text in _DASHES else (
                f"{_found(token)}; a sign stands right before its number, without a blank"
            )  # fmt: skip
            sign = "-" if token.text in _DASHES else token.text
            edits = [((token.start, after.start), sign)]
            self._fault("M3D0103", token.span, says, edits=edits, title=f"Write {sign}{after.text}")
            number = self._number(after.span)
            return number._replace(value=-number.value if sign == "-" else number.value,
                                   span=self._span((token.start, after.end)))  # fmt: skip
        if after.kind in ("word", "<") or after.text in ("(", "-", "+"):
            self._next() if after.kind == "word" else None
            if after.kind == "<":
                self._vector_skipped()
            if after.text == "(":
                self._skip_brackets()
            says = f"{_found(token)}; a sign belongs to a number, not to a "
            says += "vector: write it in front of each" if after.kind == "<" else "variable: write another variable"
            self._fault("M3D0118", (token.start, self._before), says)
        else:
            self._invalid_here(token.span, _found(token))
        self._doubtful = True
        return None

    def _bracketed(self, opener: Token, shape: str | None, word: Token | None = None) -> ast.Argument | None:
        """A vector or number in brackets that are not those of the language."""
        closer = _CLOSERS[opener.text]
        first = word or opener
        inside: list[ast.Argument] = []
        start = self._before
        simple = True
        while (token := self._peek()).kind not in ("end", "keyword", "}") and token.text != closer:
            if token.kind in ("number", "word") and self._peek(1).text in (",", closer):
                inside += [
                    self._number(token.span) if token.kind == "number" else ast.Name(token.text, self._span(token.span))
                ]
                self._next()
            elif token.kind == "," and inside and self._peek(1).kind in ("number", "word"):
                self._next()
            else:
                simple = False
                self._next()
        end = self._before
        if self._peek().text == closer:
            self._next()
        span = (first.start, self._before)
        text = self._data[start:end].decode("utf-8", "replace").strip()
        if simple and len(inside) == 3 and not any(isinstance(each, ast.Vector) for each in inside):
            new = f"< {text} >"
            values = [each.value for each in inside if isinstance(each, ast.Number)]
            if word is not None and word.text.lower() == "rgb" and len(values) == 3 and 1 < max(values) <= 255:
                new = f"< {', '.join(f'{round(value / 255, 3):g}' for value in values)} >"
                says = f"a colour is three numbers between 0 and 1: {new}"
                self._fault("M3D0102", span, says, edits=[(span, new)], title=f"Write {new}")
                self._doubtful = True
                return None
            self._fault("M3D0102", span, "a vector stands between < and >", edits=[(span, new)], title=f"Write {new}")
            components = tuple(each for each in inside if not isinstance(each, ast.Vector))
            return ast.Vector(components, self._span(span))
        self._doubtful = True
        if simple and len(inside) == 1:
            detail = "a number stands alone, without brackets"
            self._fault(
                "M3D0103", first.span, f"{_found(first)}; {detail}", edits=[(span, text)], title=f"Write {text}"
            )
            self._doubtful = False
            return inside[0]
        if shape == "vector":
            self._fault("M3D0102", span, "a vector is three numbers < x, y, z >")
        else:
            self._expression(first)
        return None

    def _vector(self, opener: Token) -> ast.Vector | None:
        components: list[ast.Number | ast.Name] = []
        good = True
        doubled = self._peek().kind == "<" and not self._peek().gap
        if doubled:
            self._superfluous(self._next(), "a vector stands between < and >")
        while True:
            token = self._peek()
            if token.kind in ("number", "word") or token.text in ("-", "+", "(") or token.text in _DASHES:
                value = self._component(len(components))
                if value is None:
                    good = False
                    components.append(ast.Number(0.0, self._span(token.span)))
                else:
                    components.append(value)
            else:
                break
            token = self._peek()
            if token.kind == ",":
                if len(components) == 3 and self._peek(1).kind in ("number", "word"):
                    says = f"{_found(token)}; a vector has three numbers < x, y, z >"
                    if _DECIMAL_COMMA.search(self._data, opener.end, token.end):
                        says += "; a decimal point is a point, as in 2.5"
                    self._fault("M3D0101", token.span, says, fill=">")
                    self._doubtful = True
                    while self._peek().kind in (",", "number", "word"):
                        self._next()
                    break
                self._next()
            elif token.kind in ("number", "word") and len(components) < 3:
                if token.kind == "word" and (token.first or certain(token.text, LANGUAGE.keywords)):
                    break
                self._missing(",")
            else:
                break
        token = self._peek()
        count = len(components)
        if count < 3:
            says = f"{_found(token)}; a vector has three numbers < x, y, z >"
            code, fill = ("M3D0101", ",") if count else ("M3D0103", "")
            at = token.span if not token.first and token.kind != "end" else (self._before, self._before)
            self._fault(code, at, says, fill=fill)
            self._doubtful = True
            good = False
        if token.kind == ">":
            self._next()
            if doubled and self._peek().kind == ">":
                more = self._next()
                self._fault("M3D0117", more.span, "", edits=[(more.span, "")], kind="<")
        elif count >= 3 or token.kind in ("}", "keyword", "end", "word"):
            if count >= 3:
                self._close_vector(token)
        else:
            self._junk_in_vector()
        if not good or count < 3:
            return None
        return ast.Vector(tuple(components[:3]), self._span((opener.start, self._before)))

    def _close_vector(self, token: Token) -> None:
        if token.text in (")", "]"):
            self._fault("M3D0101", token.span, _found(token), fill=">", edits=[(token.span, ">")], title="Write '>'")
            self._next()
            return
        if token.kind == "number":
            self._fault("M3D0101", token.span, f"{_found(token)}; a vector has three numbers < x, y, z >", fill=">")
            self._doubtful = True
            self._junk_in_vector()
            return
        if token.kind == "other" or token.kind in (";", "string", "name", "hash"):
            self._fault("M3D0101", token.span, _found(token), fill=">")
            self._doubtful = True
            self._junk_in_vector()
            return
        self._missing(">")

    def _junk_in_vector(self) -> None:
        """Pass what is left of a vector."""
        while (token := self._peek()).kind not in (">", "}", "{", "keyword", "end", "<") and not self._ends_all(token):
            self._next()
        if token.kind == ">":
            self._next()

    def _component(self, before: int) -> ast.Number | ast.Name | None:
        """A component of a vector, of which so many stand `before` it."""
        first = self._peek()
        value = self._operand(None)
        token = self._peek()
        if token.text in _PARTS and first.kind == "word" and not token.gap:
            self._part()
            self._expression(first)
            return None
        if token.kind == "other" and token.text in _OPERATORS and self._operand_follows(1):
            self._expression(first)
            return None
        signed = token.kind == "number" and token.text[0] in "+-" and isinstance(value, (ast.Number, ast.Name))
        # With the comma there are three numbers: it is missing. Otherwise something is calculated.
        if signed and (not token.gap or self._numbers_to_close() + before + 1 != 3):
            self._expression(first)
            return None
        return value if not isinstance(value, ast.Vector) else None

    def _numbers_to_close(self) -> int:
        """How many numbers stand up to the end of the vector."""
        count = ahead = 0
        while (token := self._peek(ahead)).kind in ("number", "word", ","):
            count += token.kind != ","
            ahead += 1
        return count

    def _skip_brackets(self) -> None:
        """Pass brackets with all that is in them."""
        depth = 0
        while (token := self._peek()).kind not in ("end", "{", "}", "keyword"):
            self._next()
            depth += (token.text in ("(", "[")) - (token.text in (")", "]"))
            if depth <= 0:
                return

    def _skip_all_brackets(self) -> None:
        """Pass brackets with all that is in them, whatever it is; where they are not closed, the rest of the line."""
        lexer = Lexer(self._data, self._lexer.end, _unheard)
        lexer.at = self._peek().start
        open_ = ""
        while (token := lexer.next()).kind != "end" and not (token.first and token.text in members(None)):
            if token.text in _CLOSERS:
                open_ += token.text
            elif token.text in _CLOSERS.values():
                if _CLOSERS[open_[-1]] != token.text:
                    break
                open_ = open_[:-1]
            if not open_:
                while self._peek().start <= token.start:
                    self._next()
                return
        self._next()
        while not self._peek().first and self._peek().kind not in ("end", "}"):
            self._next()

    def _skip_values(self) -> None:
        """Pass values and what is between them."""
        while (token := self._peek()).kind in ("number", "<", ",", ">"):
            self._vector_skipped() if token.kind == "<" else self._next()

    def _vector_skipped(self) -> None:
        self._next()
        while self._peek().kind in ("number", "word", ","):
            self._next()
        if self._peek().kind == ">":
            self._next()

    # --- what belongs nowhere -----------------------------------------------------------------------------------

    def _junk(self, block: Block | None, code: str = "") -> None:
        """Pass what can not stand here, and say so."""
        token = self._next()
        after = self._peek()
        if (
            token.text in ("-", "+", "*", "\u2022")
            and after.kind in ("keyword", "word")
            and (token.first or not self._open)
        ):
            self._superfluous(token, "statements follow one another without a mark before them", sure=False)
            return
        if token.text in (".", "$", "@", "\\") and after.kind in ("keyword", "word") and not after.gap:
            self._next()
            text = token.text + after.text
            says = f"found {text!r}; {_LETTERS}"
            meant = certain(after.text, members(block)) if token.text == "." else None
            says += f"; did you mean {meant}?" if meant else ""
            self._invalid(block, (token.start, after.end), says)
            self._doubtful = True
            self._skip_unknown() if self._open else self._skip_lines()
            return
        if token.kind == ";":
            self._superfluous(token, "nothing ends with a ; but a declaration in VARIABLES")
        elif token.kind == ",":
            self._superfluous(token, "statements and blocks follow one another without a comma")
        elif token.text == "*/":
            detail = "this closes a comment that was never opened"
            self._fault(
                "M3D0105", token.span, detail, edits=[(token.span, "")], title="Remove it", kind="*/", sure=False
            )
        elif token.kind == "hash":
            self._directive(token)
        elif token.kind == "string":
            self._quoted(token, block)
        else:
            says = _found(token)
            if token.kind == "{":
                says += "; a block begins with its keyword"
            elif token.kind in ("number", "<"):
                says += "; a value stands after its keyword"
            elif token.kind == "name":
                says += f"; {_LETTERS}"
            elif (number := _other_number(token.text)) is not None:
                says += f"; a number is written with the digits 0 to 9: {number}"
            elif token.text == "~":
                says += "; a blank stands between a keyword and its value"
            elif token.text == "-" and not self._open:
                says += "; a scene needs no marks between its parts"
            elif token.kind == "other" and token.text not in _CLOSERS.values():
                says += "; it has no meaning in a scene: remove it"
            if code:
                self._fault(code, token.span, says)
            else:
                self._invalid(block, token.span, says)
            self._doubtful = True
            if token.kind == "{":
                self._ahead.insert(0, token)
                self._before = token.start
                self._skip_group()
            elif self._around and token.kind == "other":
                self._skip_unknown()
            elif not self._around and not self._open:
                self._skip_lines()

    def _directive(self, token: Token) -> None:
        """`#declare name = value;` and its like."""
        word = token.text[1:].lower()
        if word in ("declare", "local", "define", "let", "var", "const"):
            if self._peek().kind in ("word", "keyword"):
                name = self._next().text
                self.names.add(name)
                says = f"{_found(token)}; a variable is declared in VARIABLES {{ NUMBER {name}; }} and then assigned to"
            else:
                says = f"{_found(token)}; a variable is declared in VARIABLES"
        elif word in LANGUAGE.elsewhere:
            says = f"{_found(token)}; {LANGUAGE.elsewhere[word]}"
        elif not self._open and token.first:
            says = f"{_found(token)}; a comment stands between /* and */"
        else:
            says = _found(token)
        self._fault("M3D0107", token.span, says)
        self._doubtful = True
        while (next_ := self._peek()).kind not in ("end", "}", "keyword") and not next_.first:
            if next_.kind == "{":
                self._skip_group()
            elif self._next().kind == ";":
                return

    def _quoted(self, token: Token, block: Block | None) -> None:
        """A text in quotes: the name of something, as other languages have it."""
        if token.kind == "name":
            self._invalid(
                block, token.span, f"{_found(token)}; names are of the letters A to Z, digits and underscores"
            )
            self._doubtful = True
            return
        inner = token.text.strip("\"'\u201c\u201d").strip()
        edits = (
            [(token.span, f"/* {inner} */")] if "*/" not in inner and "/*" not in inner and inner.isascii() else None
        )
        says = f"found {_shown(token)}; what a thing is called stands in a comment"
        self._invalid(block, token.span, says, edits=edits, title="Make a comment of it")

    def _superfluous_marks(self) -> None:
        """An equals sign or colon between a keyword and what follows it."""
        while self._peek().text in ("=", ":"):
            self._superfluous(self._next(), "a keyword is followed by its value, with nothing between them")

    def _superfluous(self, token: Token, says: str, *, sure: bool = True) -> None:
        self._fault("M3D0117", token.span, says, fill=f"'{token.text}'", edits=[(token.span, "")],
                    title=f"Remove '{token.text}'", kind=token.text, sure=sure)  # fmt: skip

    def _missing(self, mark: str) -> None:
        """Report a punctuation mark that is missing before the next token: there, or, if that is on another line, at
        the end of this one."""
        token = self._peek()
        at = token.span if not token.first and token.kind != "end" else (self._before, self._before)
        new = mark if mark in ",;" else f" {mark}"
        edits = [((self._before, self._before), new)]
        kind = f"missing {mark}"
        # An = might make an assignment of something else; two names might be meant as one, and a sign as a sum.
        sure = mark in ";>" or (mark == "," and token.kind == "number" and token.text[0] not in "+-")
        self._fault(
            "M3D0101", at, _found(token), fill=mark, edits=edits, title=f"Insert '{mark}'", kind=kind, sure=sure
        )

    def _invalid(self, block: Block | None, span: Span, detail: str, *, edits: list[tuple[Span, str]] | None = None,
                 title: str = "", kind: str | None = None) -> None:  # fmt: skip
        code = "M3D0107" if block is None else "M3D0106"
        fill = "" if block is None else statement_of(block.keyword)
        self._fault(code, span, detail, fill=fill, edits=edits, title=title, kind=kind)

    def _invalid_here(
        self, span: Span, detail: str, *, edits: list[tuple[Span, str]] | None = None, title: str = ""
    ) -> None:
        self._invalid(
            LANGUAGE.blocks.get(self._around[-1]) if self._around else None, span, detail, edits=edits, title=title
        )

    # --- tokens and findings ------------------------------------------------------------------------------------

    def _peek(self, ahead: int = 0) -> Token:
        while len(self._ahead) <= ahead:
            self._ahead.append(self._lexer.next())
        return self._ahead[ahead]

    def _next(self) -> Token:
        token = self._peek()
        del self._ahead[0]
        self._before = token.end
        return token

    def _span(self, span: Span) -> Span:
        return span[0] - self._start, span[1] - self._start

    def _from(self, token: Token) -> Span:
        return self._span((token.start, self._before))

    def _keyword(self, token: Token) -> ast.Keyword:
        return ast.Keyword(token.text, self._span(token.span))

    def _check_length(self, name: ast.Name) -> None:
        longest = LANGUAGE.limits["identifier"]
        if len(name.text) > longest:
            span = (name.span[0] + self._start, name.span[1] + self._start)
            self._findings.add("M3D0110", span, f"at most {longest} characters, not {len(name.text)}")

    def _passed(self, kind: str, span: Span, text: str) -> None:
        """Report what is passed over like a blank."""
        if kind == "control":
            return
        if kind == "blank":
            says = f"found a {text}; an ordinary blank looks the same"
            self._fault("M3D0119", span, says, edits=[(span, " ")],
                        title="Write a blank", kind="blank")  # fmt: skip
            return
        if kind == "conflict":
            says = f"{text[:7]} is a mark of two versions that could not be merged: keep one, and remove the marks"
            self._fault("M3D0107", span, says, kind="conflict")
            return
        mark = re.match(r"//+|#+!?|<!--|--|%+|;+", text)
        assert mark is not None
        inner = text[mark.end() :].removesuffix("-->").strip()
        edits = [(span, f"/* {inner} */")] if "*/" not in inner and "/*" not in inner else None
        self._fault("M3D0116", span, "a comment stands between /* and */", edits=edits,
                    title="Write /* */", kind="comment")  # fmt: skip

    def _fault(
        self,
        code: str,
        span: Span,
        detail: str,
        *,
        fill: str = "",
        related: tuple[Related, ...] = (),
        edits: list[tuple[Span, str]] | None = None,
        title: str = "",
        kind: str | None = None,
        sure: bool = True,
    ) -> None:
        """Report a fault, with the edits that mend it, for certain if that is `sure`; of a `kind` only the first of an
        item."""
        if kind is not None and kind in self._habits:
            habit = self._habits[kind]
            if habit.edits is not None and edits is not None:
                habit.edits.extend(edit for edit in edits if edit not in habit.edits)
            elif habit.edits is not None:
                habit.edits.clear()
            return
        if len(self._findings.found) >= self._most:
            raise _TooManyError
        index = len(self._findings.found)
        self._findings.add(code, span, detail, fill=fill, related=related)
        self._habits[kind or f"#{index}"] = _Habit(index, title, None if edits is None else list(edits), sure)

    def _settle(self) -> None:
        """Give what was reported of the item its fixes."""
        for habit in self._habits.values():
            edits = [_apart(self._data, edit) for edit in sorted(habit.edits or ())]
            if not edits or habit.place >= len(self._findings.found):
                continue
            (start, _), (_, end) = edits[0][0], edits[-1][0]
            if end - start > _LONG_FIX:
                continue
            try:
                text = _edited(self._data, edits).decode("utf-8")
            except UnicodeDecodeError:
                continue
            title = habit.title if len(edits) == 1 else f"{habit.title} ({len(edits)} places)"
            diagnostic = self._findings.found[habit.place]
            self._findings.found[habit.place] = diagnostic._replace(fix=Fix(title, (start, end), text, habit.certain))
        self._habits = {}


def _unheard(kind: str, span: Span, text: str) -> None:
    """Of what is passed over in looking ahead nothing is said."""


def _apart(data: bytes, edit: tuple[Span, str]) -> tuple[Span, str]:
    """An edit with a blank where without it two words or numbers would become one, as in `RADIUS=2` without its `=`."""
    (start, end), new = edit
    left, right = data[start - 1 : start], data[end : end + 1]
    glued = new[-1].isalnum() and right.isalnum() if new else _WORDISH.match(left) and _WORDISH.match(right)
    return (edit[0], f"{new} ") if glued and end > start else edit


def _edited(data: bytes, edits: list[tuple[Span, str]]) -> bytes:
    """The text from the first edit to the last, with all of them made."""
    pieces: list[bytes] = []
    at = edits[0][0][0]
    for (start, end), new in edits:
        pieces += [data[at:start], new.encode()]
        at = end
    return b"".join(pieces)


def _found(token: Token) -> str:
    return "found the end of the text" if token.kind == "end" else f"found {_shown(token)}"


def _shown(token: Token) -> str:
    return repr(token.text if len(token.text) <= 40 else f"{token.text[:37]}...")


def _other_number(text: str) -> str | None:
    """What a digit or fraction is worth that is none of 0 to 9, as a numeral; None for any other text."""
    value = unicodedata.numeric(text, None) if len(text) == 1 else None
    return None if value is None else f"{value:.6g}"


def _some(keywords: Iterable[str], most: int = 6) -> str:
    """Keywords, but not more of them than one reads."""
    words = list(dict.fromkeys(keywords))
    return ", ".join(words) if len(words) <= most else ", ".join([*words[: most - 1], ".."])


def _closing(data: bytes, opened: int, end: int) -> str:
    """A closing brace for the block whose brace is `opened`: on a line of its own, indented like the line on which that
    one stands, if the block has several lines."""
    if b"\n" not in data[opened:end]:
        return " }"
    line = data.rfind(b"\n", 0, opened) + 1
    margin = data[line:opened]
    indent = margin[: len(margin) - len(margin.lstrip())].decode("ascii", "replace")
    return f"\n{indent}}}"


def _indent(data: bytes, offset: int) -> int:
    """How far the line of a byte is indented, in columns."""
    line = data.rfind(b"\n", max(offset - 10_000, 0), offset) + 1
    margin = data[line:offset]
    return len(margin[: len(margin) - len(margin.lstrip())].expandtabs())


def _colour(text: str) -> str:
    """A hexadecimal colour as a vector: `#ff8000` as `< 1, 0.502, 0 >`."""
    digits = text[1:] if len(text) == 7 else "".join(2 * digit for digit in text[1:])
    parts = (int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4))
    return f"< {', '.join(f'{round(part, 3):g}' for part in parts)} >"


_CONSTANT = re.compile(rb"[0-9eE+\-*/.() \t]+")


def _calculated(text: bytes) -> str | None:
    """What an expression of numerals is worth, as a numeral; None for any other."""
    import ast as python

    if not _CONSTANT.fullmatch(text) or len(text) > 100 or b"**" in text or b"//" in text:
        return None
    try:
        tree = python.parse(text.strip().decode(), mode="eval")
        value = _worth(tree.body)
    except (SyntaxError, ValueError, ZeroDivisionError, OverflowError, RecursionError):
        return None
    written = f"{value:.15g}"
    return written if (abs(value) < 1e300 and float(written) == value) or abs(value) < 1e6 else None


def _worth(node: object) -> float:
    import ast as python

    match node:
        case python.Constant(value=int() | float() as value):
            return float(value)
        case python.UnaryOp(op=python.USub(), operand=operand):
            return -_worth(operand)
        case python.UnaryOp(op=python.UAdd(), operand=operand):
            return _worth(operand)
        case python.BinOp(left=left, op=python.Add(), right=right):
            return _worth(left) + _worth(right)
        case python.BinOp(left=left, op=python.Sub(), right=right):
            return _worth(left) - _worth(right)
        case python.BinOp(left=left, op=python.Mult(), right=right):
            return _worth(left) * _worth(right)
        case python.BinOp(left=left, op=python.Div(), right=right):
            return _worth(left) / _worth(right)
        case _:
            raise ValueError
