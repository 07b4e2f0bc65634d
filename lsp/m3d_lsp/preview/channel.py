"""Messages between two processes: pickled, with their large arrays behind them, so that those are not copied."""

from __future__ import annotations

import pickle
import struct
from io import BufferedIOBase
from threading import Lock
from typing import Any, BinaryIO

# Bytes of the pickle, and how many arrays follow; then the bytes of each.
_HEADER = struct.Struct("<QQ")
_LENGTH = struct.Struct("<Q")


class Channel:
    """Two pipes. One thread may receive; any number may send. Both raise OSError when a pipe breaks."""

    def __init__(self, reader: BufferedIOBase, writer: BinaryIO) -> None:
        self._reader = reader
        self._writer = writer
        self._lock = Lock()

    def send(self, message: object) -> None:
        buffers: list[pickle.PickleBuffer] = []
        body = pickle.dumps(message, protocol=5, buffer_callback=buffers.append)
        views = [buffer.raw() for buffer in buffers]
        with self._lock:
            self._writer.write(_HEADER.pack(len(body), len(views)))
            for view in views:
                self._writer.write(_LENGTH.pack(view.nbytes))
            self._writer.write(body)
            for view in views:
                self._writer.write(view)
            self._writer.flush()

    def receive(self) -> Any:
        """The next message. Raises EOFError when the other side is gone."""
        length, count = _HEADER.unpack(self._read(_HEADER.size))
        lengths = [_LENGTH.unpack(self._read(_LENGTH.size))[0] for _ in range(count)]
        body = self._read(length)
        return pickle.loads(body, buffers=[self._read(length) for length in lengths])

    def _read(self, length: int) -> bytearray:
        data = bytearray(length)
        view, done = memoryview(data), 0
        while done < length:
            count = self._reader.readinto(view[done:])
            if not count:
                raise EOFError
            done += count
        return data
