"""The Mirage3D scene language: its table, its tree-sitter grammar and its formal grammar.

>>> import tree_sitter, m3d_language
>>> parser = tree_sitter.Parser(tree_sitter.Language(m3d_language.language()))

- `language()` is the tree-sitter language; `HIGHLIGHTS_QUERY`, `FOLDS_QUERY`, `INDENTS_QUERY`, `LOCALS_QUERY` and
  `TAGS_QUERY` are the texts of its queries.
- `read_table` reads the numbers of a big table; `only_numbers` says whether a stretch of text holds nothing else.
- `blank_comments` makes spaces of comments.
- `m3d_language.table.LANGUAGE` describes every block and statement.
- `m3d_language.formal` says where a text stops being a sentence of the language, and what could stand there.

Everything is loaded when it is first asked for, so that the table can be read without the compiled part.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._binding import language
    from .bulk import Stop, TableData, only_numbers, read_table
    from .comments import blank_comments

    FOLDS_QUERY: str
    HIGHLIGHTS_QUERY: str
    INDENTS_QUERY: str
    LOCALS_QUERY: str
    TAGS_QUERY: str

__all__ = [
    "FOLDS_QUERY",
    "HIGHLIGHTS_QUERY",
    "INDENTS_QUERY",
    "LOCALS_QUERY",
    "TAGS_QUERY",
    "Stop",
    "TableData",
    "blank_comments",
    "language",
    "only_numbers",
    "read_table",
]

_MODULES = {
    "Stop": "bulk",
    "TableData": "bulk",
    "blank_comments": "comments",
    "language": "_binding",
    "only_numbers": "bulk",
    "read_table": "bulk",
}


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        value = getattr(import_module(f".{_MODULES[name]}", __name__), name)
    elif name in __all__:
        from .files import data_file

        value = data_file(f"queries/{name.removesuffix('_QUERY').lower()}.scm").read_text(encoding="utf-8")
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
