"""Figures as files: what matplotlib is told, and the message where there is none.

A figure is the same, byte for byte, each time it is made: no date and no random names are in it.
"""

# matplotlib leaves some types of its own open.
# pyright: reportUnknownMemberType=false
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from m3d_render.command import USAGE_ERROR, CommandError, how_to_get, reason
from m3dc.files.artefact import replacing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SUFFIXES = (".svg", ".png", ".pdf")
DOTS_PER_INCH = 110

_STYLE: Any = {
    "font.size": 8,
    "axes.titlesize": 9,
    "legend.fontsize": 7,
    "hatch.linewidth": 0.5,
    "svg.hashsalt": "m3d-plot",
}
_UNDATED: dict[str, dict[str, Any]] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}


def check(output: Path) -> None:
    """Finds out before the work begins what would spoil its end. Raises CommandError."""
    if output.suffix.lower() not in SUFFIXES:
        raise CommandError(USAGE_ERROR, f"{output}: one of {', '.join(SUFFIXES)} must name the figure's format")
    try:
        import matplotlib.figure  # noqa: F401  # pyright: ignore[reportUnusedImport]
    except ImportError:
        raise CommandError(
            USAGE_ERROR,
            f"figures are drawn by matplotlib, which is not installed: {how_to_get('plot')}; "
            "--csv FILE without -o writes the data without it",
        ) from None


def save(output: Path, size: tuple[float, float], draw: Callable[[Figure], None]) -> None:
    """Draws a figure of a width and height in cm, and writes it in the format of the path's suffix."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    suffix = output.suffix.lower()
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(size[0] / 2.54, size[1] / 2.54), layout="constrained")
        draw(figure)
        try:
            with replacing(output) as (file,):
                if suffix == ".png":
                    _save_in_greys(figure, file)
                else:
                    figure.savefig(file, format=suffix[1:], metadata=_UNDATED[suffix])
        except BrokenPipeError:
            raise
        except OSError as error:
            raise CommandError(USAGE_ERROR, f"{output}: {reason(error)}") from None


def _save_in_greys(figure: Figure, file: BinaryIO) -> None:
    """A PNG of one channel: there is no colour in the figures, and so it takes a third of the room."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    figure.set_dpi(DOTS_PER_INCH)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())
    Image.fromarray(pixels[..., :3]).convert("L").save(
        file, format="PNG", optimize=True, dpi=(DOTS_PER_INCH, DOTS_PER_INCH)
    )
