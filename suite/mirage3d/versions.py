"""Which versions are installed: what a report of a fault should say."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

DISTRIBUTIONS = ("mirage3d", "m3d-language", "m3dc", "m3d-render", "m3d-lsp", "numpy")


def versions() -> dict[str, str]:
    """The version of each distribution of the project, of NumPy and of Python, and the platform, by name."""
    found = {name: _installed(name) for name in DISTRIBUTIONS}
    return {**found, "python": platform.python_version(), "platform": platform.platform()}


def _installed(distribution: str) -> str:
    try:
        return version(distribution)
    except PackageNotFoundError:
        return "(not installed)"
