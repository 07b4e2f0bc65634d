"""A bare client of a language server: sends messages, and tells when the answer to each came."""

from __future__ import annotations

import json
import queue
import subprocess
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from .child import RunError, environment

PATIENCE_S = 60.0


class Arrived(NamedTuple):
    """A message, and when it was there (time.perf_counter)."""

    at: float
    message: dict[str, Any]


class Client:
    """One server in a process of its own. `with` starts and ends it."""

    def __init__(self, command: Sequence[str | Path], errors: Path) -> None:
        self._errors = errors.open("wb")
        self._process = subprocess.Popen(
            [str(word) for word in command],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            env=environment(),
        )
        self._arrived: queue.Queue[Arrived | None] = queue.Queue()
        self._count = 0
        threading.Thread(target=self._read, daemon=True).start()

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_error: object) -> None:
        self._process.kill()
        self._process.wait()
        self._errors.close()

    def _read(self) -> None:
        stream = self._process.stdout
        assert stream is not None
        length = 0
        while line := stream.readline():
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
            elif not line.strip():
                self._arrived.put(Arrived(time.perf_counter(), json.loads(stream.read(length))))
        self._arrived.put(None)

    def notify(self, method: str, params: Any) -> None:
        """Send a notification."""
        self._send({"method": method, "params": params})

    def request(self, method: str, params: Any) -> Any:
        """Send a request; what the server answered."""
        return self.timed(method, params)[0]

    def timed(self, method: str, params: Any) -> tuple[Any, float]:
        """The answer to a request, and how many seconds it took."""
        self._count += 1
        number = self._count
        started = time.perf_counter()
        self._send({"id": number, "method": method, "params": params})
        arrived = self.wait(lambda message: message.get("id") == number and "method" not in message)
        if "error" in arrived.message:
            raise RunError(f"{method}: {arrived.message['error']}")
        return arrived.message.get("result"), arrived.at - started

    def wait(self, wanted: Callable[[dict[str, Any]], bool]) -> Arrived:
        """The next message that is wanted. What the server asks for meanwhile is answered with nothing."""
        while True:
            try:
                arrived = self._arrived.get(timeout=PATIENCE_S)
            except queue.Empty:
                raise RunError(f"the server did not answer in {PATIENCE_S:.0f} s") from None
            if arrived is None:
                raise RunError("the server ended")
            message = arrived.message
            if wanted(message):
                return arrived
            if "method" in message and "id" in message:
                self._send({"id": message["id"], "result": None})

    def _send(self, message: dict[str, Any]) -> None:
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        stream = self._process.stdin
        assert stream is not None
        stream.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        stream.flush()
