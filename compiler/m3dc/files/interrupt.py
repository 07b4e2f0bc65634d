"""Signals that ask to end (Ctrl-C, SIGTERM) as a question that work asks, instead of an exception in its midst."""

from __future__ import annotations

import signal
from collections.abc import Callable
from types import FrameType
from typing import Any

_SIGNALS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))


class Interrupt:
    """Within its block such a signal does no more than to make `asked` true, where it would have raised an exception;
    a second one does what it does otherwise. `answer` is called at the first."""

    def __init__(self, answer: Callable[[], object] | None = None) -> None:
        self._answer = answer
        self.number = 0
        """The signal that came, or 0."""
        self._before: dict[int, Any] = {}

    def __enter__(self) -> Interrupt:
        for number in _SIGNALS:
            handler = signal.getsignal(number)
            if callable(handler):
                try:
                    signal.signal(number, self._hear)
                except ValueError:  # not in the main thread
                    return self
                self._before[number] = handler
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _hear(self, number: int, frame: FrameType | None) -> None:
        if self.number:
            self._before[number](number, frame)
        self.number = number
        if self._answer is not None:
            self._answer()

    def asked(self) -> bool:
        """Whether there was an interrupt."""
        return self.number != 0
