"""Which diagnostics a command shows, and how severely: hints are asked for, warnings denied or allowed, by code."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from .catalogue import CATALOGUE
from .findings import Diagnostic

ALL = "all"


class Levels(NamedTuple):
    """Codes, or `all`: to warn of (hints), to deny (they become errors), to allow (they are not shown)."""

    warn: frozenset[str] = frozenset()
    deny: frozenset[str] = frozenset()
    allow: frozenset[str] = frozenset()

    def unknown(self) -> list[str]:
        """Codes that are none."""
        return sorted((self.warn | self.deny | self.allow) - CATALOGUE.keys() - {ALL})

    def apply(self, diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
        """The diagnostics to show, with the severity they are shown with. Errors stay what they are."""
        shown: list[Diagnostic] = []
        for diagnostic in diagnostics:
            if diagnostic.severity == "error":
                shown.append(diagnostic)
            elif _names(self.allow, diagnostic):
                continue
            elif diagnostic.code in self.deny or (ALL in self.deny and diagnostic.severity == "warning"):
                shown.append(diagnostic._replace(severity="error"))
            elif diagnostic.severity == "warning" or _names(self.warn, diagnostic):
                shown.append(diagnostic._replace(severity="warning"))
        return shown


def _names(codes: frozenset[str], diagnostic: Diagnostic) -> bool:
    return diagnostic.code in codes or ALL in codes


def levels(warn: Sequence[str], deny: Sequence[str], allow: Sequence[str]) -> Levels:
    """From options such as `M3D0503,M3D0512`, each given any number of times."""
    return Levels(*(frozenset(",".join(options).split(",")) - {""} for options in (warn, deny, allow)))
