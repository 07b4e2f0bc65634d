"""The TextMate grammar, which colours a scene in VS Code before the language server has looked at it.

It tells the roles of words one by one, as the editor queries do. It knows no context but one: comments nest, so that a
comment holds comments. A keyword that is both a block and a property counts as a block where `{` or nothing follows on
its line.
"""

from __future__ import annotations

import json
from collections.abc import Iterable

from m3d_language.table import Language

from . import keywords

_BLOCK_FOLLOWS = r"(?=\s*(?:\{|/\*|$))"


def text(language: Language) -> str:
    """The text of m3d.tmLanguage.json."""
    roles = keywords.roles(language)
    grammar = {
        "information_for_contributors": ["Generated from grammar/language.toml by `make generate`."],
        "name": "Mirage3D",
        "scopeName": "source.m3d",
        "fileTypes": ["m3d"],
        "patterns": [{"include": f"#{name}"} for name in ("comment", "keyword", "number", "variable", "punctuation")],
        "repository": {
            "comment": {
                "name": "comment.block.m3d",
                "begin": r"/\*",
                "end": r"\*/",
                "beginCaptures": {"0": {"name": "punctuation.definition.comment.begin.m3d"}},
                "endCaptures": {"0": {"name": "punctuation.definition.comment.end.m3d"}},
                "patterns": [{"include": "#comment"}],
            },
            "keyword": {
                "patterns": [
                    _words(roles.both, "storage.type.block.m3d", _BLOCK_FOLLOWS),
                    _words(roles.types, "storage.type.block.m3d"),
                    _words(roles.properties | roles.both, "support.type.property-name.m3d"),
                    _words(roles.flags, "constant.language.flag.m3d"),
                    _words(roles.others, "keyword.other.m3d"),
                ]
            },
            # As in grammar.js, a malformed numeral is one token too.
            "number": {"name": "constant.numeric.m3d", "match": r"[+-]?\.?[0-9](?:[eE][+-]|[A-Za-z0-9_.])*"},
            "variable": {"name": "variable.other.m3d", "match": r"\b[A-Za-z][A-Za-z0-9_]*\b"},
            "punctuation": {
                "patterns": [
                    {"name": "punctuation.section.block.begin.m3d", "match": r"\{"},
                    {"name": "punctuation.section.block.end.m3d", "match": r"\}"},
                    {"name": "punctuation.definition.vector.begin.m3d", "match": "<"},
                    {"name": "punctuation.definition.vector.end.m3d", "match": ">"},
                    {"name": "punctuation.separator.comma.m3d", "match": ","},
                    {"name": "punctuation.terminator.statement.m3d", "match": ";"},
                    {"name": "keyword.operator.assignment.m3d", "match": "="},
                ]
            },
        },
    }
    return json.dumps(grammar, indent=2) + "\n"


def _words(words: Iterable[str], scope: str, followed_by: str = "") -> dict[str, str]:
    return {"name": scope, "match": rf"\b(?:{'|'.join(sorted(words))})\b{followed_by}"}
