"""Where the pages are that explain diagnostics and statements."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from m3d_language.table import LANGUAGE

# Beside the sources, where the server runs from a checkout; an installed one has no pages.
DOCS = Path(__file__).parents[2] / "docs"


@cache
def page_of(code: str) -> str | None:
    """The address of the page that explains a diagnostic's code."""
    return _address(DOCS / "diagnostics.md", code.lower())


@cache
def page_of_block(keyword: str) -> str | None:
    """The address of the page that explains a block and its statements."""
    section = LANGUAGE.blocks[keyword].thesis
    page = next(page for page in LANGUAGE.pages if page.thesis == section)
    return _address(DOCS / "language" / f"{page.name}.md", keyword.lower())


@cache
def page_of_variables() -> str | None:
    """The address of the page that explains variables and their types."""
    return _address(DOCS / "language/variables.md", "types")


def _address(page: Path, anchor: str) -> str | None:
    return f"{page.as_uri()}#{anchor}" if page.exists() else None
