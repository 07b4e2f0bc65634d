"""An open document: its text as the client has it, analysed again and again in a thread beside the message loop."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from concurrent.futures import Executor

from lsprotocol import types

from m3dc.analysis import Analyser, Analysis

from .client import Client
from .settings import Settings
from .snapshot import Snapshot
from .text import Text

# After an analysis that took long, the next one waits as long as it took, within these bounds, so that at most half of
# the time goes into it while someone types. One that was done in a blink does not make the next wait.
BLINK_S = 0.03
LONGEST_PAUSE_S = 0.4


class Document:
    """One open document. All methods are called from the message loop.

    `looked_at` is called with each new snapshot of the text as it stands; `good` is the last one without an error.
    """

    def __init__(
        self, uri: str, text: Text, version: int, settings: Settings, client: Client, executor: Executor,
        looked_at: Callable[[Document, Snapshot], None],
    ) -> None:  # fmt: skip
        self.uri = uri
        self.text = text
        self.version = version
        self.settings = settings
        self.client = client
        self.good: Snapshot | None = None
        self._snapshot: Snapshot | None = None
        self._executor = executor
        self._looked_at = looked_at
        self._analyser = Analyser()
        self._rested = 0.0  # time.monotonic() from when on an analysis may start unasked
        self._running = False
        self._timer: asyncio.TimerHandle | None = None
        self._waiting: list[asyncio.Future[Snapshot]] = []
        self._closed = False
        self._start()

    def change(self, changes: list[types.TextDocumentContentChangeEvent], version: int) -> None:
        """Take over an edit."""
        if not changes and version == self.version:
            return
        for change in changes:
            if isinstance(change, types.TextDocumentContentChangePartial):
                self.text = self.text.changed(change.range, change.text)
            else:
                self.text = Text.of(change.text, self.text.name, self.text.encoding)
        self.version = version
        self._snapshot = None
        self._start_when_due()

    def set(self, settings: Settings) -> None:
        """Take over changed settings; the document is looked at anew with them."""
        self.settings = settings
        self._snapshot = None
        self._start()

    async def snapshot(self) -> Snapshot:
        """The snapshot of the text as it stands once it is there. Raises asyncio.CancelledError if the document is
        closed, or is before that."""
        if self._snapshot is not None:
            return self._snapshot
        if self._closed:
            raise asyncio.CancelledError
        future = asyncio.get_running_loop().create_future()
        self._waiting.append(future)
        self._start()
        return await future

    @property
    def current(self) -> Snapshot | None:
        """The snapshot of the text as it stands, if it is there."""
        return self._snapshot

    def close(self) -> None:
        """Nobody waits for this document any more."""
        self._closed = True
        if self._timer is not None:
            self._timer.cancel()
        for future in self._waiting:
            future.cancel()
        self._waiting = []

    def _start_when_due(self) -> None:
        rest = self._rested - time.monotonic()
        if rest <= 0 or self._waiting:
            self._start()
        elif self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(rest, self._start)

    def _start(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if self._running or self._closed or self._snapshot is not None:
            return
        self._running = True
        text, version = self.text, self.version
        task = asyncio.get_running_loop().run_in_executor(self._executor, self._analyse, text)
        task.add_done_callback(lambda done: self._done(done, text, version))

    def _analyse(self, text: Text) -> tuple[Analysis, float]:
        started = time.perf_counter()
        analysis = self._analyser.analyse(text.source)
        return analysis, time.perf_counter() - started

    def _done(self, done: asyncio.Future[tuple[Analysis, float]], text: Text, version: int) -> None:
        self._running = False
        if self._closed or done.cancelled():
            return
        error = done.exception()
        if error is not None:
            self._analyser = Analyser()
            for future in self._waiting:
                if not future.done():
                    future.set_exception(error)
            self._waiting = []
            raise error
        analysis, seconds = done.result()
        if seconds >= BLINK_S:
            self._rested = time.monotonic() + min(seconds, LONGEST_PAUSE_S)
        snapshot = Snapshot(self.uri, version, text, analysis, self.settings, self.client)
        if analysis.ok:
            self.good = snapshot
        if text is not self.text:
            self._start_when_due()
            return
        self._snapshot = snapshot
        waiting, self._waiting = self._waiting, []
        for future in waiting:
            if not future.done():
                future.set_result(snapshot)
        self._looked_at(self, snapshot)
