"""The parts of a picture on their way to the client: as coarse as they must be, and no faster than they are taken."""

from __future__ import annotations

from collections.abc import Callable
from threading import Condition

import numpy as np
from numpy.typing import NDArray

from m3d_render import Picture, Tile
from m3d_render.picture import to_bytes

# Bytes of the pixels of one message, about; and how many messages may be on their way.
MOST_BYTES = 100_000
MOST_AHEAD = 2


class Tiles:
    """The tiles of one picture. The kernel calls `add` and `cancelled`, from one thread; other threads `taken` and
    `cancel`.

    What is known better by the time it would be sent is sent only so: a client that takes its time gets fewer and finer
    tiles, and always the finest of all.
    """

    def __init__(self, send: Callable[[int, int, NDArray[np.uint8]], None]) -> None:
        """`send` is called with the first row, the step and the pixels of what is to be sent."""
        self._send = send
        self._waiting: dict[int, Tile] = {}  # the finest, by their first row
        self._ahead = 0
        self._cancelled = False
        self._changed = Condition()

    def add(self, tile: Tile) -> None:
        """Take a tile from the kernel."""
        self._waiting[tile.top] = tile

    def cancelled(self) -> bool:
        """Send on what may be sent without waiting; whether the picture is not wanted any more."""
        while self._waiting and self._ahead < MOST_AHEAD and not self._cancelled:
            self._send_some()
        return self._cancelled

    def finish(self) -> bool:
        """Send all that is left, as fast as it is taken; whether the picture is wanted still."""
        while self._waiting and not self._cancelled:
            with self._changed:
                self._changed.wait_for(lambda: self._ahead < MOST_AHEAD or self._cancelled)
            self.cancelled()
        return not self._cancelled

    def taken(self) -> None:
        """The client has got a tile."""
        with self._changed:
            self._ahead -= 1
            self._changed.notify_all()

    def cancel(self) -> None:
        """The picture is not wanted any more."""
        with self._changed:
            self._cancelled = True
            self._changed.notify_all()

    def _send_some(self) -> None:
        """Send a run of rows of the coarsest there is."""
        step = max(tile.step for tile in self._waiting.values())
        top = min(tile.top for tile in self._waiting.values() if tile.step == step)
        run: list[Picture] = []
        row = top
        size = 0
        while row in self._waiting and self._waiting[row].step == step and size < MOST_BYTES:
            pixels = self._waiting.pop(row).pixels
            run.append(pixels)
            row += step * len(pixels)
            size += pixels.size
        with self._changed:
            self._ahead += 1
        self._send(top, step, to_bytes(np.concatenate(run)))
