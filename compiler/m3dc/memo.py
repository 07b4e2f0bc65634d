"""Doing again only what changed: what each stage made of each top-level item, and of what.

A stage walks the items of a scene in order and keeps what it knows in a `Ledger`. What it makes of an item follows from
the item and from the entries that it reads on the way; where all of these are as they were, the outcome is, too.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping
from typing import Any, Generic, NamedTuple, TypeVar

from .diagnostics import Diagnostic, Findings

T = TypeVar("T")
V = TypeVar("V")


class Ledger(Generic[V]):
    """A dictionary that notes what is read of it and what is written to it."""

    def __init__(self) -> None:
        self._entries: dict[str, V] = {}
        self.begin()

    def begin(self) -> None:
        """Note anew. `read` is what entries were found to be, `written` what they were made; `everything` is whether
        more was read than can be noted."""
        self.read: dict[str, V | None] = {}
        self.written: dict[str, V] = {}
        self.everything = False

    def get(self, name: str) -> V | None:
        """The entry, or None."""
        entry = self._entries.get(name)
        if name not in self.written:
            self.read[name] = entry
        return entry

    def __getitem__(self, name: str) -> V:
        entry = self.get(name)
        if entry is None:
            raise KeyError(name)
        return entry

    def __setitem__(self, name: str, entry: V) -> None:
        self.written[name] = self._entries[name] = entry

    def items(self) -> Iterator[tuple[str, V]]:
        """All entries, in the order they were made."""
        self.everything = True
        return iter(self._entries.items())

    def matches(self, read: Mapping[str, V | None]) -> bool:
        """Whether entries are what they were found to be."""
        entries = self._entries
        return all(entries.get(name) is entry or entries.get(name) == entry for name, entry in read.items())

    def update(self, written: Mapping[str, V]) -> None:
        self._entries.update(written)


class _Step(NamedTuple):
    """What a stage made `of` an item: the result, what it found wrong, and what it read and wrote on the way."""

    of: object
    read: Mapping[str, Any]
    written: Mapping[str, Any]
    result: Any
    found: tuple[Diagnostic, ...]


class Steps:
    """One stage's outcomes, by item: those of the run before, and of this one."""

    def __init__(self) -> None:
        self._before: dict[Hashable, _Step] = {}
        self._now: dict[Hashable, _Step] = {}

    def begin(self) -> None:
        """Start a run over all items. What the run before did not come to is forgotten."""
        self._before, self._now = self._now, {}

    def do(self, key: Hashable, of: object, work: Callable[[], T], findings: Findings, ledger: Ledger[Any]) -> T:
        """The outcome of `work`, done only if need be, for the item that `key` stands for; it is the same work as long
        as `of` is the same object."""
        step = self._before.get(key)
        if step is not None and step.of is of and ledger.matches(step.read):
            ledger.update(step.written)
            findings.found.extend(step.found)
            self._now[key] = step
            return step.result
        ledger.begin()
        before = len(findings.found)
        result = work()
        if not ledger.everything:
            self._now[key] = _Step(of, ledger.read, ledger.written, result, tuple(findings.found[before:]))
        return result
