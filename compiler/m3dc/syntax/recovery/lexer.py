"""The tokens of a text that may be broken: what is a token of no scene is one here all the same, or is passed over like
a blank, and reported (a comment of another language, a control character, a no-break space)."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator
from typing import NamedTuple

from m3d_language.table import LANGUAGE

from ...text.span import Span
from .limit import Budget

_BLANKS = re.compile(rb"[ \t\r\n\f\v]*")
_TOKEN = re.compile(
    rb"""(?P<number> [+-]?\.?[0-9] (?: [eE][+-] | [A-Za-z0-9_.] )*+ )
       | (?P<word> [A-Za-z][A-Za-z0-9_]* )
       | (?P<comment> /(?!/\*)/ (?: (?!/\*|\*/) [^\r\n] )* | <!--.*?--> | \#(?=[\s\#!]|\Z) (?: (?!/\*|\*/) [^\r\n] )*
            | --(?=[ ]) (?: (?!/\*|\*/) [^\r\n] )* )
       | (?P<remark> %+[ \t]+[A-Za-z] (?: (?!/\*|\*/) [^\r\n] )*
            | ;+[ \t]+[A-Za-z] (?: (?!/\*|\*/) [^\r\n{}<>=;] )* (?=[\r\n]|\Z) )
       | (?P<conflict> (?<![^\r\n]) (?: <{7} | ={7} | >{7} ) (?=[ \r\n]|\Z) (?: (?!/\*|\*/) [^\r\n] )* )
       | (?P<mark> [{}<>,;=] )
       | (?P<string> \"\"\".*?\"\"\" | '''.*?''' | "[^"\r\n]*" | '[^'\r\n]*' | \xe2\x80\x9c[^\r\n]*?\xe2\x80\x9d )
       | (?P<hash> \#[A-Za-z0-9_]+ )
       | (?P<control> [\x00-\x08\x0e-\x1f\x7f] )
       | (?P<other> \*/ | \*\*(?!/) | [-+*/]= | \+\+ | :: | [\xc2-\xf4][\x80-\xbf]+ | . )""",
    re.VERBOSE | re.DOTALL,
)
_BEFORE = re.compile(rb"(?:\A|[\r\n{}])[ \t]*\Z")
_COMMENT_MARK = re.compile(rb"/\*|\*/")
_NAME_GOES_ON = re.compile(rb"(?:[A-Za-z0-9_]|[\xc2-\xf4][\x80-\xbf]+)++")
# A numeral, which is passed over, or a word with what makes it the target of an assignment.
_WORD = re.compile(rb"[+-]?\.?[0-9](?:[eE][+-]|[A-Za-z0-9_.])*+|([A-Za-z][A-Za-z0-9_]*)(\s*=)?")
_TYPED = re.compile(rb"[A-Za-z0-9_.+-]*\Z")
_REST = re.compile(rb"[A-Za-z0-9_.]*")
_LONGEST_TYPED = 300

CLOSERS = {"(": ")", "[": "]", "{": "}"}


class Token(NamedTuple):
    """`kind` is `keyword`, `word`, `number`, `string`, `hash`, `end`, the punctuation mark itself, `name` for a word
    with letters that no name has, or `other` for any other character. `first` on its line; after a `gap`."""

    kind: str
    start: int
    end: int
    text: str
    first: bool
    gap: bool

    @property
    def span(self) -> Span:
        return self.start, self.end


# Told what is passed over: its kind (`comment`, `control`, `blank`, `conflict`), place and text.
Passed = Callable[[str, Span, str], None]


class Lexer:
    """Reads tokens from byte `at` on, up to `end`. Of the bytes in `ignored` nothing is made; at each of the places
    `closed`, in order, a `}` is read that is not there."""

    def __init__(self, data: bytes, end: int, passed: Passed, budget: Budget) -> None:
        self.data = data
        self.end = end
        self.budget = budget
        self.at = 0
        self.ignored: set[int] = set()
        self.closed: list[int] = []
        self._passed = passed

    def next(self) -> Token:
        """The token that comes next, and past it."""
        self.budget.spend(1)
        data, before = self.data, self.at
        at = before
        while True:
            blanks = _BLANKS.match(data, at)
            at = blanks.end() if blanks else at
            if self.closed and self.closed[0] <= at:
                return self._token("}", self.closed.pop(0), 0, before)
            if at >= self.end:
                return self._token("end", self.end, 0, before)
            if at in self.ignored:
                at += 1
                continue
            if data.startswith(b"/*", at):
                at = comment_end(data, at) or self.end
                continue
            match = _TOKEN.match(data, at)
            assert match is not None
            kind, length = str(match.lastgroup), min(match.end(), self.end) - at
            if kind == "remark":
                if self._is_remark(at, at + length):
                    kind = "comment"
                else:
                    kind, length = "mark" if data[at : at + 1] == b";" else "other", 1
            if kind in ("comment", "control", "conflict"):
                self._passed(kind, (at, at + length), self._text(at, at + length))
                at += length
                continue
            if kind == "other" and (blank := self._blank(at, at + length)):
                self._passed("blank", (at, at + length), blank)
                at += length
                continue
            return self._classified(kind, at, length, before)

    def _is_remark(self, start: int, end: int) -> bool:
        """Whether what begins with % or ; is a comment: it stands alone on its line, or % after a brace, and does not
        begin with a keyword."""
        before = self.data[max(start - 100, 0) : start]
        if not (_BEFORE.search(before) or (start <= 100 and not before.strip())):
            return False
        if self.data[start : start + 1] == b";" and before.rstrip(b" \t")[-1:] in (b"{", b"}"):
            return False
        return self._text(start, end).lstrip("%; \t").split()[0] not in LANGUAGE.keywords

    def _classified(self, kind: str, at: int, length: int, before: int) -> Token:
        text = self._text(at, at + length)
        if kind == "mark":
            return self._token(text, at, length, before)
        if kind == "word" and self.data[at + length : at + length + 1].isascii():
            return self._token("keyword" if text in LANGUAGE.keywords else "word", at, length, before)
        if kind == "word" or (kind == "other" and (text == "_" or text.isalpha())):
            more = _NAME_GOES_ON.match(self.data, at)
            whole = self._text(at, more.end()) if more else text
            letters = len(next((whole[:i] for i, c in enumerate(whole) if not (c.isalnum() or c == "_")), whole))
            whole = whole[:letters]
            if kind == "other" or len(whole) > len(text):
                return self._token("name", at, len(whole.encode()), before)
            kind = "keyword" if text in LANGUAGE.keywords else "word"
        return self._token(kind, at, length, before)

    def _token(self, kind: str, start: int, length: int, before: int) -> Token:
        self.at = max(start + length, before)
        gap = self.data[before:start]
        return Token(kind, start, start + length, self._text(start, start + length), b"\n" in gap, bool(gap))

    def _text(self, start: int, end: int) -> str:
        return self.data[start:end].decode("utf-8", "replace")

    def _blank(self, start: int, end: int) -> str:
        """What a character is called that looks like none or like a blank; "" for any other."""
        text = self._text(start, end)
        if len(text) != 1 or unicodedata.category(text) not in ("Zs", "Zl", "Zp", "Cf", "Cc"):
            return ""
        return unicodedata.name(text, f"character U+{ord(text):04X}").lower()


def comment_end(data: bytes, start: int) -> int | None:
    """Where the comment ends that begins at a byte; None where it is never closed."""
    depth = 0
    for mark in _COMMENT_MARK.finditer(data, start):
        depth += 1 if mark[0] == b"/*" else -1
        if depth == 0:
            return mark.end()
    return None


def next_tokens(data: bytes, start: int, count: int) -> list[Token]:
    """The first few tokens of a text from a byte on, fewer where it ends before."""
    lexer = Lexer(data, len(data), lambda _kind, _span, _text: None, Budget(len(data)))
    lexer.at = start
    found = (lexer.next() for _ in range(count))
    return [token for token in found if token.kind != "end"]


class Word(NamedTuple):
    """A word of a text, and whether an equals sign stands behind it."""

    text: str
    span: Span
    is_target: bool


def words(data: bytes, start: int, end: int) -> Iterator[Word]:
    """The keywords and names in a part of a text, whatever stands about them, those in comments too."""
    for match in _WORD.finditer(data, start, end):
        if match[1] is not None:
            yield Word(match[1].decode("ascii"), match.span(1), match[2] is not None)


def word_start(data: bytes, offset: int) -> int:
    """Where the word or numeral begins that ends at a byte; the byte itself where none does."""
    before = _TYPED.search(data[max(offset - _LONGEST_TYPED, 0) : offset])
    return offset - len(before[0]) if before else offset


def word_end(data: bytes, offset: int) -> int:
    """Where the word or numeral ends that a byte is in; the byte itself where it is in none."""
    rest = _REST.match(data, offset)
    return rest.end() if rest else offset
