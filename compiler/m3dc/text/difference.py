"""The one stretch in which a text differs from an older version of it, from the first byte to the last. `differences`
has all of them."""

from __future__ import annotations

from typing import NamedTuple

# Compared at once: pieces that stay in the processor's cache.
PIECE = 1 << 16


class Difference(NamedTuple):
    """From `start` to `old_end` in the older text, and to `new_end` in the newer one. All else is the same."""

    start: int
    old_end: int
    new_end: int

    @classmethod
    def between(cls, old: bytes, new: bytes) -> Difference:
        """What is the same at the beginning of both does not count again at their ends."""
        shorter = min(len(old), len(new))
        start = _alike(old, new, shorter)
        tail = _alike(old, new, shorter - start, mirrored=True)
        return cls(start, len(old) - tail, len(new) - tail)


def _alike(one: bytes, other: bytes, most: int, *, mirrored: bool = False) -> int:
    """How many of the first bytes of two texts are the same, or mirrored of the last; at most so many."""
    alike, size = 0, PIECE
    while size and alike < most:
        length = min(size, most - alike)
        ends = (len(one) - alike, len(other) - alike) if mirrored else (alike + length, alike + length)
        if one[ends[0] - length : ends[0]] == other[ends[1] - length : ends[1]]:
            alike += length
        else:
            size = min(size, length) // 2
    return alike
