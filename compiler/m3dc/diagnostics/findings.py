"""Diagnostics: what is wrong in a scene, where, what was expected, and how to mend it.

A stage adds what it finds in an item with places in that item (`ItemFindings`), and what it finds of a record, which
may stand anywhere, with the record's own place (`Findings.add_at`). Both are collected with places among all items
(`Placed`), and become diagnostics, with places in a file (`Absolute`), when all is found.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Generic, NamedTuple, TypeAlias, TypeVar

from ..text.places import Places
from ..text.span import WHOLE, Absolute, Base, Local, Placed, Span
from .catalogue import Entry, Severity

At = TypeVar("At")
"""What places count from: Span, Local, Placed or Absolute."""
To = TypeVar("To")


class Related(NamedTuple, Generic[At]):
    """Another place that has to do with a diagnostic."""

    span: At
    message: str


class Fix(NamedTuple, Generic[At]):
    """An edit that mends it: `text` in place of `span`.

    A `certain` one gives what the author meant, for nothing else can have been meant, and loses nothing he wrote: only
    such fixes are marked as preferred in an editor, and applied by "fix all". Any other is offered, to be chosen. Where
    the text has no error, a certain fix leaves the scene as it is.
    """

    title: str
    span: At
    text: str
    certain: bool = False


class Finding(NamedTuple, Generic[At]):
    """Something to say of a scene; `code` is a key of the catalogue."""

    code: str
    severity: Severity
    headline: str
    span: At
    detail: str = ""
    related: tuple[Related[At], ...] = ()
    fix: Fix[At] | None = None

    @property
    def message(self) -> str:
        """Headline and detail in one line."""
        return f"{self.headline}: {self.detail}" if self.detail else self.headline


Diagnostic: TypeAlias = Finding[Absolute]
"""A finding at its place in a file."""


def finding(
    entry: Entry,
    span: At,
    detail: str = "",
    *,
    fill: str = "",
    related: tuple[Related[At], ...] = (),
    fix: Fix[At] | None = None,
) -> Finding[At]:
    """A finding of a kind of the catalogue's. `fill` goes into its headline, `detail` says what was found and
    expected."""
    headline = entry.headline.format(fill) if fill else entry.headline
    return Finding(entry.code, entry.severity, headline, span, detail, related, fix)


def all_certain(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The diagnostics whose fixes can be applied all at once, in the order of these: the fixes are certain, and of
    those that get in each other's way it is the first."""
    chosen: list[Diagnostic] = []
    done = (-1, -1)
    for diagnostic in sorted((d for d in diagnostics if d.fix and d.fix.certain), key=_fixed):
        fixed = _fixed(diagnostic)
        if (fixed.file, fixed.start) > done:
            chosen.append(diagnostic)
            done = (fixed.file, fixed.end)
    return chosen


def _fixed(diagnostic: Diagnostic) -> Absolute:
    """What the fix of a diagnostic takes the place of."""
    assert diagnostic.fix is not None
    return diagnostic.fix.span


def moved(found: Finding[At], to: Callable[[At], To]) -> Finding[To]:
    """The same with each of its places counted from somewhere else."""
    return Finding(
        found.code,
        found.severity,
        found.headline,
        to(found.span),
        found.detail,
        tuple(Related(to(other.span), other.message) for other in found.related),
        None if found.fix is None else moved_fix(found.fix, to),
    )


def moved_fix(fix: Fix[At], to: Callable[[At], To]) -> Fix[To]:
    """The same with its place counted from somewhere else."""
    return Fix(fix.title, to(fix.span), fix.text, fix.certain)


class TextFindings:
    """Collects what is wrong in the form of a whole text, as places of that text."""

    def __init__(self) -> None:
        self.found: list[Finding[Span]] = []

    def add(
        self,
        entry: Entry,
        span: Span,
        detail: str = "",
        *,
        fill: str = "",
        related: tuple[Related[Span], ...] = (),
        fix: Fix[Span] | None = None,
    ) -> None:
        """Report `entry` at `span` (see `finding`)."""
        self.found.append(finding(entry, span, detail, fill=fill, related=related, fix=fix))


class Findings:
    """Collects all that is found in a scene."""

    def __init__(self) -> None:
        self.found: list[Finding[Placed]] = []

    def add_at(
        self,
        entry: Entry,
        place: Placed,
        detail: str = "",
        *,
        fill: str = "",
        related: tuple[Related[Placed], ...] = (),
    ) -> None:
        """Report `entry` at a place of any item (see `finding`)."""
        self.found.append(finding(entry, place, detail, fill=fill, related=related))

    def add_text(self, findings: TextFindings, base: Base = WHOLE) -> None:
        """Take over what was found in the whole text of a file."""
        self.found += [moved(found, lambda span: Placed(span[0] + base, span[1] + base)) for found in findings.found]

    def diagnostics(self, places: Places) -> Iterator[Diagnostic]:
        """All findings, where they stand in their files."""
        return (moved(found, places.absolute) for found in self.found)


class ItemFindings:
    """Collects what is found in one item, given as places of the item."""

    def __init__(self, findings: Findings, base: Base) -> None:
        self._findings = findings
        self._base = base

    def add(
        self,
        entry: Entry,
        span: Local,
        detail: str = "",
        *,
        fill: str = "",
        related: tuple[Related[Placed], ...] = (),
        fix: Fix[Local] | None = None,
    ) -> None:
        """Report `entry` at `span` (see `finding`). What is `related` may stand in any item."""
        mended = None if fix is None else moved_fix(fix, self.place)
        self._findings.found.append(finding(entry, self.place(span), detail, fill=fill, related=related, fix=mended))

    def place(self, span: Local) -> Placed:
        """A place of the item as one among all items."""
        return span.at(self._base)
