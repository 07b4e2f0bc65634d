"""Everyday mistakes of people who come from other languages: mistakes.txt has each with what is said of it.

A section is a name, a scene and, after `=>`, its diagnostics, one a line. One that has a fix has beside it, after `+`,
the stretch that the fix writes. The first section, `H`, is the head that `H` alone on a scene's first line stands for.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import pytest

import m3dc

FILE = Path(__file__).parent / "mistakes.txt"


class Mistake(NamedTuple):
    name: str
    text: str
    expected: list[str]

    def scene(self, head: str) -> str:
        return head + self.text.removeprefix("H\n") if self.text.startswith("H\n") else self.text


def sections() -> list[Mistake]:
    found: list[Mistake] = []
    for part in FILE.read_text(encoding="utf-8").split("\n--- ")[1:]:
        name, _, rest = part.partition("\n")
        text, _, expected = rest.partition("=>\n")
        found.append(Mistake(name, text, expected.splitlines()))
    return found


SECTIONS = sections()
HEAD = SECTIONS[0].text


def said(scene: str) -> list[str]:
    """The errors and warnings of a scene, a line each; that a variable of the head is not used is none."""
    result = m3dc.compile(scene)
    lines: list[str] = []
    for found in result.diagnostics:
        if found.code == "M3D0503" or found.severity == "hint":
            continue
        line, column = result.source.position(found.span.start)
        fix = "" if found.fix is None else f" + {found.fix.text.strip() or found.fix.title}"
        place = f"{line}:{column} {result.source.text(*found.span.bytes).splitlines()[:1] or ['']}"
        lines.append(f"{place} {found.severity} {found.code} {found.message}{' '.join(fix.split(chr(10)))}")
    return lines


def test_what_is_said(rewrite: bool) -> None:
    if rewrite:
        comment = FILE.read_text(encoding="utf-8").split("\n--- ", 1)[0]
        parts = ["\n".join([f"\n--- {m.name}", f"{m.text}=>", *said(m.scene(HEAD))]) for m in SECTIONS]
        FILE.write_text(comment + "\n".join(parts) + "\n", encoding="utf-8")
        return
    wrong = [m.name for m in SECTIONS if [line for line in m.expected if line] != said(m.scene(HEAD))]
    assert wrong == []


@pytest.mark.parametrize("mistake", SECTIONS[1:], ids=lambda mistake: mistake.name)
def test_each_mistake_has_at_most_one_error(mistake: Mistake) -> None:
    result = m3dc.compile(mistake.scene(HEAD))
    errors = [d for d in result.diagnostics if d.severity == "error"]
    assert len(errors) <= 1, [d.message for d in errors]
    for error in errors:
        if error.fix is None:
            continue
        (start, end), data = error.fix.span.bytes, result.source.data
        mended = m3dc.compile(data[:start] + error.fix.text.encode() + data[end:])
        assert error._replace(fix=None) not in [d._replace(fix=None) for d in mended.diagnostics]
