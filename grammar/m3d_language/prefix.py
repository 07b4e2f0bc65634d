"""The beginning of a text, up to a cursor: what is open there, what was begun, and what could stand next.

What a person is typing is rarely a sentence. Where a token does not fit, the member that it interrupts is given up, or
else the token is passed over, so that a mistake further up does not hide what may stand at the cursor.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NamedTuple

from .comments import blank_comments
from .formal import END, automaton, tokens
from .table import LANGUAGE

# What is meant as a numeral, though it lacks a digit or has a letter too many.
_BROKEN_NUMERAL = re.compile(r"[+-]?\.?[0-9]")


class Token(NamedTuple):
    """A token, the name of its terminal in m3d.lark, and its offset in characters."""

    text: str
    terminal: str
    offset: int


class Opened(NamedTuple):
    """An open brace: what its block, table or assignment begins with. For a brace that fits nowhere `start` is None."""

    start: Token | None

    @property
    def keyword(self) -> str | None:
        """The keyword of the block or table; None for the body of an assignment."""
        is_keyword = self.start is not None and self.start.terminal != "IDENTIFIER"
        return self.start.text if self.start is not None and is_keyword else None

    @property
    def target(self) -> str | None:
        """The variable that the body is assigned to."""
        is_target = self.start is not None and self.start.terminal == "IDENTIFIER"
        return self.start.text if self.start is not None and is_target else None


class Prefix(NamedTuple):
    """What is known at the end of the beginning of a text.

    `expected` are the terminals that could stand next, as in a SyntaxFault; none where what is open is no block of
    the language, or in a comment. `opened` are the open braces from the outermost inwards. `member` are the tokens of
    what was begun and may go on: a statement with its arguments so far, a declaration, an assignment, or, in a table,
    all that it holds. `instead` are the terminals that could stand next if that had not been begun.
    """

    expected: frozenset[str]
    opened: tuple[Opened, ...]
    member: tuple[Token, ...]
    instead: frozenset[str]


NOTHING = Prefix(frozenset(), (), (), frozenset())


def read_prefix(text: str) -> Prefix:
    """Read a text up to its end, where the cursor is."""
    blanked = blank_comments(text)
    reader = _Reader()
    for offset, length, terminal in tokens(blanked):
        if terminal == END:
            break
        token = Token(blanked[offset : offset + length], terminal, offset)
        if not terminal and _BROKEN_NUMERAL.match(token.text):
            token = token._replace(terminal="NUMERAL")
        if token.text == "/*":
            return NOTHING
        reader.take(token)
    return reader.prefix()


@dataclass(slots=True)
class _Begun:
    """A member: its tokens so far, the stack when it was begun, and the member before it, which may go on when this
    one is given up. At the beginning of a body, and between two members, there are no tokens."""

    tokens: list[Token]
    before: list[int]
    earlier: _Begun | None = None

    def given_up(self) -> _Begun:
        return self.earlier or _Begun([], self.before)


class _Reader:
    def __init__(self) -> None:
        self._machine = automaton()
        self._restart()

    def _restart(self) -> None:
        self._stack = [0]
        self._begun = _Begun([], [0])
        self._opened: list[Opened] = []
        self._last: Token | None = None

    def prefix(self) -> Prefix:
        known = not (self._opened and self._opened[-1].start is None)
        expected = self._machine.accepts(self._stack) if known else frozenset[str]()
        instead = self._machine.accepts(self._begun.before) if known else frozenset[str]()
        return Prefix(expected, tuple(self._opened), tuple(self._begun.tokens), instead)

    def take(self, token: Token) -> None:
        """Go on by one token, whether it fits or not."""
        self._take(token)
        self._last = token

    def _take(self, token: Token) -> None:
        if self._opened and self._opened[-1].start is None:
            if not self._starts_anew(token):
                self._in_the_unknown(token)
                return
            self._restart()
        stack = self._stack
        after = self._machine.feed(stack, token.terminal)
        if after is None:
            stack = self._begun.before
            after = self._machine.feed(stack, token.terminal)
            if after is not None:
                self._begun = self._begun.given_up()
        if after is None and token.terminal == "LBRACE" and self._in_small_letters():
            stack = self._stack
            after = self._machine.feed(stack, token.terminal)
        if after is None and self._starts_anew(token):
            self._restart()
            stack = self._stack
            after = self._machine.feed(stack, token.terminal)
        if after is None:
            if token.terminal == "LBRACE":
                self._opened.append(Opened(None))
            return
        self._go_on(token, stack, after)

    def _in_small_letters(self) -> bool:
        """Whether the last token is a keyword but for its letters; it is read as that, if it fits so."""
        last = self._last
        if last is None or last.terminal != "IDENTIFIER" or last.text.upper() not in LANGUAGE.keywords:
            return False
        keyword = last._replace(text=last.text.upper(), terminal=last.text.upper())
        stack = self._begun.before
        after = self._machine.feed(stack, keyword.terminal)
        if after is None:
            return False
        self._begun = self._begun.given_up()
        self._go_on(keyword, stack, after)
        return True

    def _go_on(self, token: Token, stack: list[int], after: list[int]) -> None:
        match token.terminal:
            case "LBRACE":
                tokens = self._begun.tokens
                self._opened.append(Opened(tokens[0] if tokens else None))
                self._begun = _Begun([], after)
            case "RBRACE":
                self._opened.pop()
                self._begun = _Begun([], after)
            case "SEMICOLON":
                self._begun = _Begun([], after)
            case _:
                if self._begins(token):
                    self._begun = _Begun([], stack, self._begun)
                self._begun.tokens.append(token)
        self._stack = after

    def _begins(self, token: Token) -> bool:
        """Whether a token that fits is the first of a member."""
        if token.terminal in LANGUAGE.keywords:
            return True
        if token.terminal != "IDENTIFIER" or self._opened:
            return False
        # At top level a name is the target of an assignment, unless it goes on with what was begun.
        tokens = self._begun.tokens
        last = tokens[-1].terminal if tokens else ""
        return last not in ("EQUAL", "LANGLE", "COMMA") and last not in LANGUAGE.keywords

    def _starts_anew(self, token: Token) -> bool:
        """Whether a token is what stands at the top level alone, so that what is open must have been left open."""
        declares = any(opened.keyword == "VARIABLES" for opened in self._opened)
        return token.terminal in LANGUAGE.top and not (declares and token.terminal in LANGUAGE.types)

    def _in_the_unknown(self, token: Token) -> None:
        """In a brace that fits nowhere only braces count."""
        if token.terminal == "LBRACE":
            self._opened.append(Opened(None))
        elif token.terminal == "RBRACE":
            self._opened.pop()
