"""A line on the terminal that shows how far a rendering is."""

from __future__ import annotations

import time
from typing import IO

WIDTH = 40
"""Characters of the bar."""


class ProgressLine:
    """Draws itself anew each time it is called with the rows done; `clear` takes it away."""

    def __init__(self, stream: IO[str]) -> None:
        self._stream = stream
        self._started = time.monotonic()
        self._shown = False

    def __call__(self, done: int, total: int) -> None:
        seconds = time.monotonic() - self._started
        if not self._shown and seconds < 0.5:
            return
        filled = WIDTH * done // total
        left = f", {_duration(seconds / done * (total - done))} left" if 0 < done < total else ""
        bar = "#" * filled + "." * (WIDTH - filled)
        self._stream.write(f"\r[{bar}] {done} of {total} rows{left}\x1b[K")
        self._stream.flush()
        self._shown = True

    def clear(self) -> None:
        """Takes the line off the terminal."""
        if self._shown:
            self._stream.write("\r\x1b[K")
            self._stream.flush()


def _duration(seconds: float) -> str:
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    return f"{whole // 60} min {whole % 60} s"
