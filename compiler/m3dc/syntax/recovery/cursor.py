"""Where the reading of a broken text is: the tokens that come next, and what is open there."""

from __future__ import annotations

from m3d_language.comments import blank_comments
from m3d_language.table import LANGUAGE

from ...diagnostics import Related, catalogue
from ...text.span import Local, Span
from .. import ast
from . import wording
from .faults import Faults
from .lexer import Lexer, Token
from .limit import Budget

_BYTES_PER_TOKEN = 32  # that can be looked at as a whole while one token is made


class Cursor:
    """A place among the tokens of a text, and the item that is being read there. Places are bytes of the text; the
    spans of an item's nodes count from its start."""

    data: bytes
    lexer: Lexer
    faults: Faults
    start: int
    """Where the item begins."""
    before: int
    """Where the last token ended."""
    around: list[str]
    """The keywords of the blocks around this place."""
    open: list[Token]
    """The braces that are open."""
    doubtful: bool
    """Whether it was not certain what the item means."""
    unclosed_block: bool
    """Whether one of the item's blocks is not closed."""
    strict: bool
    """Whether every keyword of the top level ends the item."""
    closed: bool
    """Whether braces are taken to be where the indentation says."""
    nested_top: bool
    """Whether something of the top level stood within a block."""
    too_deep: bool
    """Whether blocks were nested too deeply."""
    misfit: int | None
    """Where something begins that stands in the block around this one."""

    def __init__(self, data: bytes, end: int, faults: Faults, whole: set[int], types: dict[str, str]) -> None:
        self.data = data
        self.faults = faults
        self.lexer = Lexer(data, end, faults.report_passed, Budget(end))
        self.cut = end < len(data)
        self.whole = whole  # where the items begin that the tree has without an error
        self.types = types  # of variables, by name
        self.names: set[str] = set()  # that may be declared or assigned to
        self.blocks: dict[int, tuple[str, int]] = {}  # by the starts of top-level blocks, keyword and closing brace
        self.in_directive = False  # whether one as `#if` has been reported, of which `#else` and `#end` are parts
        self._ahead: list[Token] = []
        self.begin(0)

    def begin(self, start: int) -> None:
        """Start to read the item at a byte, from nothing."""
        self.start = start
        self.jump(start)
        self.around = []
        self.open = []
        self.doubtful = False
        self.unclosed_block = False
        self.strict = False
        self.closed = False
        self.nested_top = False
        self.too_deep = False
        self.misfit = None

    def jump(self, start: int) -> None:
        """Go on with the token at a byte."""
        self.lexer.at = self.before = start
        self._ahead = []

    def hyphened(self) -> Token:
        """The word that comes next, with all that hyphens join to it, passed."""
        word = self.next()
        while self.hyphen_follows(0):
            self.next()
            if self.peek().kind in ("word", "keyword"):
                self.next()
        return word._replace(end=self.before, text=self.data[word.start : self.before].decode("utf-8", "replace"))

    def hyphen_follows(self, ahead: int) -> bool:
        """Whether the token so many ahead is a hyphen that joins words."""
        hyphen, after = self.peek(ahead), self.peek(ahead + 1)
        joined = hyphen.text == "-" and after.kind in ("word", "keyword") and not after.gap
        return not hyphen.gap and (joined or (hyphen.kind == "number" and hyphen.text[0] == "-"))

    def peek(self, ahead: int = 0) -> Token:
        """The token that comes next, or so many after it."""
        while len(self._ahead) <= ahead:
            self._ahead.append(self.lexer.next())
        return self._ahead[ahead]

    def next(self) -> Token:
        """The token that comes next, and past it."""
        token = self.peek()
        del self._ahead[0]
        self.before = token.end
        return token

    def push_back(self, token: Token) -> None:
        """Let a token that was passed come next again."""
        self._ahead.insert(0, token)
        self.before = token.start

    def place(self, token: Token) -> Span:
        """Where what should stand before the next token is missing: there, or, if that is on another line, at the end
        of this one."""
        return token.span if not token.first and token.kind != "end" else (self.before, self.before)

    def look(self, start: int, end: int | None = None) -> Lexer:
        """The tokens from a byte on, to look at and not to pass."""
        lexer = Lexer(self.data, self.lexer.end if end is None else end, _unheard, self.lexer.budget)
        lexer.at = start
        return lexer

    def relative(self, span: Span) -> Local:
        """A span of the text, from the start of the item."""
        return Local(span[0] - self.start, span[1] - self.start)

    def since(self, token: Token) -> Local:
        """From a token up to here, from the start of the item."""
        return self.relative((token.start, self.before))

    def keyword(self, token: Token) -> ast.Keyword:
        """The node of a keyword."""
        return ast.Keyword(token.text, self.relative(token.span))

    def check_length(self, name: ast.Name) -> None:
        """Report a name that is too long."""
        longest = LANGUAGE.limits["identifier"]
        if len(name.text) > longest:
            detail = f"at most {longest} characters, not {len(name.text)}"
            self.faults.findings.add(catalogue.NAME_TOO_LONG, name.span.within(self.start), detail)

    def ends_all(self, token: Token) -> bool:
        """Whether a token, within a block, begins an item of the top level: the block is not closed then."""
        top = token.text in LANGUAGE.top or token.text == "VARIABLES"
        assigns = token.kind == "word" and self.peek(1).kind == "="
        if not (top and token.kind == "keyword") and not assigns:
            return False
        return (self.strict and (top or token.first)) or (token.first and self.is_outside(token))

    def is_outside(self, token: Token) -> bool:
        """Whether the line of a token is indented no more than the one the item begins on."""
        return indent(self.data, token.start) <= indent(self.data, self.start)

    def report_unclosed(self, opened: Token, at: int, detail: str) -> None:
        """Report that the block of an opening brace should be closed at a byte."""
        begin = opened.start
        self.unclosed_block = True
        related = (Related((begin, begin + 1), "the block that is open begins here"),)
        new = _closing(self.data, begin, at)
        self.faults.add(
            catalogue.MISSING_MARK,
            (at, at),
            detail,
            fill="}",
            related=related,
            edits=[((at, at), new)],
            title="Close the block",
            sure=False,
        )

    def missing(self, mark: str) -> None:
        """Report a punctuation mark that is missing before the next token."""
        token = self.peek()
        new = mark if mark in ",;" else f" {mark}"
        edits = [((self.before, self.before), new)]
        kind = f"missing {mark}"
        # An = might make an assignment of something else; two names might be meant as one, and a sign as a sum.
        sure = mark in ";>" or (mark == "," and token.kind == "number" and token.text[0] not in "+-")
        self.faults.add(
            catalogue.MISSING_MARK,
            self.place(token),
            wording.found(token),
            fill=mark,
            edits=edits,
            title=f"Insert '{mark}'",
            kind=kind,
            sure=sure,
        )

    def invalid_here(
        self, span: Span, detail: str, *, edits: list[tuple[Span, str]] | None = None, title: str = ""
    ) -> None:
        """Report a fault of the block around this place."""
        self.faults.invalid(
            LANGUAGE.blocks.get(self.around[-1]) if self.around else None, span, detail, edits=edits, title=title
        )

    def superfluous_marks(self) -> None:
        """An equals sign or colon between a keyword and what follows it."""
        while self.peek().text in ("=", ":"):
            self.faults.superfluous(self.next(), "a keyword is followed by its value, with nothing between them")

    def blanked(self, start: int, end: int) -> str:
        """A stretch of text, a character a byte, without its comments and the braces that are ignored."""
        self.lexer.budget.spend((end - start) // _BYTES_PER_TOKEN)
        text = bytearray(self.data[start:end])
        for at in self.lexer.ignored:
            if start <= at < end:
                text[at - start] = 0x20
        return blank_comments(text.decode("latin-1"))


def _closing(data: bytes, opened: int, end: int) -> str:
    """A closing brace for the block whose brace is `opened`: on a line of its own, indented like the line on which that
    one stands, if the block has several lines."""
    if b"\n" not in data[opened:end]:
        return " }"
    line = data.rfind(b"\n", 0, opened) + 1
    margin = data[line:opened]
    indent = margin[: len(margin) - len(margin.lstrip())].decode("ascii", "replace")
    return f"\n{indent}}}"


def indent(data: bytes, offset: int) -> int:
    """How far the line of a byte is indented, in columns."""
    line = data.rfind(b"\n", max(offset - 10_000, 0), offset) + 1
    margin = data[line:offset]
    return len(margin[: len(margin) - len(margin.lstrip())].expandtabs())


def _unheard(kind: str, span: Span, text: str) -> None:
    """Of what is passed over in looking ahead nothing is said."""
