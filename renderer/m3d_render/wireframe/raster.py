"""A wireframe as pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from m3d_render.wireframe.drawing import Drawing, Strokes

Points = NDArray[np.float64]
Paper = Literal["black", "white"]

PAPERS: tuple[Paper, ...] = ("black", "white")

DARKEST = 0.35  # of 1: black things are drawn in grey, to be seen on black
LIGHTEST = 0.65  # and white ones in grey, to be seen on white
DASH = 3  # pixels of a dash, and of the gap after it
FAINT = 0.6  # of a dash's colour, the rest is the paper's

_GREY = np.full(3, 0.6)


def visible(color: Points, paper: Paper) -> Points:
    """A colour like this one that can be seen on the paper."""
    if paper == "white":
        mean = float(color.mean())
        return color * (LIGHTEST / mean) if mean > LIGHTEST else color
    brightest = float(color.max(initial=0.0))
    if brightest >= DARKEST:
        return color
    return color * (DARKEST / brightest) if brightest > 0 else _GREY


def raster(drawing: Drawing, paper: Paper = "black") -> NDArray[np.float32]:
    """Rows x columns x 3, 0..1: lines a pixel wide, nearer ones over farther ones, hidden ones dashed and fainter."""
    white = 0.0 if paper == "black" else 1.0
    picture = np.full((drawing.rows, drawing.columns, 3), white, np.float32)
    nearness = np.full((drawing.rows, drawing.columns), -np.inf)
    for thing in drawing.things:
        _draw_lines(picture, nearness, thing, visible(thing.color, paper), white)
    return picture


def _draw_lines(picture: NDArray[np.float32], drawn: Points, thing: Strokes, color: Points, paper: float) -> None:
    """The lines of a thing, where nothing nearer has been drawn."""
    a, b, dashed = thing.starts, thing.ends, thing.hidden
    rows, columns = drawn.shape
    # Less than a pixel apart: points a whole pixel apart would leave gaps where they lie between two.
    steps = np.floor(np.abs(b - a)[:, :2].max(axis=1, initial=0.0)).astype(np.int64) + 2
    line = np.repeat(np.arange(len(a)), steps)
    step = np.arange(len(line)) - np.repeat(np.cumsum(steps) - steps, steps)
    share = (step / np.maximum(steps[line] - 1, 1))[:, None]
    points = a[line] + share * (b[line] - a[line])
    x, y = np.rint(points[:, 0]).astype(np.int64), np.rint(points[:, 1]).astype(np.int64)
    # Dashes are counted over the picture, so that short pieces of a curve make some too.
    inked = ~dashed[line] | ((x + y) % (2 * DASH) < DASH)
    shown = inked & (x >= 0) & (x < columns) & (y >= 0) & (y < rows)
    x, y, near = x[shown], y[shown], points[shown, 2]
    nearer = near > drawn[y, x]
    x, y, near, line = x[nearer], y[nearer], near[nearer], line[shown][nearer]
    farthest_first = np.argsort(near, kind="stable")
    x, y, near, line = (values[farthest_first] for values in (x, y, near, line))
    drawn[y, x] = near
    picture[y, x] = np.where(dashed[line, None], FAINT * color + (1 - FAINT) * paper, color)
