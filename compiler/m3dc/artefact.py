"""Writing files so that nothing is lost: the new file takes the old one's place only once it is whole."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Generator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


@contextlib.contextmanager
def replacing(*targets: Path) -> Generator[list[Path]]:
    """Paths to write to, that become the targets on leaving the block, or vanish if the block fails.

    They stand in the targets' folders and have their suffixes. What is there and is no regular file (a pipe,
    /dev/stdout) is written to directly. Raises OSError where a folder can not be written to.
    """
    finals = [target.resolve() for target in targets]
    temporaries: list[Path] = []
    try:
        for final in finals:
            temporaries.append(final if final.exists() and not final.is_file() else _beside(final))
        yield temporaries
        for temporary, final in zip(temporaries, finals, strict=True):
            if temporary != final:
                temporary.replace(final)
    except BaseException:
        for temporary, final in zip(temporaries, finals, strict=False):
            if temporary != final:
                temporary.unlink(missing_ok=True)
        raise


def _beside(target: Path) -> Path:
    """A new empty file in the target's folder, with the target's suffix, and its or the usual permissions."""
    # Here, because a dump to the screen should not wait for them.
    import tempfile
    from pathlib import Path

    descriptor, name = tempfile.mkstemp(prefix=f".{target.stem[:100]}-", suffix=target.suffix, dir=target.parent)
    os.close(descriptor)
    mask = os.umask(0)
    os.umask(mask)
    temporary = Path(name)
    temporary.chmod(target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~mask)
    return temporary
