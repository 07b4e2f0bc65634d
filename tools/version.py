"""Writes the version of the root pyproject.toml into every other file that has to state it: part of `make generate`."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent

TOML = re.compile(r'^version = "(.*)"$', re.MULTILINE)
JSON = re.compile(r'^ *"version": "(.*)",?$', re.MULTILINE)

FILES = {
    "grammar/pyproject.toml": TOML,
    "grammar/package.json": JSON,
    "grammar/tree-sitter.json": JSON,
    "compiler/pyproject.toml": TOML,
    "renderer/pyproject.toml": TOML,
    "renderer/Cargo.toml": TOML,
    "lsp/pyproject.toml": TOML,
    "lsp/editors/zed/Cargo.toml": TOML,
    "lsp/editors/zed/extension.toml": TOML,
    "vscode-extension/package.json": JSON,
    "vscode-extension/package-lock.json": JSON,
}
"""The files, and where in each the version is: the first match, in a lock file of npm the first two."""


def version() -> str:
    """The project's version, as the root pyproject.toml has it."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]


def texts() -> dict[Path, str]:
    """Every file of FILES with the version it should have."""
    return {
        ROOT / name: _with_version((ROOT / name).read_text(encoding="utf-8"), at, 2 if "-lock" in name else 1)
        for name, at in FILES.items()
    }


def _with_version(text: str, at: re.Pattern[str], copies: int) -> str:
    places = [match.span(1) for match in at.finditer(text)][:copies]
    assert len(places) == copies
    for start, end in reversed(places):
        text = text[:start] + version() + text[end:]
    return text


def main() -> None:
    for path, text in texts().items():
        if path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            print(f"wrote {path.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
