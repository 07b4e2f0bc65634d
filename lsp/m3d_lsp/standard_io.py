"""Standard input and output as streams.

Where the message loop can wait for the input itself, it does; elsewhere a thread reads.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import stat
import sys
from threading import Thread

from .frames import PIECE


async def reader() -> asyncio.StreamReader:
    """Standard input. Reading it keeps nobody from leaving."""
    stream = asyncio.StreamReader()
    if _can_wait():
        loop = asyncio.get_running_loop()
        await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(stream), sys.stdin.buffer)
    else:
        Thread(target=_feed, args=(stream, asyncio.get_running_loop()), name="input", daemon=True).start()
    return stream


class Writer:
    """Standard output, as pygls writes to it."""

    def write(self, data: bytes) -> None:
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()

    def close(self) -> None:
        """It is closed with the process."""


def _can_wait() -> bool:
    """Whether the message loop can wait for standard input: not for a file, nor for the console of Windows; nor where
    output goes the same way (a terminal), since then it would not wait until it is taken."""
    if sys.platform == "win32":
        return False
    read, write = sys.stdin.fileno(), sys.stdout.fileno()
    mode = os.fstat(read).st_mode
    return (stat.S_ISFIFO(mode) or stat.S_ISSOCK(mode)) and not os.path.sameopenfile(read, write)


def _feed(stream: asyncio.StreamReader, loop: asyncio.AbstractEventLoop) -> None:
    # The descriptor itself: a thread that waits in a buffered file would keep the process from ending.
    descriptor = sys.stdin.fileno()
    with contextlib.suppress(RuntimeError, OSError):  # the loop has ended, or the input can not be read
        while data := os.read(descriptor, PIECE):
            loop.call_soon_threadsafe(stream.feed_data, data)
    with contextlib.suppress(RuntimeError):
        loop.call_soon_threadsafe(stream.feed_eof)
