"""Directives in comments: `/* m3d: allow CODE, CODE */` keeps warnings back.

Before the first item of a file it holds for the whole file; elsewhere for its own line and the next. Errors can not be
kept back.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from difflib import get_close_matches

from ..text.source import Source
from ..text.span import Absolute, Span
from . import catalogue
from .catalogue import CATALOGUE
from .findings import Diagnostic, Fix, finding

ALLOW = re.compile(rb"/\*\s*m3d:\s*allow\s+([A-Z0-9,\s]+?)\s*\*/")
_DIRECTIVE = re.compile(rb"/\*\s*m3d:\s*([A-Za-z]*)([^*]*)\*/")
_CODE = re.compile(r"(?:M3D?)?-?([0-9]{1,4})")
_WORD = re.compile(rb"[^\s,]+")
_COMMENT = re.compile(rb"\s*/\*(?:(?!/\*|\*/).)*\*/", re.DOTALL)


def without_allowed(diagnostics: list[Diagnostic], source: Source) -> Iterable[Diagnostic]:
    """The diagnostics but for those that the text allows."""
    if all(diagnostic.severity == "error" for diagnostic in diagnostics) or b"m3d:" not in source.data:
        return diagnostics
    top = heading_end(source.data)
    everywhere: set[str] = set()
    by_line: dict[int, set[str]] = {}
    for match in ALLOW.finditer(source.data):
        codes = set(match[1].decode().replace(",", " ").split())
        if match.end() <= top:
            everywhere |= codes
        else:
            line = source.position(match.end()).line
            for covered in (line, line + 1):
                by_line.setdefault(covered, set()).update(codes)

    def allowed(diagnostic: Diagnostic) -> bool:
        line = source.position(diagnostic.span.start).line
        return diagnostic.severity != "error" and diagnostic.code in everywhere | by_line.get(line, set())

    return (diagnostic for diagnostic in diagnostics if not allowed(diagnostic))


def wrong_directives(source: Source) -> Iterator[Diagnostic]:
    """What is wrong with the directives of a text: a word that is not `allow`, or no code of a warning or hint."""
    if b"m3d:" not in source.data:
        return
    for match in _DIRECTIVE.finditer(source.data):
        word = match[1].decode()
        if word != "allow":
            yield _wrong(source, match.span(1), f"{word!r} is no directive; allow is the only one", word, ["allow"])
            continue
        for code in _WORD.finditer(source.data, *match.span(2)):
            text = code[0].decode("utf-8", "replace")
            entry = CATALOGUE.get(text)
            if entry is None:
                kept = [code for code, entry in CATALOGUE.items() if entry.severity != "error"]
                yield _wrong(source, code.span(), f"{text} is no code of a diagnostic", text, kept)
            elif entry.severity == "error":
                yield _wrong(source, code.span(), f"{text} is an error, which can not be kept back", "", [])


def _meant(word: str, words: list[str]) -> str | None:
    """The word that was meant. A code is its number, however that is written: one next to it has nothing to do with
    it."""
    if words == ["allow"]:
        return next(iter(get_close_matches(word.lower(), words, 1, 0.8)), None)
    number = _CODE.fullmatch(word.upper())
    code = f"M3D{int(number[1]):04}" if number else ""
    return code if code in words else None


def _wrong(source: Source, span: Span, detail: str, word: str, words: list[str]) -> Diagnostic:
    place = Absolute(source.file, *span)
    meant = _meant(word, words)
    detail += f"; did you mean {meant}?" if meant else ""
    # A code in lower case or without its zeros is certain.
    sure = meant is not None and (meant != "allow" or word.lower() == meant)
    fix = Fix(f"Replace with {meant}", place, meant, certain=True) if meant is not None and sure else None
    return finding(catalogue.IDLE_DIRECTIVE, place, detail, fix=fix)


def heading_end(data: bytes) -> int:
    """Where the comments at the beginning of the file end."""
    end = 0
    while match := _COMMENT.match(data, end):
        end = match.end()
    return end
