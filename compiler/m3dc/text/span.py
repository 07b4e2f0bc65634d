"""Stretches of text, each counted from somewhere else, and so each of a type of its own.

     a file of the scene     ... SOLID { SPHERE { RADIUS two } } ...
                             0   ^ item 7 begins at byte 96
     the token `two`                                     Local(24, 27)          bytes of item 7
     what a record or a finding keeps                    Placed(7·R+24, 7·R+27) item 7 by its number; R is REACH
     a row of the IR, a diagnostic, an editor's range    Absolute(file, 120, 123)

A `Local` is what the syntax tree holds: it stays true when the item is moved by an edit somewhere else, so that the
item need not be read again. Whoever keeps a place longer than the item (a record that is copied, a finding, what is
known of a variable) keeps it `Placed`: an item's number stays the item's own for as long as its text stays. Only at
the end of each run does `Places`, which knows where the items now begin, make of it an `Absolute`, a place in a file.

A `Span` is none of these. It counts in a text that is at hand as bytes: what a regular expression, tree-sitter and the
formatter know of a place. `Local.within` and `Absolute.bytes` lead there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NewType, TypeAlias

Span: TypeAlias = tuple[int, int]
"""A half-open range of bytes of the text at hand: the first, and the end. What text that is, its holder knows."""

FileId = NewType("FileId", int)
"""Which file of a scene: the one that is compiled is MAIN."""

MAIN = FileId(0)

Base = NewType("Base", int)
"""The number of an item, REACH times: what is added to a place in the item to make it a place among all items."""

REACH: Final = 1 << 34
"""More bytes than any file has."""

WHOLE = Base(0)
"""The main file as a whole: what is found in it outside of its items."""


# Not frozen: making one would take three times as long, and a scene has one for every node of its tree. To the type
# checker they are.
@dataclass(slots=True, unsafe_hash=True)
class Local:
    """A half-open range of bytes of a top-level item, counted from the first byte of the item."""

    start: Final[int]
    end: Final[int]

    def within(self, start: int) -> Span:
        """In the text of its file, in which the item begins at a byte."""
        return self.start + start, self.end + start

    def at(self, base: Base) -> Placed:
        """Among all items, as a place in the one with this base."""
        return Placed(self.start + base, self.end + base)


@dataclass(slots=True, unsafe_hash=True)
class Placed:
    """A half-open range of bytes of an item: both ends are the item's base and the bytes from where it begins."""

    start: Final[int]
    end: Final[int]


@dataclass(slots=True, frozen=True, order=True)
class Absolute:
    """A half-open range of bytes of a file."""

    file: FileId
    start: int
    end: int

    @property
    def bytes(self) -> Span:
        """The same in the text of its file."""
        return self.start, self.end
