"""Messages over standard input and output.

pygls reads in another thread, and wakes the message loop three times a message; where the loop can wait for the input
itself, a message comes in a third of the time.
"""

from __future__ import annotations

import asyncio
import logging
import os
import stat
import sys
from threading import Event

from pygls.io_ import StdoutWriter, run_async
from pygls.protocol import JsonRPCProtocol

log = logging.getLogger(__name__)


def can_wait() -> bool:
    """Whether the message loop can wait for standard input: not for a file, nor for the console of Windows; nor where
    output goes the same way (a terminal), since then it would not wait until it is taken."""
    if sys.platform == "win32":
        return False
    read, write = sys.stdin.fileno(), sys.stdout.fileno()
    mode = os.fstat(read).st_mode
    return (stat.S_ISFIFO(mode) or stat.S_ISSOCK(mode)) and not os.path.sameopenfile(read, write)


async def talk(protocol: JsonRPCProtocol, stop: Event) -> None:
    """Handle messages until the client leaves."""
    reader = asyncio.StreamReader()
    loop = asyncio.get_running_loop()
    transport, _ = await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), sys.stdin.buffer)
    protocol.set_writer(StdoutWriter(sys.stdout.buffer))
    try:
        await run_async(stop, reader, protocol, log)
    except asyncio.IncompleteReadError:
        log.warning("the client left in the middle of a message")
    finally:
        transport.close()
