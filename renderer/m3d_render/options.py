"""What may be asked of a picture: the one list of render options.

`RenderOptions` is what Python's `render` takes. An option with an `Option` beside its type is also one of `m3d-render`
and, where it says so, of the kernel and of previews. The command line reads this list; `make generate` makes of it what
the Rust code and the preview protocol know of options, and the table in docs/rendering.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, NamedTuple, TypeAlias, TypedDict, get_type_hints

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


class Whole(NamedTuple):
    """A whole number within its range."""

    least: int
    most: int
    metavar: str = "N"


class Real(NamedTuple):
    """A number."""

    metavar: str


class Switch(NamedTuple):
    """Yes or no."""


class Wholes(NamedTuple):
    """So many whole numbers from 0, with a separator between them on a command line."""

    many: int
    separator: str
    metavar: str


Kind: TypeAlias = Whole | Real | Switch | Wholes
Value: TypeAlias = bool | int | float

VIEW = "view, instead of the scene's"
LIGHT = "light and air"
BEYOND = "beyond the thesis"
WORK = "work"


class Option(NamedTuple):
    """One option. `help` says what it is in a phrase; `group` is its heading in the help of `m3d-render`. One without a
    `default` is as the scene says. With `kernel` it reaches every pixel's computation as it is; an option of the kernel
    without a default is a field of the same name in the IR's `Scene`. With `preview` a client of previews may ask for
    it, too. Not both of the options of a picture's `part` may be given.
    """

    kind: Kind
    group: str
    help: str
    default: Value | None = None
    kernel: bool = False
    preview: bool = False
    part: bool = False


class RenderOptions(TypedDict, total=False):
    """What may be asked of a picture. What is not given, or None, is as the scene says. With a width or a height the
    REGION of the scene's VIEW does not count. The picture does not depend on the number of threads."""

    width: Annotated[int | None, Option(Whole(1, LARGEST_SIDE), VIEW, "pixels in a row")]
    height: Annotated[int | None, Option(Whole(1, LARGEST_SIDE), VIEW, "pixels in a column")]
    region: Annotated[
        Region | tuple[int, int, int, int] | None,
        Option(
            Wholes(4, ",", "T,L,B,R"),
            VIEW,
            "only this part: top row, left column, bottom row, right column, from 0",
            part=True,
        ),
    ]
    rows: Annotated[
        tuple[int, int] | None,
        Option(Wholes(2, ":", "A:B"), VIEW, "only rows A to B, both included, from 0", part=True),
    ]
    straight: Annotated[
        bool, Option(Switch(), LIGHT, "straight rays, whatever MIRAGE says", default=False, kernel=True)
    ]
    shadows: Annotated[
        bool | None, Option(Switch(), LIGHT, "cast shadows, even if the scene does not say so", kernel=True)
    ]
    depth: Annotated[
        int | None,
        Option(Whole(1, 1_000_000_000), LIGHT, "level of the last mirror ray; the eye ray is 1", kernel=True),
    ]
    normalize: Annotated[
        bool,
        Option(
            Switch(),
            LIGHT,
            "divide by the largest value, before LOGSCALE, instead of clipping",
            default=False,
            kernel=True,
        ),
    ]
    log_scale: Annotated[
        float | None, Option(Real("S"), LIGHT, "LOGSCALE, instead of the scene's; above 1", kernel=True)
    ]
    samples: Annotated[
        int,
        Option(
            Whole(1, MOST_SAMPLES),
            BEYOND,
            "rays a pixel, spread by a smooth filter: no jagged edges (1)",
            default=1,
            kernel=True,
            preview=True,
        ),
    ]
    refract_reflections: Annotated[
        bool | None,
        Option(Switch(), BEYOND, "the air bends mirror rays too, even if the scene does not say so", kernel=True),
    ]
    threads: Annotated[int | None, Option(Whole(1, 4096), WORK, "threads; all processors if not given")]
    progress: Callable[[int, int], object] | None
    """Called with the rows done and all rows as the work goes on."""
    cancel: Callable[[], object] | None
    """Asked many times a second; once it returns true, `Cancelled` is raised."""
    tiles: Callable[[Tile], object] | None
    """Called with each part of the picture that has become known: first 1/16 of all pixels, then 1/4, then all."""


OPTIONS: dict[str, Option] = {
    name: option
    for name, hint in get_type_hints(RenderOptions, include_extras=True).items()
    for option in getattr(hint, "__metadata__", ())
    if isinstance(option, Option)
}
"""The options that can be written down, by name."""

KERNEL = {name: option for name, option in OPTIONS.items() if option.kernel}
PREVIEW = {name: option for name, option in OPTIONS.items() if option.preview}
