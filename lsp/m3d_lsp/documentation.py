"""Where the pages are that explain diagnostics and statements."""

from __future__ import annotations

from functools import cache
from pathlib import Path

# Beside the sources, where the server runs from a checkout; an installed one has no pages.
DOCS = Path(__file__).parents[2] / "docs"


@cache
def page_of(code: str) -> str | None:
    """The address of the page that explains a diagnostic's code."""
    return _address(DOCS / "diagnostics.md", code.lower())


def _address(page: Path, anchor: str) -> str | None:
    return f"{page.as_uri()}#{anchor}" if page.exists() else None
