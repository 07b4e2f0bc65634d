"""Where the package's data files are."""

from __future__ import annotations

from pathlib import Path


def data_file(name: str) -> Path:
    """A generated file such as `m3d.lark`: in the package once it is installed, beside it in the source tree."""
    package = Path(__file__).parent
    installed = package / name
    return installed if installed.exists() else package.parent / name
