"""Where the command `mirage3d` starts, before NumPy and the kernel are loaded: `m3dc_command` says how."""

from __future__ import annotations

import sys
from collections.abc import Callable

from m3dc_command import started


def run() -> int:
    """Run `mirage3d`; returns its exit status."""

    def load() -> Callable[[], int]:
        from mirage3d.cli import main

        return main

    return started("mirage3d", load)


if __name__ == "__main__":
    sys.exit(run())
