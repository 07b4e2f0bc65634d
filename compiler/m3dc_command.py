"""Where the commands `m3dc` and `m3dfmt` start, before NumPy is loaded.

NumPy's linear algebra starts a thread for each processor as it is loaded, which is up to half of what compiling a small
scene costs; the commands have nothing for them to do. This is no part of the package, because whoever uses that in a
program of their own decides on their threads themselves.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def m3dc() -> int:
    """Run the compiler's command; returns its exit status."""
    from m3dc.cli import main

    return main()


def m3dfmt() -> int:
    """Run the formatter's command; returns its exit status."""
    from m3dc.format_cli import main

    return main()
