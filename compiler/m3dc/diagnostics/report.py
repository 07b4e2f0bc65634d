"""How diagnostics are shown: to people with the line and a caret under the place, to programs as JSON or SARIF."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator, Sequence
from typing import IO, Any

from ..text.files import Files
from ..text.source import Source
from ..text.span import MAIN, Absolute
from .catalogue import CATALOGUE
from .findings import Diagnostic, Related

MOST_SHOWN = 100
WIDEST_LINE = 160
_GUTTER = " " * 6

_COLORS = {"error": "31;1", "warning": "33;1", "hint": "36;1", "place": "1", "gutter": "34;1", "help": "36"}


class _Style:
    """Colours where the file is a terminal and nobody has asked for none (NO_COLOR)."""

    def __init__(self, file: IO[str]) -> None:
        self._on = file.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"

    def __call__(self, kind: str, text: str) -> str:
        return f"\x1b[{_COLORS[kind]}m{text}\x1b[0m" if self._on else text


def print_human(diagnostics: Sequence[Diagnostic], files: Files, file: IO[str], *, most: int = MOST_SHOWN) -> None:
    """Each diagnostic with its line and a caret under its place, at most so many, and a summary of all."""
    style = _Style(file)
    for diagnostic in diagnostics[:most]:
        _print_one(diagnostic, files, file, style)
    if len(diagnostics) > most:
        print(f"... and {len(diagnostics) - most} more (--max-errors shows more)", file=file)
    if diagnostics:
        print(f"{files.read(MAIN).name}: {summary(diagnostics)}", file=file)


def summary(diagnostics: Sequence[Diagnostic]) -> str:
    """Such as `2 errors, 1 warning`."""
    errors = sum(diagnostic.severity == "error" for diagnostic in diagnostics)
    counts = ((errors, "error"), (len(diagnostics) - errors, "warning"))
    return ", ".join(f"{n} {word}{'s' * (n != 1)}" for n, word in counts if n)


def _print_one(diagnostic: Diagnostic, files: Files, file: IO[str], style: _Style) -> None:
    source = files.read(diagnostic.span.file)
    line, column = source.position(diagnostic.span.start)
    place = style("place", f"{source.name}:{line}:{column}:")
    kind = style(diagnostic.severity, f"{diagnostic.severity}[{diagnostic.code}]")
    print(f"{place} {kind}: {style('place', diagnostic.headline)}", file=file)
    _print_excerpt(diagnostic, source, file, style)
    mark = style("gutter", "=")
    if diagnostic.detail:
        print(f"{_GUTTER}{mark} {diagnostic.detail}", file=file)
    for related in diagnostic.related:
        there = files.read(related.span.file)
        where = there.position(related.span.start)
        print(f"{_GUTTER}{mark} {related.message}: {there.name}:{where.line}:{where.column}", file=file)
    if diagnostic.fix is not None:
        print(f"{_GUTTER}{mark} {style('help', 'help:')} {diagnostic.fix.title}", file=file)


def _print_excerpt(diagnostic: Diagnostic, source: Source, file: IO[str], style: _Style) -> None:
    start, end = diagnostic.span.bytes
    line, column = source.position(start)
    text = source.line(line).replace("\t", " ")
    last_line, last_column = source.position(max(start, end))
    width = max((last_column if last_line == line else len(text) + 1) - column, 1)
    cut = max(0, column - WIDEST_LINE // 2)
    text, column = _printable(text[cut : cut + WIDEST_LINE]), column - cut
    bar = style("gutter", "|")
    carets = "^" * min(width, max(len(text) - column + 1, 1))
    print(f"{style('gutter', f'{line:5}')} {bar} {text}", file=file)
    print(f"{_GUTTER}{bar} {' ' * (column - 1)}{style(diagnostic.severity, carets)}", file=file)


def _printable(text: str) -> str:
    """The text with what a terminal would act on shown as a question mark."""
    return "".join(character if character.isprintable() else "\N{REPLACEMENT CHARACTER}" for character in text)


def print_echo(diagnostics: Sequence[Diagnostic], source: Source, file: IO[str]) -> None:
    """The whole source with line numbers, each diagnostic under its line (the 1993 program's -E)."""
    by_line: dict[int, list[Diagnostic]] = {}
    for diagnostic in diagnostics:
        by_line.setdefault(source.position(diagnostic.span.start).line, []).append(diagnostic)
    for number in range(1, source.line_count + 1):
        print(f"{number:5}   {source.line(number)}", file=file)
        for diagnostic in by_line.get(number, ()):
            column = source.position(diagnostic.span.start).column
            print(f"{' ' * (7 + column)}^ {diagnostic.severity}[{diagnostic.code}]: {diagnostic.message}", file=file)


def summary_of_scenes(found: Sequence[Sequence[Diagnostic]], unread: int = 0) -> str:
    """Such as `3 scenes: 1 with errors, 1 with warnings, 1 fine`; each of `found` is what was found in one scene."""
    severities = [{diagnostic.severity for diagnostic in diagnostics} for diagnostics in found]
    wrong = sum("error" in these for these in severities)
    warned = sum("error" not in these and bool(these) for these in severities)
    counts = (
        (wrong, "with errors"),
        (warned, "with warnings"),
        (len(found) - wrong - warned, "fine"),
        (unread, "not read"),
    )
    return f"{len(found) + unread} scenes: {', '.join(f'{n} {word}' for n, word in counts if n)}"


Found = Sequence[tuple[Sequence[Diagnostic], Files]]
"""What was found in each of several scenes."""


def json_lines(found: Found) -> str:
    """One JSON object a line; lines and columns from 1, in characters; `end` is just after the last character."""
    return "".join(line for diagnostics, files in found for line in _json_lines(diagnostics, files))


def _json_lines(diagnostics: Sequence[Diagnostic], files: Files) -> Iterator[str]:
    for diagnostic in diagnostics:
        record: dict[str, Any] = {
            "file": files.read(diagnostic.span.file).name,
            "code": diagnostic.code,
            "severity": diagnostic.severity,
            "message": diagnostic.message,
            **_place(diagnostic.span, files),
        }
        if diagnostic.related:
            record["related"] = [{"message": r.message, **_place(r.span, files)} for r in diagnostic.related]
        if diagnostic.fix is not None:
            fix = diagnostic.fix
            record["fix"] = {
                "title": fix.title,
                "text": fix.text,
                "certain": fix.certain,
                **_place(fix.span, files),
            }
        yield valid(json.dumps(record, ensure_ascii=False)) + "\n"


def valid(text: str) -> str:
    """The text with U+FFFD for what UTF-8 has no form for: the bytes of a file's name that are no UTF-8."""
    return re.sub("[\ud800-\udfff]", "\ufffd", text)


def _place(span: Absolute, files: Files) -> dict[str, int]:
    source = files.read(span.file)
    start, end = source.position(span.start), source.position(span.end)
    return {
        "line": start.line,
        "column": start.column,
        "end_line": end.line,
        "end_column": end.column,
        "start_byte": span.start,
        "end_byte": span.end,
    }


def sarif(found: Found) -> str:
    """One SARIF 2.1.0 log of all scenes, as code scanning services read it."""
    codes = sorted({diagnostic.code for diagnostics, _ in found for diagnostic in diagnostics})
    rules = [
        {"id": code, "fullDescription": {"text": CATALOGUE[code].says}, "help": {"text": CATALOGUE[code].says}}
        for code in codes
    ]
    log = {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [
            {
                "tool": {"driver": {"name": "m3dc", "rules": rules}},
                "columnKind": "unicodeCodePoints",
                "results": [
                    _sarif_result(diagnostic, files, codes)
                    for diagnostics, files in found
                    for diagnostic in diagnostics
                ],
            }
        ],
    }
    return valid(json.dumps(log, ensure_ascii=False, indent=2)) + "\n"


FOR_PROGRAMS: dict[str, Callable[[Found], str]] = {"json": json_lines, "sarif": sarif}
"""What is written for programs, by the name of its format."""


def _sarif_result(diagnostic: Diagnostic, files: Files, codes: list[str]) -> dict[str, Any]:
    return {
        "ruleId": diagnostic.code,
        "ruleIndex": codes.index(diagnostic.code),
        "level": diagnostic.severity,
        "message": {"text": diagnostic.message},
        "locations": [{"physicalLocation": _sarif_place(diagnostic.span, files)}],
        "relatedLocations": [_sarif_related(related, files) for related in diagnostic.related],
    }


def _sarif_related(related: Related[Absolute], files: Files) -> dict[str, Any]:
    return {"physicalLocation": _sarif_place(related.span, files), "message": {"text": related.message}}


def _sarif_place(span: Absolute, files: Files) -> dict[str, Any]:
    source = files.read(span.file)
    start, end = source.position(span.start), source.position(span.end)
    return {
        "artifactLocation": {"uri": uri_reference(source.name)},
        "region": {
            "startLine": start.line,
            "startColumn": start.column,
            "endLine": end.line,
            "endColumn": end.column,
            "byteOffset": span.start,
            "byteLength": span.end - span.start,
        },
    }


def uri_reference(name: str) -> str:
    """A file's name as a URI reference: relative to the working directory where the file is in it, as code scanning
    wants it, else absolute."""
    from pathlib import Path
    from urllib.parse import quote

    path = Path(name)
    if path.is_absolute():
        here = Path.cwd()
        if not path.is_relative_to(here):
            return path.as_uri()
        path = path.relative_to(here)
    return quote(os.fsencode(path.as_posix()))


def explain(code: str) -> str | None:
    """What a code means, with an example and its mending; None for a code there is not."""
    entry = CATALOGUE.get(code)
    if entry is None:
        return None
    headline = entry.headline.format("...") if "{}" in entry.headline else entry.headline
    example = f"For example:\n    {entry.wrong}\nMended:\n    {entry.right}"
    return f"{entry.severity}[{code}]: {headline}\n\n{entry.says}\n\n{example}\n"
