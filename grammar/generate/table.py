"""The table as JSON, which loads faster than TOML and travels in the wheel."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from m3d_language.table import Language


def text(source: Path) -> str:
    """The text of language.json."""
    table = tomllib.loads(source.read_text(encoding="utf-8"))
    return json.dumps(table, ensure_ascii=False, separators=(",", ":")) + "\n"


def load(source: Path) -> Language:
    """The language as language.toml describes it now."""
    from m3d_language.table import Language

    return Language(tomllib.loads(source.read_text(encoding="utf-8")))
