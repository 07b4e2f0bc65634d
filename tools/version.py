"""Writes the version of the root pyproject.toml into every other file that has to state it, and into every distribution
the licence and its build backend: part of `make generate`."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from .generated import ROOT, write

DISTRIBUTIONS = {
    "m3d-language": "grammar",
    "m3dc": "compiler",
    "m3d-render": "renderer",
    "m3d-lsp": "lsp",
    "mirage3d": "suite",
}
"""The distributions, and the folder of each. Those of one release want each other's very version."""

TOML = re.compile(r'^version = "(.*)"$', re.MULTILINE)
BACKEND = "build_backend.py"
"""The build backend of the distributions that need another one."""

JSON = re.compile(r'^ *"version": "(.*)",?$', re.MULTILINE)
PIN = re.compile(rf'"(?:{"|".join(DISTRIBUTIONS)})(?:\[\w+\])?==([^"]*)"')

FILES = {
    **{f"{folder}/pyproject.toml": TOML for folder in DISTRIBUTIONS.values()},
    "grammar/package.json": JSON,
    "grammar/tree-sitter.json": JSON,
    "renderer/Cargo.toml": TOML,
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
    """Every file that follows from the version, licence and build backend, with the text that it should have."""
    licence = (ROOT / "LICENSE").read_text(encoding="utf-8")
    backend = (ROOT / "suite" / BACKEND).read_text(encoding="utf-8")
    return {
        **{ROOT / name: _with_version(ROOT / name, at) for name, at in FILES.items()},
        **{ROOT / folder / "LICENSE": licence for folder in DISTRIBUTIONS.values()},
        **{ROOT / folder / BACKEND: backend for folder in DISTRIBUTIONS.values() if folder != "grammar"},
    }


def _with_version(path: Path, at: re.Pattern[str]) -> str:
    text = path.read_text(encoding="utf-8")
    copies = 2 if "-lock" in path.name else 1
    places = [match.span(1) for match in at.finditer(text)][:copies]
    assert len(places) == copies
    if path.name == "pyproject.toml":
        places += [match.span(1) for match in PIN.finditer(text)]
    for start, end in sorted(places, reverse=True):
        text = text[:start] + version() + text[end:]
    return text


if __name__ == "__main__":
    write(texts())
