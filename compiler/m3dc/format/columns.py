"""The columns of lines that differ in their values alone: how wide each is, and the blanks that a value needs in it.

In a column of numbers the decimal points stand below one another; in any other the values begin in one place.
"""

from __future__ import annotations

from typing import NamedTuple


class Cell(NamedTuple):
    """A value: its place among the atoms, its width, and, of a number, the width of what stands before its point."""

    atom: int
    width: int
    before: int
    is_number: bool


class Column(NamedTuple):
    """The widest of its values; `before` and `after` are the widest parts about the decimal points."""

    widest: int
    before: int
    after: int
    is_number: bool

    @classmethod
    def of(cls, cell: Cell) -> Column:
        """The column of one value."""
        return cls(cell.width, cell.before, cell.width - cell.before, cell.is_number)

    @property
    def width(self) -> int:
        return self.before + self.after if self.is_number else self.widest

    def joined(self, cell: Cell) -> Column:
        """The column with one more value."""
        _, width, before, is_number = cell
        if width <= self.widest and before <= self.before and width - before <= self.after and is_number:
            return self
        return Column(
            max(self.widest, width),
            max(self.before, before),
            max(self.after, width - before),
            self.is_number and is_number,
        )

    def blanks(self, cell: Cell) -> tuple[int, int]:
        """How many blanks more than one a value needs before and behind it."""
        lead = self.before - cell.before if self.is_number else 0
        return lead, self.width - lead - cell.width
