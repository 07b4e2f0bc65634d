"""The keyword sets that grammar.js imports."""

from __future__ import annotations

import json

from tree_sitter_m3d.table import Language

HEADER = "// Generated from language.toml by `make generate`.\n"


def sets(language: Language) -> dict[str, list[str]]:
    """The keywords by what may follow them. AMBIENT is both a block and a statement."""
    blocks = language.blocks.values()
    tables = {keyword for block in blocks for keyword in block.tables}
    statements = {keyword for block in blocks for keyword in block.statements}
    # What starts nothing, such as a reserved word or NUMBER, parses as a statement, and the check refuses it.
    others = language.keywords - set(language.blocks) - tables - {"VARIABLES"}
    return {
        "all": sorted(language.keywords),
        "blocks": sorted(block.keyword for block in blocks if not block.variable),
        "types": sorted(block.keyword for block in blocks if block.variable),
        "statements": sorted(statements | others),
        "tables": sorted(tables),
    }


def text(language: Language) -> str:
    """The text of keywords.js."""
    return f"{HEADER}export default {json.dumps(sets(language), indent=2)};\n"
