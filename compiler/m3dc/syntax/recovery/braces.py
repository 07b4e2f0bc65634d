"""Where a brace was most likely forgotten or written once too often: what the indentation says when the braces of a
text do not match.

A block's members are indented more than the line it begins on, and its closing brace is not indented less. Where a
line breaks that rule while a block is open, its closing brace is missing before that line; a closing brace that is
indented more than the line its block begins on is one too many. If the rule is broken more often than braces are
missing, the text is not laid out by it, and nothing is said.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

_TOKEN = re.compile(r"[{}]|[^\s{}]+")
_LINE = re.compile(r"\S(?:.*\S)?")


class BraceFault(NamedTuple):
    """A brace that is missing at `offset`, where the one at `opened` should be closed; or one too many at `offset`."""

    missing: bool
    offset: int
    opened: int


class _Token(NamedTuple):
    text: str
    start: int
    end: int
    line: int
    indent: int  # of its line
    first: bool  # on its line


class _Open(NamedTuple):
    offset: int
    line: int
    indent: int


def brace_faults(text: str) -> list[BraceFault]:
    """The braces missing or too many in a text whose comments are blanked out; none where that can not be told."""
    surplus = text.count("{") - text.count("}")
    if surplus == 0:
        return []
    faults = list(_missing(text) if surplus > 0 else _too_many(text))
    return faults if len(faults) == abs(surplus) else []


def _tokens(text: str) -> Iterator[_Token]:
    """The tokens of a text; those of a line without a brace as a single one."""
    offset = 0
    for number, line in enumerate(text.split("\n")):
        indent = -1
        for match in (_TOKEN if "{" in line or "}" in line else _LINE).finditer(line):
            first = indent < 0
            if first:
                indent = len(line[: match.start()].expandtabs())
            yield _Token(match[0], offset + match.start(), offset + match.end(), number, indent, first)
        offset += len(line) + 1


def _missing(text: str) -> Iterator[BraceFault]:
    open_: list[_Open] = []
    end = 0
    for token in _tokens(text):
        if token.text == "{":
            open_.append(_Open(token.start, token.line, token.indent))
        elif token.text == "}":
            while token.first and len(open_) > 1 and token.indent < open_[-1].indent:
                yield BraceFault(True, end, open_.pop().offset)
            if open_:
                open_.pop()
        elif token.first:
            while open_ and token.indent <= open_[-1].indent:
                yield BraceFault(True, end, open_.pop().offset)
        end = token.end
    for block in reversed(open_):
        yield BraceFault(True, end, block.offset)


def _too_many(text: str) -> Iterator[BraceFault]:
    open_: list[_Open] = []
    for token in _tokens(text):
        if token.text == "{":
            open_.append(_Open(token.start, token.line, token.indent))
        elif token.text == "}":
            own_line = open_ and open_[-1].line == token.line
            if not open_ or (not own_line and token.indent > open_[-1].indent):
                yield BraceFault(False, token.start, token.start)
            else:
                open_.pop()
