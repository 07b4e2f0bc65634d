"""Tells when the client's process has gone: then nobody is left to end the server."""

from __future__ import annotations

import asyncio
import logging
import os
import sys
from collections.abc import Callable
from threading import Thread

log = logging.getLogger(__name__)

# How often it is looked, where the system can not be waited for.
PAUSE_S = 10.0


def when_gone(process: int, call: Callable[[], None]) -> None:
    """Call `call`, in the running loop, once a process has gone. One that is not there from the start was never seen
    from here (the client may be in a container, or on another machine), and is not waited for."""
    loop = asyncio.get_running_loop()
    if sys.platform == "win32":
        _wait_for_handle(process, lambda: loop.call_soon_threadsafe(call))
    elif not _is_there(process):
        log.warning("the client's process %s is not to be seen from here", process)
    elif hasattr(os, "pidfd_open"):
        _wait_for_descriptor(loop, process, call)
    else:
        _look_now_and_then(loop, process, call)


def _wait_for_descriptor(loop: asyncio.AbstractEventLoop, process: int, call: Callable[[], None]) -> None:
    try:
        descriptor = os.pidfd_open(process)
    except OSError:  # an older system
        _look_now_and_then(loop, process, call)
        return

    def gone() -> None:
        loop.remove_reader(descriptor)
        os.close(descriptor)
        call()

    loop.add_reader(descriptor, gone)


def _look_now_and_then(loop: asyncio.AbstractEventLoop, process: int, call: Callable[[], None]) -> None:
    if _is_there(process):
        loop.call_later(PAUSE_S, _look_now_and_then, loop, process, call)
    else:
        call()


def _is_there(process: int) -> bool:
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


def _wait_for_handle(process: int, call: Callable[[], object]) -> None:
    if sys.platform != "win32":
        return
    import _winapi

    synchronize = 0x00100000
    try:
        handle = _winapi.OpenProcess(synchronize, False, process)
    except (OSError, OverflowError):
        log.warning("the client's process %s is not to be seen from here", process)
        return

    def wait() -> None:
        _winapi.WaitForSingleObject(handle, _winapi.INFINITE)
        call()

    Thread(target=wait, name="client", daemon=True).start()
