"""Writing files that are made of something else, for `make generate`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).parent.parent


def write(texts: Mapping[Path, str]) -> None:
    """Writes each file that does not have its text, and says which."""
    for path, text in texts.items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            print(f"wrote {path.relative_to(ROOT)}")
