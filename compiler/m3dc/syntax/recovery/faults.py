"""The faults of a broken text, each reported once: those of one kind in an item are one finding with one fix."""

from __future__ import annotations

import re
from typing import NamedTuple

from m3d_language.table import Block

from ...diagnostics import Fix, Related, TextFindings, catalogue
from ...diagnostics.catalogue import Entry
from ...diagnostics.words import statement_of
from ...text.span import Span
from .lexer import Token
from .limit import GivenUpError

_WORDISH = re.compile(rb"[A-Za-z0-9_.+-]")
_LONG_FIX = 10_000  # bytes: habits further apart are mended one by one


class _Habit(NamedTuple):
    """Faults of one kind in an item: the first is reported, with one fix for all."""

    place: int  # among the findings
    start: int  # of the first one
    title: str
    edits: dict[tuple[Span, str], None] | None  # None: there are none, or too many
    certain: bool


class Faults:
    """The faults of a text. Their places are bytes of the text."""

    def __init__(self, data: bytes, findings: TextFindings, most: int) -> None:
        self.findings = findings
        self.marks: dict[int, int] = {}  # by the starts of items, how much had been found
        self._habits: dict[str, _Habit] = {}
        self._data = data
        self._most = most

    def report_passed(self, kind: str, span: Span, text: str) -> None:
        """Report what is passed over like a blank."""
        if kind == "control":
            return
        if kind == "blank":
            says = f"found a {text}; an ordinary blank looks the same"
            self.add(catalogue.INVISIBLE_CHARACTER, span, says, edits=[(span, " ")],
                        title="Write a blank", kind="blank")  # fmt: skip
            return
        if kind == "conflict":
            says = f"{text[:7]} is a mark of two versions that could not be merged: keep one, and remove the marks"
            self.add(catalogue.INVALID_AT_TOP, span, says, kind="conflict")
            return
        mark = re.match(r"//+|#+!?|<!--|--|%+|;+", text)
        assert mark is not None
        inner = text[mark.end() :].removesuffix("-->").strip()
        edits = [(span, f"/* {inner} */")] if "*/" not in inner and "/*" not in inner else None
        self.add(catalogue.NOT_A_COMMENT, span, "a comment stands between /* and */", edits=edits,
                    title="Write /* */", kind="comment")  # fmt: skip

    def add(
        self,
        entry: Entry,
        span: Span,
        detail: str,
        *,
        fill: str = "",
        related: tuple[Related[Span], ...] = (),
        edits: list[tuple[Span, str]] | None = None,
        title: str = "",
        kind: str | None = None,
        sure: bool = True,
    ) -> None:
        """Report a fault, with the edits that mend it, for certain if that is `sure`; of a `kind` only the first of an
        item."""
        if kind is not None and kind in self._habits:
            habit = self._habits[kind]
            if habit.edits is not None and edits is not None and abs(span[0] - habit.start) <= _LONG_FIX:
                habit.edits.update(dict.fromkeys(edits))
            else:
                self._habits[kind] = habit._replace(edits=None)
            return
        if len(self.findings.found) >= self._most:
            raise GivenUpError(f"{self._most} syntax errors up to here")
        index = len(self.findings.found)
        self.findings.add(entry, span, detail, fill=fill, related=related)
        self._habits[kind or f"#{index}"] = _Habit(
            index, span[0], title, None if edits is None else dict.fromkeys(edits), sure
        )

    def forget_from(self, mark: int) -> None:
        """Drop what was reported since so much had been found."""
        del self.findings.found[mark:]
        self._habits = {kind: habit for kind, habit in self._habits.items() if habit.place < mark}

    def settle(self) -> None:
        """Give what was reported of the item its fixes."""
        for habit in self._habits.values():
            edits = [_apart(self._data, edit) for edit in sorted(habit.edits or ())]
            if not edits or habit.place >= len(self.findings.found):
                continue
            (start, _), (_, end) = edits[0][0], edits[-1][0]
            if end - start > _LONG_FIX:
                continue
            try:
                text = _edited(self._data, edits).decode("utf-8")
            except UnicodeDecodeError:
                continue
            title = habit.title if len(edits) == 1 else f"{habit.title} ({len(edits)} places)"
            diagnostic = self.findings.found[habit.place]
            self.findings.found[habit.place] = diagnostic._replace(fix=Fix(title, (start, end), text, habit.certain))
        self._habits = {}

    def superfluous(self, token: Token, says: str, *, sure: bool = True) -> None:
        """Report a token that is one too many."""
        self.add(catalogue.SUPERFLUOUS, token.span, says, fill=f"'{token.text}'", edits=[(token.span, "")],
                    title=f"Remove '{token.text}'", kind=token.text, sure=sure)  # fmt: skip

    def invalid(self, block: Block | None, span: Span, detail: str, *, edits: list[tuple[Span, str]] | None = None,
                 title: str = "", kind: str | None = None) -> None:  # fmt: skip
        """Report what cannot stand in a block, or at the top level."""
        entry = catalogue.INVALID_AT_TOP if block is None else catalogue.INVALID_IN_BLOCK
        fill = "" if block is None else statement_of(block.keyword)
        self.add(entry, span, detail, fill=fill, edits=edits, title=title, kind=kind)


def _apart(data: bytes, edit: tuple[Span, str]) -> tuple[Span, str]:
    """An edit with a blank where without it two words or numbers would become one, as in `RADIUS=2` without its `=`."""
    (start, end), new = edit
    left, right = data[start - 1 : start], data[end : end + 1]
    glued = new[-1].isalnum() and right.isalnum() if new else _WORDISH.match(left) and _WORDISH.match(right)
    return (edit[0], f"{new} ") if glued and end > start else edit


def _edited(data: bytes, edits: list[tuple[Span, str]]) -> bytes:
    """The text from the first edit to the last, with all of them made."""
    pieces: list[bytes] = []
    at = edits[0][0][0]
    for (start, end), new in edits:
        pieces += [data[at:start], new.encode()]
        at = end
    return b"".join(pieces)
