"""Files that docstrings, comments and pages name are there."""

from __future__ import annotations

import ast
import io
import re
import subprocess
import tokenize
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
FILES = [
    line
    for line in subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    if (ROOT / line).is_file()
]
KNOWN = {"/".join(parts[first:]) for parts in (file.split("/") for file in FILES) for first in range(len(parts))}
NAME = re.compile(r"(?<![\w./<*{}$-])(?:[a-z_0-9-]+/)*[a-z_0-9-]+\.(?:py|rs|ts|toml|lark|c|h|sh|mjs|scm)(?![\w/(])")
QUOTED = re.compile(rf"`({NAME.pattern})`")
OF_OTHERS = {"init.lua", "scene.py"}
"""What users have, not we."""


def python(text: str) -> Iterator[str]:
    """The docstrings and comments of a module."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            yield ast.get_docstring(node) or ""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            yield token.string


def named(file: str) -> Iterator[str]:
    text = (ROOT / file).read_text(encoding="utf-8", errors="replace")
    match Path(file).suffix:
        case ".py":
            for part in python(text):
                yield from NAME.findall(part)
        case ".rs" | ".ts":
            for line in re.findall(r"^\s*(?://|/?\*).*", text, re.MULTILINE):
                yield from NAME.findall(line)
        case ".md":
            yield from QUOTED.findall(text)
        case _:
            pass


def test_they_are_there() -> None:
    missing = [f"{file} names {name}" for file in FILES for name in named(file) if name not in KNOWN | OF_OTHERS]
    assert not missing, "\n".join(missing)
