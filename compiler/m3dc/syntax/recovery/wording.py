"""How what was found is shown in a message."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable

from .lexer import Token

LETTERS = "words are of the letters A to Z, digits and underscores"
TOP_LEVEL = "VARIABLES, SCENE, SOLID and LIGHT blocks, and assignments to variables"


def found(token: Token) -> str:
    """What was found: `found 'SPHERE'`."""
    return "found the end of the text" if token.kind == "end" else f"found {shown(token)}"


def shown(token: Token) -> str:
    """The text of a token in quotes, cut short where it is long."""
    return repr(token.text if len(token.text) <= 40 else f"{token.text[:37]}...")


def other_number(text: str) -> str | None:
    """What a digit or fraction is worth that is none of 0 to 9, as a numeral; None for any other text."""
    value = unicodedata.numeric(text, None) if len(text) == 1 else None
    return None if value is None else f"{value:.6g}"


def some(keywords: Iterable[str], most: int = 6) -> str:
    """Keywords, but not more of them than one reads."""
    words = list(dict.fromkeys(keywords))
    return ", ".join(words) if len(words) <= most else ", ".join([*words[: most - 1], ".."])
