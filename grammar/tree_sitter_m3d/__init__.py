"""The Mirage3D scene language: its table, its tree-sitter grammar and its formal grammar.

>>> import tree_sitter, tree_sitter_m3d
>>> parser = tree_sitter.Parser(tree_sitter.Language(tree_sitter_m3d.language()))

- `language()` is the tree-sitter language; `HIGHLIGHTS_QUERY`, `FOLDS_QUERY`, `INDENTS_QUERY`, `LOCALS_QUERY` and
  `TAGS_QUERY` are the texts of its queries.
- `read_table` reads the numbers of a big table.
- `tree_sitter_m3d.table.LANGUAGE` describes every block and statement.
- `tree_sitter_m3d.formal` says where a text stops being a sentence of the language, and what could stand there.
"""

from __future__ import annotations

from pathlib import Path

from ._binding import language
from .bulk import Stop, TableData, read_table

__all__ = [
    "FOLDS_QUERY",
    "HIGHLIGHTS_QUERY",
    "INDENTS_QUERY",
    "LOCALS_QUERY",
    "TAGS_QUERY",
    "Stop",
    "TableData",
    "language",
    "read_table",
]

FOLDS_QUERY: str
HIGHLIGHTS_QUERY: str
INDENTS_QUERY: str
LOCALS_QUERY: str
TAGS_QUERY: str


def __getattr__(name: str) -> str:
    """The text of a query, read when it is first asked for."""
    if name not in __all__ or not name.endswith("_QUERY"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    file = Path(__file__).with_name("queries") / f"{name.removesuffix('_QUERY').lower()}.scm"
    text = file.read_text(encoding="utf-8")
    globals()[name] = text
    return text


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
