"""Places in the text that stay true while the text changes around them.

While a scene is compiled again and again, the spans within a top-level item count from a base of the item's own, which
it keeps as long as it stays as it is. Only at the end are they made places of the text as it is.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .span import Span

# No text is as long. Base number n is n times this; below it, a place is one of the text itself.
REACH = 1 << 34


class Places:
    """Where the items with bases of their own begin."""

    def __init__(self) -> None:
        self._starts: dict[int, int] = {}

    def put(self, base: int, start: int) -> None:
        """The item whose places count from `base` begins at byte `start`."""
        self._starts[base // REACH] = start

    def real(self, place: int) -> int:
        """A place as a byte of the text."""
        return place if place < REACH else self._starts[place // REACH] + place % REACH

    def span(self, span: Span) -> Span:
        """A range of places as a range of bytes of the text."""
        start, end = span
        return span if end < REACH else (self.real(start), self.real(end))

    def array(self, places: NDArray[np.int64]) -> NDArray[np.int64]:
        """Many places as bytes of the text."""
        if not self._starts or not places.size:
            return places
        items, numbers = np.unique(places // REACH, return_inverse=True)
        starts = np.array([self._starts[item] if item else 0 for item in items.tolist()], np.int64)
        return starts[numbers.reshape(places.shape)] + places % REACH
