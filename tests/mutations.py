"""Scenes with a slip: one token of a text deleted, doubled or swapped with the next."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from typing import NamedTuple

from m3d_language.comments import blank_comments

TOKEN = re.compile(r"[+-]?\.?[0-9](?:[eE][+-]|[A-Za-z0-9_.])*|[A-Za-z]\w*|\S")


class Mutation(NamedTuple):
    """A changed text, what was done at which byte, and where the block of the changed statement now is."""

    text: str
    what: str
    at: int
    block: tuple[int, int]


def mutations(text: str, chance: random.Random, count: int) -> Iterator[Mutation]:
    """Changes of one token of a text that is all ASCII."""
    tokens = list(TOKEN.finditer(blank_comments(text)))
    blocks = list(_blocks(tokens, len(text)))
    for _ in range(count):
        i = chance.randrange(len(tokens))
        (start, end), at = tokens[i].span(), tokens[i].start()
        what = chance.choice(("delete", "double", "swap"))
        if what == "swap" and i + 1 < len(tokens):
            next_start, next_end = tokens[i + 1].span()
            new = text[next_start:next_end] + text[end:next_start] + text[start:end]
            end = next_end
        elif what == "double":
            new = text[start:end] + " " + text[start:end]
        else:
            what, new = "delete", ""
        growth = len(new) - (end - start)
        # A brace is part of the block it makes, which stands in another; anything else is part of a statement.
        edge = 1 if tokens[i][0] in "{}" else 0
        around = (b for b in blocks[1:] if b[0] <= start and end + edge <= b[1])
        low, high = min(around, key=lambda b: b[1] - b[0], default=blocks[0])
        yield Mutation(text[:start] + new + text[end:], f"{what} {tokens[i][0]!r}", at, (low, high + growth))


def _blocks(tokens: list[re.Match[str]], length: int) -> Iterator[tuple[int, int]]:
    """Ranges of all blocks, from keyword to closing brace; of vectors' and assignments' lines; and the whole text."""
    yield 0, length
    open_: list[int] = []
    for i, token in enumerate(tokens):
        if token[0] == "{":
            back = i - 1
            while back > 0 and not tokens[back][0].isupper():
                back -= 1
            # An assignment's block begins with its target.
            back = i - 2 if tokens[i - 1][0] == "=" else i - 3 if tokens[i - 2][0] == "=" else back
            open_.append(tokens[max(back, 0)].start())
        elif token[0] == "}":
            yield open_.pop(), token.end()
