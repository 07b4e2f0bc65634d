"""What the example of a block in the language table shows: the values that its statements and tables have there."""

from __future__ import annotations

import re

from .table import Block, Statement

NUMBER = re.compile(r"[+-]?\.?[0-9][0-9.eE+-]*")


def values(block: Block, statement: Statement) -> str | None:
    """The arguments of a statement, as the example has them."""
    shape = r"<[^>]*>" if statement.arguments[0].shape == "vector" else rf"(?:{NUMBER.pattern}[, ]*)+"
    found = re.search(rf"\b{statement.keyword} ({shape})", block.example)
    return found[1].strip() if found else None


def table(block: Block, keyword: str) -> str | None:
    """A table with its braces, as the example has it."""
    found = re.search(rf"\b{keyword} (\{{[^}}]*\}})", block.example)
    return found[1] if found else None
