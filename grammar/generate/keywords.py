"""The keyword sets that grammar.js imports, and the roles by which editors colour keywords."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import NamedTuple

from m3d_language.table import Block, Language

HEADER = "// Generated from language.toml by `make generate`.\n"


def sets(language: Language) -> dict[str, list[str] | dict[str, list[str]]]:
    """The keywords by what may follow them, blocks of the top level apart. AMBIENT is both a block and a statement."""
    blocks = language.blocks.values()
    tables = {keyword for block in blocks for keyword in block.tables}
    statements = {keyword for block in blocks for keyword in block.statements}
    # What starts nothing, such as a reserved word or NUMBER, parses as a statement, and the check refuses it.
    others = language.keywords - set(language.blocks) - tables - {"VARIABLES"}
    return {
        "all": sorted(language.keywords),
        "top": _by_form(block for block in blocks if block.keyword in language.top),
        "inner": _by_form(block for block in blocks if block.keyword not in language.top),
        "statements": sorted(statements | others),
        "tables": sorted(tables),
    }


def _by_form(blocks: Iterable[Block]) -> dict[str, list[str]]:
    """Blocks that only have a body, and those that are types and can be copied from a variable."""
    by_form: dict[str, list[str]] = {"blocks": [], "types": []}
    for block in sorted(blocks, key=lambda block: block.keyword):
        by_form["types" if block.variable else "blocks"].append(block.keyword)
    return by_form


class Roles(NamedTuple):
    """Every keyword, by what it looks like in an editor. AMBIENT is in `both`: a block here, a property there."""

    types: frozenset[str]
    properties: frozenset[str]
    flags: frozenset[str]
    both: frozenset[str]
    others: frozenset[str]


def roles(language: Language) -> Roles:
    """Blocks and basic types; statements with arguments and tables; statements without; and what is none of these."""
    statements = {word: s for block in language.blocks.values() for word, s in block.statements.items()}
    tables = {word for block in language.blocks.values() for word in block.tables}
    both = frozenset(set(language.blocks) & set(statements))
    flags = frozenset(word for word, statement in statements.items() if statement.is_flag) - both
    properties = frozenset((set(statements) | tables) - flags - both)
    types = frozenset({*language.blocks, *language.basics}) - both
    return Roles(types, properties, flags, both, language.keywords - types - properties - flags - both)


def text(language: Language) -> str:
    """The text of keywords.js."""
    return f"{HEADER}export default {json.dumps(sets(language), indent=2)};\n"
