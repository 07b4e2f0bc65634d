"""The editor queries: which node is a keyword, a fold, a definition.

The keywords stand in them one by one, so that they are coloured in half-typed text too, where no statement is a node.
Captures have the names that tree-sitter's own tools and Neovim use. No two patterns match the same node: editors
differ in which one wins.
"""

from __future__ import annotations

from collections.abc import Iterable

from m3d_language.table import Language

from . import keywords

HEADER = "; Generated from language.toml by `make generate`.\n"

FIXED_HIGHLIGHTS = """
(comment) @comment

[(number) (numeric_table)] @number

(identifier) @variable

["{" "}" "<" ">"] @punctuation.bracket

["," ";"] @punctuation.delimiter

"=" @operator
"""

FOLDS = """
[(body) (variables) (table) (comment)] @fold
"""

INDENTS = """
[(body) (variables) (table)] @indent.begin

"}" @indent.branch @indent.end

(comment) @indent.ignore
"""

LOCALS = """
(source_file) @local.scope

(declaration name: (identifier) @local.definition)

(identifier) @local.reference
"""

TAGS = """
(declaration name: (identifier) @name) @definition.constant

(assignment target: (identifier) @name) @reference.assignment

(assignment source: (identifier) @name) @reference.constant

(assignment value: (identifier) @name) @reference.constant

(block name: (identifier) @name) @reference.constant

(statement argument: (identifier) @name) @reference.constant

(vector component: (identifier) @name) @reference.constant

(table entry: (identifier) @name) @reference.constant
"""


def _any_of(words: Iterable[str], capture: str) -> str:
    lines = "\n".join(f'  "{word}"' for word in sorted(words))
    return f"[\n{lines}\n] {capture}\n"


def _highlights(language: Language) -> str:
    roles = keywords.roles(language)
    parts = [
        "; Blocks and types, members, flags, and what is none of these.\n",
        _any_of(roles.types, "@type"),
        _any_of(roles.properties, "@property"),
        _any_of(roles.flags, "@attribute"),
        _any_of(roles.others, "@keyword"),
    ]
    for word in sorted(roles.both):
        parts.append(f'(block keyword: "{word}" @type)\n\n(statement keyword: "{word}" @property)\n')
    return "\n".join(parts) + FIXED_HIGHLIGHTS


def texts(language: Language) -> dict[str, str]:
    """The text of each query by the name of its file."""
    return {
        "highlights.scm": f"{HEADER}\n{_highlights(language)}",
        "folds.scm": HEADER + FOLDS,
        "indents.scm": HEADER + INDENTS,
        "locals.scm": HEADER + LOCALS,
        "tags.scm": HEADER + TAGS,
    }
