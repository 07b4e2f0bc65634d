"""Doing again only what changed: what each stage made of each part of a scene, and of what.

A stage walks the items of a scene in order and keeps what it knows in a `Ledger`. What it makes of an item follows from
the item and from the entries that it reads on the way; where all of these are as they were, the outcome is, too. What
it makes of an item can be made of steps in turn: those of them that nothing changed for are not done again either.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping
from typing import Any, Generic, NamedTuple, TypeVar

from ..diagnostics import Finding, Findings
from ..text.span import Placed

T = TypeVar("T")
V = TypeVar("V")


class Notes(Generic[V]):
    """What was done with a ledger: `read` is what entries were found to be, `written` what they were made;
    `everything` is whether more was read than can be noted."""

    def __init__(self) -> None:
        self.read: dict[str, V | None] = {}
        self.written: dict[str, V] = {}
        self.everything = False

    def add(self, later: Notes[V]) -> None:
        """Take over what was done after this."""
        for name, entry in later.read.items():
            if name not in self.written:
                self.read[name] = entry
        self.written.update(later.written)
        self.everything |= later.everything


class Ledger(Generic[V]):
    """A dictionary that notes what is read of it and what is written to it."""

    def __init__(self) -> None:
        self._entries: dict[str, V] = {}
        self._notes: Notes[V] = Notes()

    def noted(self, work: Callable[[], T]) -> tuple[T, Notes[V]]:
        """The outcome of `work`, and what it did. That is part of what is noted about those who asked for it, too."""
        outer = self._notes
        inner = self._notes = Notes()
        result = work()
        self._notes = outer
        outer.add(inner)
        return result, inner

    def get(self, name: str) -> V | None:
        """The entry, or None."""
        entry = self._entries.get(name)
        if name not in self._notes.written:
            self._notes.read[name] = entry
        return entry

    def __getitem__(self, name: str) -> V:
        entry = self.get(name)
        if entry is None:
            raise KeyError(name)
        return entry

    def __setitem__(self, name: str, entry: V) -> None:
        self._notes.written[name] = self._entries[name] = entry

    def __len__(self) -> int:
        """How many entries there are: of no note, because what is read of them is."""
        return len(self._entries)

    def items(self) -> Iterator[tuple[str, V]]:
        """All entries, in the order they were made."""
        self._notes.everything = True
        return iter(self._entries.items())

    def matches(self, notes: Notes[V]) -> bool:
        """Whether entries are what they were then found to be."""
        for name, then in notes.read.items():
            now = self._entries.get(name)
            if now is not then and now != then:
                return False
        return True

    def repeat(self, notes: Notes[V]) -> None:
        """Do what was done then."""
        self._entries.update(notes.written)
        self._notes.add(notes)

    def update(self, written: Mapping[str, V]) -> None:
        """Make entries without a note."""
        self._entries.update(written)


class _Step(NamedTuple):
    """What a stage made `of` something: the result, what it found wrong, what it read and wrote on the way, and the
    steps that it took."""

    of: object
    notes: Notes[Any]
    within: dict[Hashable, _Step]
    result: Any
    found: tuple[Finding[Placed], ...]


class Steps:
    """One stage's outcomes: those of the run before, and of this one."""

    def __init__(self) -> None:
        self._before: dict[Hashable, _Step] = {}
        self._now: dict[Hashable, _Step] = {}

    def begin(self) -> None:
        """Start a run over all items. What the run before did not come to is forgotten."""
        self._before, self._now = self._now, {}

    def do(self, key: Hashable, of: object, work: Callable[[], T], findings: Findings, ledger: Ledger[Any]) -> T:
        """The outcome of `work`, done only if need be, for the thing that `key` stands for; it is the same work as long
        as `of` is the same object. What `work` does by this method is a step within this one, with keys of its own."""
        before, now = self._before, self._now
        step = before.get(key)
        if step is not None and step.of is not of:
            step = None
        if step is not None and ledger.matches(step.notes):
            ledger.repeat(step.notes)
            findings.found.extend(step.found)
            now[key] = step
            return step.result
        reported = len(findings.found)
        self._before, self._now = {} if step is None else step.within, {}
        result, notes = ledger.noted(work)
        if not notes.everything:
            now[key] = _Step(of, notes, self._now, result, tuple(findings.found[reported:]))
        self._before, self._now = before, now
        return result
