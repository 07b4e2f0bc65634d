"""Where a place of one version of a text is in another."""

from __future__ import annotations

import os
from typing import NamedTuple

from .text import Span

# Compared at once while looking for the first difference of two texts.
STRIDE = 1 << 16


class Moved(NamedTuple):
    """The one stretch in which two versions differ: from `start` to `old_end` in one and `new_end` in the other."""

    start: int
    old_end: int
    new_end: int

    @classmethod
    def between(cls, old: bytes, new: bytes) -> Moved:
        if old is new:
            return cls(len(old), len(old), len(old))
        start = _common(old, new)
        rest = min(len(old), len(new)) - start
        end = _common(old[len(old) - rest :][::-1], new[len(new) - rest :][::-1])
        return cls(start, len(old) - end, len(new) - end)

    def forward(self, offset: int) -> int:
        """Where a byte of the old text is in the new one; one that is not there, where the difference begins."""
        if offset <= self.start:
            return offset
        return offset + self.new_end - self.old_end if offset >= self.old_end else self.start

    def back(self, offset: int) -> int:
        """Where a byte of the new text was in the old one."""
        return Moved(self.start, self.new_end, self.old_end).forward(offset)

    def span(self, span: Span) -> Span:
        """Where a range of the old text is in the new one: one that holds the difference grows or shrinks with it."""
        start, end = span
        inside = self.start < end < self.old_end
        return self.forward(start), self.new_end if inside else max(self.forward(start), self.forward(end))


def _common(one: bytes, other: bytes) -> int:
    """How many bytes two texts have in common at their beginning."""
    shorter = min(len(one), len(other))
    for start in range(0, shorter, STRIDE):
        a, b = one[start : start + STRIDE], other[start : start + STRIDE]
        if a != b:
            return start + len(os.path.commonprefix([a, b]))
    return shorter
