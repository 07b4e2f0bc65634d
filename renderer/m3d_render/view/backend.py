"""pyvista, which draws: brought in only once it is needed, with a message where it, or what it needs, is missing."""

from __future__ import annotations

import ctypes
import os
import sys
from importlib.util import find_spec
from typing import Any

from m3d_render.command import USAGE_ERROR, CommandError, how_to_get

_CHOICE = "VTK_DEFAULT_OPENGL_WINDOW"
_WITHOUT_DISPLAY = (
    ("libEGL.so.1", "vtkEGLRenderWindow"),
    ("libOSMesa.so.8", "vtkOSOpenGLRenderWindow"),
    ("libOSMesa.so.6", "vtkOSOpenGLRenderWindow"),
)


def load_pyvista(*, window: bool) -> Any:
    """The module pyvista, to draw in a `window` or without one. Raises CommandError where that can not be."""
    # First of all, because what else is missing would then be needed for nothing.
    if find_spec("pyvista") is None:
        message = f"m3d-view draws with pyvista, which is not installed: {how_to_get('view')} (700 MB)"
        raise CommandError(USAGE_ERROR, message)
    if sys.platform.startswith("linux"):
        _check_display() if window else _choose_without_display()
    try:
        import pyvista  # pyright: ignore[reportMissingImports, reportMissingTypeStubs, reportUnusedImport]
    except ImportError as error:
        message = f"pyvista, which m3d-view draws with, can not be loaded: {error}"
        raise CommandError(USAGE_ERROR, message) from None
    return pyvista  # pyright: ignore[reportUnknownVariableType]


def check_window(plotter: Any) -> None:
    """Raises CommandError where no window was opened: VTK then draws into memory, and nobody could see or close it."""
    kind = type(plotter.render_window).__name__
    if sys.platform.startswith("linux") and not kind.startswith("vtkX"):
        display = os.environ.get("DISPLAY")
        raise CommandError(
            USAGE_ERROR, f"no window can be opened on the display {display}; --screenshot PICTURE needs none"
        )


def _check_display() -> None:
    if not os.environ.get("DISPLAY"):
        raise CommandError(
            USAGE_ERROR,
            "there is no display to open a window on (DISPLAY is not set); --screenshot PICTURE needs none",
        )


def _choose_without_display() -> None:
    """Tells VTK what to draw with where there is no display: it would try an X server first, and crash in the end."""
    if _CHOICE in os.environ:
        return
    for library, choice in _WITHOUT_DISPLAY:
        try:
            ctypes.CDLL(library)
        except OSError:
            continue
        os.environ[_CHOICE] = choice
        return
    raise CommandError(
        USAGE_ERROR,
        "pictures without a display are drawn by EGL, which is not installed; on Debian: apt install libegl1",
    )
