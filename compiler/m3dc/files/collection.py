"""Python's cyclic garbage collection, switched off while much is made that is no garbage.

Python looks through all new objects every few hundred of them, for circles that nothing else refers to. There are none
in a scene, and its many small tuples would be looked through again and again: half of the time that compiling takes.
"""

from __future__ import annotations

import gc
from collections.abc import Generator
from contextlib import contextmanager


@contextmanager
def paused() -> Generator[None]:
    """No garbage is collected within, by any thread; afterwards it is as it was."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
