"""How diagnostics are shown to people and to programs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import IO

from .diagnostics import Diagnostic
from .source import Source

MOST_SHOWN = 100
WIDEST_LINE = 160


def print_human(diagnostics: Sequence[Diagnostic], source: Source, file: IO[str]) -> None:
    """Each diagnostic with its line and a caret under its place, and how many there were."""
    for diagnostic in diagnostics[:MOST_SHOWN]:
        line, column = source.position(diagnostic.span[0])
        kind = "error" if diagnostic.severity == "error" else "warning"
        print(f"{source.name}:{line}:{column}: {kind}[{diagnostic.code}]: {diagnostic.headline}", file=file)
        _print_excerpt(diagnostic, source, file)
        if diagnostic.detail:
            print(f"      = {diagnostic.detail}", file=file)
        for related in diagnostic.related:
            where = source.position(related.span[0])
            print(f"      = {related.message}: {source.name}:{where.line}:{where.column}", file=file)
        if diagnostic.fix is not None:
            print(f"      = help: {diagnostic.fix.title}", file=file)
    if len(diagnostics) > MOST_SHOWN:
        print(f"... and {len(diagnostics) - MOST_SHOWN} more", file=file)
    errors = sum(diagnostic.severity == "error" for diagnostic in diagnostics)
    warnings = len(diagnostics) - errors
    if diagnostics:
        counts = [f"{n} {word}{'s' * (n != 1)}" for n, word in ((errors, "error"), (warnings, "warning")) if n]
        print(f"{source.name}: {', '.join(counts)}", file=file)


def _print_excerpt(diagnostic: Diagnostic, source: Source, file: IO[str]) -> None:
    start, end = diagnostic.span
    line, column = source.position(start)
    text = source.line(line).replace("\t", " ")
    last_line, last_column = source.position(max(start, end))
    width = max((last_column if last_line == line else len(text) + 1) - column, 1)
    cut = max(0, column - WIDEST_LINE // 2)
    text, column, width = text[cut : cut + WIDEST_LINE], column - cut, min(width, WIDEST_LINE)
    print(f"{line:5} | {text}", file=file)
    print(f"      | {' ' * (column - 1)}{'^' * min(width, max(len(text) - column + 1, 1))}", file=file)


def print_json(diagnostics: Sequence[Diagnostic], source: Source, file: IO[str]) -> None:
    """One JSON object a line; lines and columns from 1, in characters."""
    for diagnostic in diagnostics:
        start, end = source.position(diagnostic.span[0]), source.position(diagnostic.span[1])
        record: dict[str, object] = {
            "file": source.name,
            "code": diagnostic.code,
            "severity": diagnostic.severity,
            "message": diagnostic.message,
            "line": start.line,
            "column": start.column,
            "end_line": end.line,
            "end_column": end.column,
            "start_byte": diagnostic.span[0],
            "end_byte": diagnostic.span[1],
        }
        print(json.dumps(record, ensure_ascii=False), file=file)
