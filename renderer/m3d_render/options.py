"""What may be asked of a picture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, TypedDict

import numpy as np
from numpy.typing import NDArray

Picture: TypeAlias = NDArray[np.float32]

LARGEST_SIDE = 65_535
"""Pixels a picture may have in a row, or in a column."""

MOST_SAMPLES = 65_536
"""Eye rays a pixel may have."""


@dataclass(frozen=True, slots=True)
class Region:
    """A part of a picture: its outermost rows and columns, counted from 0 at the top left."""

    top: int
    left: int
    bottom: int
    right: int


@dataclass(frozen=True, slots=True)
class Tile:
    """A part of a picture that has become known: every `step`-th pixel of every `step`-th row from row `top` on.

    Rows count from the top of what is rendered, and a tile is as wide as that. Each of its `pixels` (rows x columns
    x 3) stands for the square of `step` pixels a side of which it is the upper left.
    """

    top: int
    step: int
    pixels: Picture


class RenderOptions(TypedDict, total=False):
    """What may be asked of a picture. What is not given, or None, is as the scene says."""

    width: int | None
    """Pixels in a row. With a width or a height the REGION of the scene's VIEW does not count."""
    height: int | None
    """Pixels in a column."""
    region: Region | tuple[int, int, int, int] | None
    """Only this part of the picture: top row, left column, bottom row, right column."""
    rows: tuple[int, int] | None
    """Only the rows from the first to the second, both included."""
    straight: bool
    """Straight rays, whatever MIRAGE says."""
    shadows: bool | None
    """Whether lights cast shadows."""
    depth: int | None
    """Level of the last mirror ray; the eye's ray is level 1."""
    log_scale: float | None
    """LOGSCALE; 1 or less has no effect."""
    normalize: bool
    """Divides by the largest value of all, before LOGSCALE, instead of clipping at 1."""
    samples: int
    """Rays a pixel, spread by a Blackman-Harris filter three pixels wide; 1, the default, goes through its middle."""
    refract_reflections: bool | None
    """Whether the air bends mirror rays as it bends those of the eye."""
    threads: int | None
    """How many threads work; all processors if not given. The picture does not depend on it."""
    progress: Callable[[int, int], object] | None
    """Called with the rows done and all rows as the work goes on."""
    cancel: Callable[[], object] | None
    """Asked many times a second; once it returns true, `Cancelled` is raised."""
    tiles: Callable[[Tile], object] | None
    """Called with each part of the picture that has become known: first 1/16 of all pixels, then 1/4, then all."""
