"""A row of the table: what was measured, of us and of the reference, and whether the aim is met."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any, NamedTuple


class Aim(NamedTuple):
    """How ours, divided by the reference, should come out: at most the factor, or at least it."""

    factor: float
    least: bool = False

    def __str__(self) -> str:
        return f"{'≥' if self.least else '≤'} {self.factor:g}"

    def met(self, ratio: float) -> bool:
        """Whether a ratio reaches the aim."""
        return ratio >= self.factor if self.least else ratio <= self.factor


@dataclass(frozen=True, slots=True)
class Result:
    """One row. `theirs` is None where the reference is not installed, `missing` then says what would bring it."""

    name: str
    work: str
    reference: str
    unit: str
    ours: float
    theirs: float | None
    aim: Aim | None = None
    note: str = ""
    missing: str = "not installed"

    @property
    def ratio(self) -> float | None:
        """Ours divided by the reference."""
        return None if self.theirs is None else self.ours / self.theirs

    @property
    def verdict(self) -> str:
        """In a word: is the aim met?"""
        if self.aim is None or self.ratio is None:
            return "–"
        return "met" if self.aim.met(self.ratio) else "**not met**"


def alternate(repeats: int, *measures: Callable[[], Any]) -> list[list[Any]]:
    """Samples of several measures, taken in turn so that whatever else the machine does falls on all of them alike.

    Each is made once before, unseen, so that files and code are in memory.
    """
    for measure in measures:
        measure()
    samples: list[list[Any]] = [[] for _ in measures]
    for _ in range(repeats):
        for measure, taken in zip(measures, samples, strict=True):
            taken.append(measure())
    return samples


def middle(values: Iterable[float]) -> float:
    """The median."""
    return median(values)


def spread(values: Sequence[float]) -> str:
    """The least and the largest, to say how steady a figure is."""
    return f"{shown(min(values))}–{shown(max(values))}"


def shown(value: float) -> str:
    """Three significant digits, never an exponent."""
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value >= 0.001 else f"{value:.5f}"


MEGABYTE = 1e6

HEAD = ("row", "work", "reference", "theirs", "ours", "unit", "ours / theirs", "aim", "")


def table(results: Iterable[Result]) -> str:
    """The results as a Markdown table that also reads well as plain text."""
    rows = [HEAD] + [
        (
            result.name,
            result.work,
            result.reference,
            result.missing if result.theirs is None else shown(result.theirs),
            shown(result.ours),
            result.unit,
            "–" if result.ratio is None else shown(result.ratio),
            "–" if result.aim is None else str(result.aim),
            result.verdict,
        )
        for result in results
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEAD))]
    lines = ["| " + " | ".join(map(str.ljust, row, widths)) + " |" for row in rows]
    lines.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(lines)


def notes(results: Iterable[Result]) -> str:
    """What is to be known about single rows."""
    return "\n".join(f"- `{result.name}`: {result.note}" for result in results if result.note)
