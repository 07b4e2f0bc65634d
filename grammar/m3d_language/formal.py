"""The formal grammar at work: where a text stops being a sentence of the language, and what could stand there.

tree-sitter builds every syntax tree; a stretch of text that holds an error is read again here, by the LALR(1) automaton
that Lark makes of m3d.lark when the project is generated. Lark itself is not needed for it.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, cast

from .comments import blank_comments
from .files import data_file
from .table import LANGUAGE

if TYPE_CHECKING:
    from lark import Lark

AUTOMATON_FILE = Path(__file__).with_name("automaton.json")
END = "$END"
_PUNCTUATION = {
    "{": "LBRACE",
    "}": "RBRACE",
    "<": "LANGLE",
    ">": "RANGLE",
    ",": "COMMA",
    ";": "SEMICOLON",
    "=": "EQUAL",
}
_TOKEN = re.compile(
    r"""[ \t\r\n\f\v]*  # then, if anything: a numeral, a word, a mark, or what begins none of them
        (?: (?P<numeral> [+-]?\.?[0-9] (?: [eE][+-] | [A-Za-z0-9_.] )* )
          | (?P<word> [A-Za-z][A-Za-z0-9_]* )
          | (?P<mark> [{}<>,;=] )
          | (?P<other> /\* | \*/ | [^ \t\r\n\f\v] ) )""",
    re.VERBOSE,
)
_NUMERAL = re.compile(r"[+-]?[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?")


class SyntaxFault(NamedTuple):
    """The first place where a text stops being a sentence.

    `offset` and `length` are those of the token that does not fit, in characters; at the end of the text the length is
    0. `expected` are the terminals of m3d.lark that could stand there: a keyword, `IDENTIFIER`, `NUMERAL`, `LBRACE`,
    `RBRACE`, `LANGLE`, `RANGLE`, `COMMA`, `SEMICOLON`, `EQUAL`, or `$END` for the end of the text. `block` is the
    keyword of the innermost block or table around it; None at top level and in the body of an assignment.
    """

    offset: int
    length: int
    expected: frozenset[str]
    block: str | None


def first_error(text: str) -> SyntaxFault | None:
    """Where the text stops being a sentence, or None when it is one. An unclosed comment is an error at its start."""
    machine = automaton()
    stack = [0]
    blocks: list[str | None] = []
    keyword: str | None = None
    for offset, length, terminal in tokens(blank_comments(text)):
        after = machine.feed(stack, terminal)
        if after is None:
            return SyntaxFault(offset, length, machine.accepts(stack), blocks[-1] if blocks else None)
        stack = after
        if terminal == "LBRACE":
            blocks.append(keyword)
        elif terminal == "RBRACE":
            blocks.pop()
        elif terminal == "EQUAL":
            keyword = None
        elif terminal in LANGUAGE.keywords:
            keyword = terminal
    return None


@cache
def parser() -> Lark:
    """Lark's own parser of m3d.lark, for other uses: it takes half a second to make."""
    from lark import Lark

    return Lark(data_file("m3d.lark").read_text(encoding="utf-8"), parser="lalr", lexer="contextual")


def tokens(text: str) -> Iterator[tuple[int, int, str]]:
    """The offset, the length and the terminal of every token, and `$END`. What is no token has the terminal ''."""
    at = 0
    while match := _TOKEN.match(text, at):
        at = match.end()
        found = cast(str, match[cast(str, match.lastgroup)])
        match match.lastgroup:
            case "numeral":
                terminal = "NUMERAL" if _NUMERAL.fullmatch(found) else ""
            case "word":
                terminal = found if found in LANGUAGE.keywords else "IDENTIFIER"
            case "mark":
                terminal = _PUNCTUATION[found]
            case _:
                terminal = ""
        yield at - len(found), len(found), terminal
    yield len(text), 0, END


# Either the one rule to reduce by, as -1 - rule, or what each terminal and each nonterminal leads to.
_State = int | Sequence[Mapping[str, int]]


class Automaton(NamedTuple):
    """An LALR(1) automaton; its stack is the list of states."""

    states: Sequence[_State]
    rules: Sequence[tuple[str, int]]
    end: int

    def feed(self, stack: Sequence[int], terminal: str) -> list[int] | None:
        """The stack after one more terminal; None: it can not stand here."""
        after = list(stack)
        while True:
            state = self.states[after[-1]]
            action = state if isinstance(state, int) else state[0].get(terminal)
            if action is None:
                return None
            if action >= 0:
                after.append(action)
                return after
            nonterminal, length = self.rules[-1 - action]
            if length:
                del after[-length:]
            state = self.states[after[-1]]
            assert not isinstance(state, int)
            after.append(state[1][nonterminal])
            if terminal == END and after[-1] == self.end:
                return after

    def accepts(self, stack: Sequence[int]) -> frozenset[str]:
        """Every terminal that can stand next."""
        terminals = (*LANGUAGE.keywords, *_PUNCTUATION.values(), "IDENTIFIER", "NUMERAL", END)
        return frozenset(terminal for terminal in terminals if self.feed(stack, terminal) is not None)


@cache
def automaton() -> Automaton:
    """The automaton of m3d.lark."""
    table = json.loads(AUTOMATON_FILE.read_text(encoding="utf-8"))
    return Automaton(table["states"], table["rules"], table["end"])
