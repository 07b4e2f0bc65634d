"""From a scene's IR to the values of its picture."""

from __future__ import annotations

import os
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from m3d_render import _kernel
from m3dc.ir import SceneIR, TextureKind

Picture: TypeAlias = NDArray[np.float32]
Progress: TypeAlias = Callable[[int, int], object]
Cancel: TypeAlias = Callable[[], object]

LARGEST_SIDE = 65_535
"""Pixels a picture may have in a row, or in a column."""


class SceneError(ValueError):
    """The scene cannot be rendered as it is, or not as asked."""


class Cancelled(Exception):  # noqa: N818  it is no error
    """The `cancel` callback ended the rendering."""


@dataclass(frozen=True, slots=True)
class Rays:
    """How many rays were traced: from the eye (of them `mirage` curved ones, made of `arcs`), and on from surfaces."""

    eye: int
    mirage: int
    reflected: int
    shadow: int
    arcs: int


@dataclass(frozen=True, slots=True)
class Rendering:
    """A picture and what it took. Seconds: `build` for the kernel's own scene, `trace` for the picture."""

    picture: Picture
    rays: Rays
    build: float
    trace: float
    threads: int


@dataclass(frozen=True, slots=True)
class Prepared:
    """A scene in the kernel, from which several pictures can be made."""

    ir: SceneIR
    kernel: _kernel.Scene
    seconds: float

    def render(
        self,
        *,
        width: int | None = None,
        height: int | None = None,
        straight: bool = False,
        shadows: bool | None = None,
        depth: int | None = None,
        log_scale: float | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> Rendering:
        """A picture, by the same arguments as `m3d_render.render`."""
        scene = self.ir.scene
        view = scene.view
        columns = _side("width", view.width if width is None else width)
        rows = _side("height", view.height if height is None else height)
        left, top, right, bottom = 0, 0, columns - 1, rows - 1
        if width is None and height is None:
            left, right = _clamp(view.left, columns), _clamp(view.right_edge, columns)
            top, bottom = _clamp(view.top, rows), _clamp(view.bottom, rows)
        if not straight:
            self._check_observer()
        workers = usable_threads() if threads is None else _whole("threads", threads, 1, 4096)
        started = time.perf_counter()
        result = self.kernel.render(
            width=columns,
            height=rows,
            left=left,
            top=top,
            columns=max(right, left) - left + 1,
            rows=max(bottom, top) - top + 1,
            straight=straight,
            shadows=scene.shadows if shadows is None else bool(shadows),
            depth=_whole("depth", scene.depth if depth is None else depth, 1, 1_000_000_000),
            log_scale=float(scene.log_scale if log_scale is None else log_scale),
            threads=workers,
            progress=progress,
            cancel=cancel,
        )
        if result is None:
            raise Cancelled
        picture, counts = result
        return Rendering(picture, Rays(**counts), self.seconds, time.perf_counter() - started, workers)

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


def render(
    ir: SceneIR,
    *,
    width: int | None = None,
    height: int | None = None,
    straight: bool = False,
    shadows: bool | None = None,
    depth: int | None = None,
    log_scale: float | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Picture:
    """The picture of a scene: rows x columns x (red, green, blue), from 0 to 1.

    What is not given is as the scene says. `straight` ignores its MIRAGE. With a `width` or a `height` the whole
    picture is rendered, otherwise the REGION of its VIEW. `progress(rows, all_rows)` is called as rows are finished;
    `cancel()` is asked several times a second, and once it returns true, `Cancelled` is raised. The picture does
    not depend on the number of `threads`.
    """
    return (
        prepare(ir)
        .render(
            width=width,
            height=height,
            straight=straight,
            shadows=shadows,
            depth=depth,
            log_scale=log_scale,
            threads=threads,
            progress=progress,
            cancel=cancel,
        )
        .picture
    )


def prepare(ir: SceneIR, *, finer: int = 1) -> Prepared:
    """Builds the kernel's scene. `finer` divides each interval of the temperature profile into so many layers."""
    missing = missing_textures(ir)
    if missing:
        names = ", ".join(missing)
        warnings.warn(f"rendering without the textures this version does not have: {names}", stacklevel=3)
    started = time.perf_counter()
    try:
        kernel = _kernel.Scene(ir, _whole("finer", finer, 1, 10_000))
    except ValueError as error:
        raise SceneError(str(error)) from None
    return Prepared(ir, kernel, time.perf_counter() - started)


def missing_textures(ir: SceneIR) -> list[str]:
    """Names of the scene's textures that the kernel does not have."""
    kinds = sorted({int(kind) for kind in ir["textures"]["kind"]} - set(_kernel.TEXTURE_KINDS))
    known = {int(kind) for kind in TextureKind}
    return [TextureKind(kind).name if kind in known else str(kind) for kind in kinds]


def usable_threads() -> int:
    """How many processors this process may use."""
    try:
        return max(1, len(os.sched_getaffinity(0)))
    except AttributeError:
        return os.cpu_count() or 1


def _whole(name: str, value: int, least: int, most: int) -> int:
    if not least <= value <= most:
        raise SceneError(f"{name} must be from {least} to {most}, not {value}")
    return int(value)


def _side(name: str, value: int) -> int:
    return _whole(name, value, 1, LARGEST_SIDE)


def _clamp(value: int, length: int) -> int:
    return min(max(value, 0), length - 1)
