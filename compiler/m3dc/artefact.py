"""Writing files so that nothing is lost: the new file takes the old one's place only once it is whole."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Generator
from pathlib import Path
from typing import IO


@contextlib.contextmanager
def write_file(path: Path) -> Generator[IO[bytes]]:
    """A binary file to write into, that becomes `path` on leaving the block, or vanishes if the block fails.

    Raises OSError where the folder can not be written to. Anything but a regular file (a pipe, /dev/stdout) is written
    to directly.
    """
    if path.exists() and not path.is_file():
        with path.open("wb") as file:
            yield file
        return
    target = path.resolve()
    descriptor, name = tempfile.mkstemp(prefix=f".{target.name[:100]}.", dir=target.parent)
    temporary = Path(name)
    try:
        with os.fdopen(descriptor, "wb") as file:
            yield file
        mask = os.umask(0)
        os.umask(mask)
        temporary.chmod(target.stat().st_mode if target.exists() else 0o666 & ~mask)
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
