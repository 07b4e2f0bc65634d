"""Where the items of a text begin: what makes a place within an item (`Placed`) one of a file (`Absolute`)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .span import MAIN, REACH, WHOLE, Absolute, Base, FileId, Placed


class Places:
    """Where each item of one version of a scene begins, by its base.

    An item keeps its base from one version to the next (`put`) for as long as its text stays the same; one that is new
    gets a base that no item had before (`new`), in any version.
    """

    def __init__(self, before: Places | None = None) -> None:
        self._count = 0 if before is None else before._count
        self._begins: dict[int, tuple[FileId, int]] = {WHOLE: (MAIN, 0)}

    def new(self, file: FileId, start: int) -> Base:
        """A base for an item that begins at byte `start` of a file."""
        self._count += 1
        base = Base(self._count * REACH)
        self.put(base, file, start)
        return base

    def put(self, base: Base, file: FileId, start: int) -> None:
        """The item with this base begins at byte `start` of a file."""
        self._begins[base // REACH] = file, start

    def absolute(self, placed: Placed) -> Absolute:
        """Where something stands now."""
        file, start = self._byte(placed.start)
        return Absolute(file, start, self._byte(placed.end)[1])

    def _byte(self, place: int) -> tuple[FileId, int]:
        file, begin = self._begins[place // REACH]
        return file, begin + place % REACH

    def bytes(self, places: NDArray[np.int64]) -> NDArray[np.int64]:
        """Many ends of what is `Placed`, as bytes of the one file that there is."""
        if not places.size:
            return places
        items, numbers = np.unique(places // REACH, return_inverse=True)
        begins = np.array([self._begins[item][1] for item in items.tolist()], np.int64)
        return begins[numbers.reshape(places.shape)] + places % REACH
