"""Writing files so that nothing is lost: the new file takes the old one's place only once it is whole and on the disk.

Every command writes its files here.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import stat
from collections.abc import Generator
from pathlib import Path
from typing import BinaryIO, TextIO

_DESCRIPTOR = re.compile(r"/dev/fd/(\d+)|/proc/self/fd/(\d+)")
_NAMED = {"/dev/stdout": 1, "/dev/stderr": 2}


@contextlib.contextmanager
def replacing(*targets: Path) -> Generator[list[BinaryIO]]:
    """Files to write to, that become the targets on leaving the block, or vanish if the block fails.

    Until then they stand in the targets' folders under other names. What is no regular file (a pipe, /dev/stdout) is
    written to when the block is left. Raises OSError where a file can not be written.
    """
    files: list[BinaryIO] = []
    moves: list[tuple[Path, Path]] = []
    streams: list[tuple[BinaryIO, BinaryIO]] = []
    try:
        for target in targets:
            stream = _stream(target)
            if stream is not None:
                files.append(io.BytesIO())
                streams.append((files[-1], stream))
                continue
            final = Path(os.path.realpath(target))
            temporary = final.with_name(f".mirage3d-{os.urandom(8).hex()}.tmp")
            # Known before it is made: an interrupt may come at any moment.
            moves.append((temporary, final))
            files.append(_create(temporary, final))
        yield files
        for written, stream in streams:
            written.seek(0)
            stream.write(written.read())
            stream.close()
        for file in files:
            _finish(file)
        _move(moves)
    except BaseException:
        for file in [*files, *(stream for _, stream in streams)]:
            with contextlib.suppress(OSError):
                file.close()
        for temporary, _ in moves:
            temporary.unlink(missing_ok=True)
        raise


@contextlib.contextmanager
def text_of(file: BinaryIO) -> Generator[TextIO]:
    """A file of `replacing` to write text to, in UTF-8."""
    text = io.TextIOWrapper(file, encoding="utf-8", newline="\n")
    try:
        yield text
        text.flush()
    finally:
        with contextlib.suppress(ValueError, OSError):
            text.detach()


def write_file(target: Path, data: bytes) -> None:
    """Writes a whole file. Raises OSError."""
    with replacing(target) as (file,):
        file.write(data)


def names_stream(target: Path) -> bool:
    """Whether a path is one of the process's own open files, such as /dev/stdout."""
    return _descriptor(target) is not None


def _descriptor(target: Path) -> int | None:
    named = _DESCRIPTOR.fullmatch(str(target))
    return int(named[1] or named[2]) if named else _NAMED.get(str(target))


def _stream(target: Path) -> BinaryIO | None:
    """What to write to where the target is no regular file."""
    number = _descriptor(target)
    if number is not None:
        return open(os.dup(number), "wb")
    try:
        kind = target.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return None
    return None if stat.S_ISREG(kind) else target.open("wb")


def _create(temporary: Path, final: Path) -> BinaryIO:
    """A new empty file, with the permissions of the one whose place it takes, or the usual ones."""
    file = temporary.open("x+b")
    with contextlib.suppress(FileNotFoundError):
        os.chmod(temporary, stat.S_IMODE(final.stat().st_mode))
    return file


def _finish(file: BinaryIO) -> None:
    if not isinstance(file, io.BytesIO):
        file.flush()
        os.fsync(file.fileno())
    file.close()


def _move(moves: list[tuple[Path, Path]]) -> None:
    """All files take their places, or none as far as an interrupt is concerned: it waits."""
    if not moves:
        return
    # Here, because a dump to the screen should not wait for it.
    import signal

    from .interrupt import Interrupt

    with Interrupt() as interrupt:
        for temporary, final in moves:
            temporary.replace(final)
        for folder in {final.parent for _, final in moves}:
            # So that the names are on the disk, too, where the system can do that.
            with contextlib.suppress(OSError):
                descriptor = os.open(folder, os.O_RDONLY)
                try:
                    os.fsync(descriptor)
                finally:
                    os.close(descriptor)
    if interrupt.asked():
        signal.raise_signal(interrupt.number)
