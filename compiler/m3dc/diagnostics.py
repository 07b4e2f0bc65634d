"""Diagnostics: what is wrong in a scene, where, what was expected, and how to mend it."""

from typing import NamedTuple

from .catalogue import CATALOGUE, Severity
from .ir import Span


class Related(NamedTuple):
    """Another place that has to do with a diagnostic."""

    span: Span
    message: str


class Fix(NamedTuple):
    """An edit that certainly mends it: `text` in place of `span`."""

    title: str
    span: Span
    text: str


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


class Findings:
    """Collects diagnostics whose places are given relative to `base`, the start of the item being looked at."""

    def __init__(self) -> None:
        self.found: list[Diagnostic] = []
        self.base = 0

    def add(
        self,
        code: str,
        span: Span,
        detail: str = "",
        *,
        fill: str = "",
        related: tuple[Related, ...] = (),
        fix: Fix | None = None,
    ) -> None:
        """Report `code` at `span`; `fill` goes into its headline, `detail` says what was found and expected."""
        entry = CATALOGUE[code]
        headline = entry.headline.format(fill) if fill else entry.headline
        if fix is not None:
            fix = fix._replace(span=self.absolute(fix.span))
        self.found.append(Diagnostic(code, entry.severity, headline, self.absolute(span), detail, related, fix))

    def add_at(
        self, code: str, span: Span, detail: str = "", *, fill: str = "", related: tuple[Related, ...] = ()
    ) -> None:
        """As `add`, at a place of the whole text."""
        self.add(code, (span[0] - self.base, span[1] - self.base), detail, fill=fill, related=related)

    def absolute(self, span: Span) -> Span:
        """A place of the current item as a place of the whole text."""
        return span[0] + self.base, span[1] + self.base
