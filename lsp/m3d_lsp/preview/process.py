"""The process that draws, as the server sees it."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import signal
import subprocess
import sys
from collections.abc import Callable
from io import BufferedIOBase
from queue import SimpleQueue
from threading import Thread
from typing import Any, BinaryIO, cast

from .channel import Channel
from .messages import FromWorker, ToWorker

log = logging.getLogger(__name__)

# `-P`: whatever lies in the folder that the editor was started in is not imported.
COMMAND = [sys.executable, "-P", "-m", "m3d_lsp.preview.worker"]

# More than the process takes to end by itself.
PATIENCE_S = 3.0


class Process:
    """One process, started at once. Nothing here waits for it: messages are sent and received in threads.

    `hears` is called with each message, and `died` once with what to tell people, both in the message loop.
    """

    def __init__(self, hears: Callable[[FromWorker], None], died: Callable[[str], None]) -> None:
        self._hears = hears
        self._died = died
        self._loop = asyncio.get_running_loop()
        self._outgoing: SimpleQueue[Callable[[], ToWorker | None] | None] = SimpleQueue()
        self._popen: subprocess.Popen[bytes] | None = None
        self._writer = Thread(target=self._run, name="preview", daemon=True)
        self._writer.start()

    def send(self, message: ToWorker) -> None:
        """Send a message, some time."""
        self._outgoing.put(lambda: message)

    def send_if(self, make: Callable[[], ToWorker | None]) -> None:
        """Send what `make` makes when its turn comes, in another thread, if it makes anything."""
        self._outgoing.put(make)

    def close(self) -> None:
        """End the process; does not return before it has."""
        self._outgoing.put(None)
        self._writer.join(PATIENCE_S)
        popen = self._popen
        if popen is None:
            return
        try:
            popen.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            popen.kill()
            popen.wait()

    def _run(self) -> None:
        """Start the process, and send it what there is to send."""
        try:
            popen = self._popen = subprocess.Popen(COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        except OSError as error:
            self._in_loop(self._died, f"the process that draws previews can not be started: {error.strerror or error}")
            return
        reader, writer = cast("BufferedIOBase", popen.stdout), cast("BinaryIO", popen.stdin)
        channel = Channel(reader, writer)
        Thread(target=self._listen, args=(popen, channel), name="preview answers", daemon=True).start()
        # A broken pipe is noticed where answers are read.
        with contextlib.suppress(OSError):
            while (make := self._outgoing.get()) is not None:
                message = make()
                if message is not None:
                    channel.send(message)
        with contextlib.suppress(OSError):
            writer.close()

    def _listen(self, popen: subprocess.Popen[bytes], channel: Channel) -> None:
        try:
            while True:
                self._in_loop(self._hears, channel.receive())
        except (EOFError, OSError):
            status = popen.wait()
        except Exception:  # what it sent can not be understood: of no more use
            log.exception("the process that draws previews does not make sense")
            popen.kill()
            status = popen.wait()
        self._outgoing.put(None)
        self._in_loop(self._died, _why(status))

    def _in_loop(self, call: Callable[[Any], None], argument: object) -> None:
        # The loop may have ended before the process.
        with contextlib.suppress(RuntimeError):
            self._loop.call_soon_threadsafe(call, argument)


def _why(status: int) -> str:
    how = f"with status {status}"
    if status < 0:
        how = f"by {signal.Signals(-status).name}" if -status in list(signal.Signals) else f"by signal {-status}"
    return f"the process that draws previews was ended unexpectedly, {how}; the next preview starts another"
