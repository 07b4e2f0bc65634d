"""From a scene's IR to the values of its picture."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias, Unpack

import numpy as np
from numpy.typing import NDArray

from m3d_render import _kernel
from m3d_render.options import KERNEL, OPTIONS, Option, Picture, Region, RenderOptions, Switch, Tile, Value, Whole
from m3d_render.picture import png
from m3dc.ir import SceneIR, m3ir

Layers: TypeAlias = dict[str, NDArray[np.float32]]

LAYERS: dict[str, int] = dict(_kernel.LAYERS)
"""The extra outputs, and how many numbers a pixel each has."""


MOST_FINER = 10_000
"""Layers that an interval of the temperature profile may be divided into."""


class SceneError(ValueError):
    """The scene cannot be rendered as it is, or not as asked."""


class Cancelled(Exception):  # noqa: N818  it is no error
    """The `cancel` callback ended the rendering. `rendering` is what there is: the finished rows from the top."""

    def __init__(self, rendering: Rendering) -> None:
        super().__init__("the rendering was cancelled")
        self.rendering = rendering


@dataclass(frozen=True, slots=True)
class Rays:
    """How many rays were traced: from the eye (of them `mirage` curved ones), on from surfaces to mirrored things,
    lights and the surroundings; and of how many arcs all curved ones are made."""

    eye: int
    mirage: int
    reflected: int
    shadow: int
    ambient: int
    arcs: int


@dataclass(frozen=True, slots=True)
class Rendering:
    """A picture and what it took.

    `picture` and each of `layers` begin with the rows and columns of `region`, a part of a picture of `width` x
    `height` pixels. Seconds: `build` for the kernel's own scene, `trace` for the picture. `bent` is whether rays
    were.
    """

    picture: Picture
    layers: Layers
    region: Region
    width: int
    height: int
    bent: bool
    rays: Rays
    build: float
    trace: float
    threads: int

    def _repr_png_(self) -> bytes | None:
        """The picture for a notebook; None where no row was finished."""
        return png(self.picture) if self.picture.size else None


@dataclass(frozen=True, slots=True)
class Request:
    """What the kernel is asked for, every choice made. `options` has a value for each option of the kernel."""

    width: int
    height: int
    left: int
    top: int
    columns: int
    rows: int
    options: dict[str, Value]
    layers: list[str]
    threads: int


@dataclass(frozen=True, slots=True)
class Prepared:
    """A scene in the kernel, from which several pictures can be made."""

    ir: SceneIR
    kernel: _kernel.Scene
    seconds: float

    def render(self, *, aov: Iterable[str] = (), **options: Unpack[RenderOptions]) -> Rendering:
        """A picture by the options, with extra outputs (AOVs) by their names in `LAYERS`.

        `depth` is the distance along the direction of view, infinite where a ray meets nothing; `normal` the unit
        vector that shades, before textures and FUZZ; `position` the point in the scene; `solid` and `primitive` the
        rows of those tables of the IR, `uv` the primitive's coordinates, all -1 where there are none; `path` the
        length of the ray and of how many arcs it is made. Each belongs to the ray through the pixel's middle.
        """
        request = self._request(tuple(aov), options)
        bent = self.kernel.observer is not None and not request.options["straight"]
        if bent:
            self._check_observer()
        tiles = options.get("tiles")

        def show(top: int, step: int, pixels: Picture) -> None:
            if tiles is not None:
                tiles(Tile(top, step, pixels))

        started = time.perf_counter()
        outcome = self.kernel.render(
            request, options.get("progress"), options.get("cancel"), None if tiles is None else show
        )
        done = outcome.finished_rows
        rendering = Rendering(
            outcome.pixels[:done],
            _split(outcome.layers[:done], request.layers),
            Region(request.top, request.left, request.top + done - 1, request.left + request.columns - 1),
            request.width,
            request.height,
            bent,
            Rays(**outcome.counts),
            self.seconds,
            time.perf_counter() - started,
            request.threads,
        )
        if done < request.rows:
            raise Cancelled(rendering)
        return rendering

    def _request(self, aov: tuple[str, ...], options: RenderOptions) -> Request:
        unknown = [*(options.keys() - RenderOptions.__annotations__), *(set(aov) - LAYERS.keys())]
        if unknown:
            raise TypeError(f"render() has no option or extra output {', '.join(sorted(unknown))}")
        view = self.ir.scene.view
        threads = options.get("threads")
        columns = _whole("width", options.get("width"), view.width)
        rows = _whole("height", options.get("height"), view.height)
        part = _part(self.ir, options, columns, rows)
        return Request(
            width=columns,
            height=rows,
            left=part.left,
            top=part.top,
            columns=part.right - part.left + 1,
            rows=part.bottom - part.top + 1,
            options={name: _choice(self.ir, name, option, options.get(name)) for name, option in KERNEL.items()},
            layers=list(dict.fromkeys(aov)),
            threads=_whole("threads", threads, usable_threads()),
        )

    def _check_observer(self) -> None:
        heights = self.kernel.observer
        if heights is None:
            return
        lowest, highest, eye = heights
        if not lowest <= eye <= highest:
            raise SceneError(
                f"the observer (VIEW FROM) is at height {eye:g}, outside of the temperature profile, "
                f"{lowest:g} to {highest:g}: extend the profile, move the observer, or render with straight rays"
            )


def _choice(ir: SceneIR, name: str, option: Option, given: object) -> Value:
    """The value of an option of the kernel, as it was given or the scene says. Raises SceneError."""
    value: Any = given
    if value is None:
        value = getattr(ir.scene, name) if option.default is None else option.default
    if isinstance(option.kind, Whole):
        return whole(name, value, option.kind.least, option.kind.most)
    return bool(value) if isinstance(option.kind, Switch) else float(value)


def _whole(name: str, given: int | None, default: int) -> int:
    """The value of an option that is a whole number; the default where none is given. Raises SceneError."""
    kind = OPTIONS[name].kind
    assert isinstance(kind, Whole)
    return whole(name, default if given is None else given, kind.least, kind.most)


def _part(ir: SceneIR, options: RenderOptions, columns: int, rows: int) -> Region:
    """What of a picture of so many columns and rows is wanted. The scene's REGION is moved to lie within, as the
    manual says; one that is asked for must begin within."""
    asked, band = options.get("region"), options.get("rows")
    if asked is not None and band is not None:
        raise SceneError("a region or rows may be given, not both")
    if asked is None and band is None:
        if options.get("width") is not None or options.get("height") is not None:
            return Region(0, 0, rows - 1, columns - 1)
        view = ir.scene.view
        top, left = _clamp(view.top, rows), _clamp(view.left, columns)
        return Region(top, left, max(top, _clamp(view.bottom, rows)), max(left, _clamp(view.right_edge, columns)))
    if band is not None:
        asked = Region(band[0], 0, band[1], columns - 1)
    elif asked is not None and not isinstance(asked, Region):
        asked = Region(*asked)
    assert asked is not None
    if not (0 <= asked.top <= asked.bottom and 0 <= asked.left <= asked.right):
        raise SceneError(f"no pixel lies between {_corners(asked)}")
    if asked.top >= rows or asked.left >= columns:
        raise SceneError(f"{_corners(asked)} lies outside of a picture of {columns} columns and {rows} rows")
    return Region(asked.top, asked.left, min(asked.bottom, rows - 1), min(asked.right, columns - 1))


def _corners(part: Region) -> str:
    return f"row {part.top}, column {part.left} and row {part.bottom}, column {part.right}"


def _split(values: NDArray[np.float32], layers: list[str]) -> Layers:
    """Each layer by its name; one of a single number a pixel has no third axis."""
    found: Layers = {}
    first = 0
    for name in layers:
        count = LAYERS[name]
        found[name] = values[..., first] if count == 1 else values[..., first : first + count]
        first += count
    return found


def render(ir: SceneIR, **options: Unpack[RenderOptions]) -> Picture:
    """The picture of a scene: rows x columns x (red, green, blue), from 0 to 1.

    What is not given is as the scene says. For extra outputs, counts and several pictures of one scene see
    `prepare`.
    """
    return prepare(ir).render(**options).picture


def prepare(ir: SceneIR, *, finer: int = 1) -> Prepared:
    """Builds the kernel's scene. `finer` divides each interval of the temperature profile into so many layers."""
    started = time.perf_counter()
    try:
        kernel = _kernel.Scene(m3ir.header(ir), dict(ir.tables), whole("finer", finer, 1, MOST_FINER))
    except ValueError as error:
        raise SceneError(str(error)) from None
    return Prepared(ir, kernel, time.perf_counter() - started)


def usable_threads() -> int:
    """How many processors this process may use."""
    try:
        return max(1, len(os.sched_getaffinity(0)))
    except AttributeError:
        return os.cpu_count() or 1


def whole(name: str, value: int, least: int, most: int) -> int:
    """A whole number within its range. Raises SceneError outside of it."""
    if not least <= value <= most:
        raise SceneError(f"{name} must be from {least} to {most}, not {value}")
    return int(value)


def _clamp(value: int, length: int) -> int:
    return min(max(value, 0), length - 1)
