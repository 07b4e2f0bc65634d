"""Diagnostics: what is wrong in a scene, where, what was expected, and how to mend it."""

from collections.abc import Iterable
from typing import NamedTuple

from ..text.places import Places
from ..text.span import Span
from .catalogue import Entry, Severity


class Related(NamedTuple):
    """Another place that has to do with a diagnostic."""

    span: Span
    message: str


class Fix(NamedTuple):
    """An edit that mends it: `text` in place of `span`.

    A `certain` one gives what the author meant, for nothing else can have been meant, and loses nothing he wrote: only
    such fixes are marked as preferred in an editor, and applied by "fix all". Any other is offered, to be chosen. Where
    the text has no error, a certain fix leaves the scene as it is.
    """

    title: str
    span: Span
    text: str
    certain: bool = False


class Diagnostic(NamedTuple):
    """One finding. `span` is a half-open range of bytes of the source; `code` is a key of the catalogue."""

    code: str
    severity: Severity
    headline: str
    span: Span
    detail: str = ""
    related: tuple[Related, ...] = ()
    fix: Fix | None = None

    @property
    def message(self) -> str:
        """Headline and detail in one line."""
        return f"{self.headline}: {self.detail}" if self.detail else self.headline


def all_certain(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The diagnostics whose fixes can be applied all at once, in the order of these: the fixes are certain, and of
    those that get in each other's way it is the first."""
    chosen: list[Diagnostic] = []
    done = -1
    for diagnostic in sorted((d for d in diagnostics if d.fix and d.fix.certain), key=_fixed):
        start, end = _fixed(diagnostic)
        if start > done:
            chosen.append(diagnostic)
            done = end
    return chosen


def _fixed(diagnostic: Diagnostic) -> Span:
    """What the fix of a diagnostic takes the place of."""
    assert diagnostic.fix is not None
    return diagnostic.fix.span


def placed(diagnostic: Diagnostic, places: Places) -> Diagnostic:
    """A diagnostic whose places count from bases of their own, with places of the text."""
    fix = diagnostic.fix
    return diagnostic._replace(
        span=places.span(diagnostic.span),
        related=tuple(other._replace(span=places.span(other.span)) for other in diagnostic.related),
        fix=fix and fix._replace(span=places.span(fix.span)),
    )


class Findings:
    """Collects diagnostics whose places are given relative to `base`, the start of the item being looked at."""

    def __init__(self) -> None:
        self.found: list[Diagnostic] = []
        self.base = 0

    def add(
        self,
        entry: Entry,
        span: Span,
        detail: str = "",
        *,
        fill: str = "",
        related: tuple[Related, ...] = (),
        fix: Fix | None = None,
    ) -> None:
        """Report `entry` of the catalogue at `span`. `fill` goes into its headline, `detail` says what was found and
        expected."""
        headline = entry.headline.format(fill) if fill else entry.headline
        if fix is not None:
            fix = fix._replace(span=self.absolute(fix.span))
        self.found.append(Diagnostic(entry.code, entry.severity, headline, self.absolute(span), detail, related, fix))

    def add_at(
        self, entry: Entry, span: Span, detail: str = "", *, fill: str = "", related: tuple[Related, ...] = ()
    ) -> None:
        """As `add`, at a place of the whole text."""
        self.add(entry, (span[0] - self.base, span[1] - self.base), detail, fill=fill, related=related)

    def absolute(self, span: Span) -> Span:
        """A place of the current item as a place of the whole text."""
        return span[0] + self.base, span[1] + self.base
