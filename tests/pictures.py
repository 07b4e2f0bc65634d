"""How a picture of the documentation is compared with what is rendered now."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO
from numpy.typing import NDArray

STEPS = 2
"""How far 8-bit values may be apart: another processor's exp or cos may round another way."""


def read_pixels(image: OpenImageIO.ImageBuf, kind: OpenImageIO.BASETYPE) -> NDArray[Any]:
    """The pixels of a picture as numbers of that kind, (H, W, channels)."""
    pixels = image.get_pixels(kind)
    assert pixels is not None, image.geterror()
    return pixels


def channel_names(image: OpenImageIO.ImageBuf) -> list[str]:
    """The names of a picture's channels, in their order."""
    return list(map(str, image.spec().channelnames))  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]  its stub says tuple


def float_pixels(file: Path | str) -> NDArray[np.float32]:
    """The pixels of a picture file as floats, (H, W, channels)."""
    return read_pixels(OpenImageIO.ImageBuf(str(file)), OpenImageIO.FLOAT)


def stored(file: Path) -> NDArray[np.int64]:
    """The 8-bit pixels of a picture file, (H, W, channels)."""
    return read_pixels(OpenImageIO.ImageBuf(str(file)), OpenImageIO.UINT8).astype(int)


def in_steps(picture: NDArray[np.floating]) -> NDArray[np.int64]:
    """Values 0..1 as the 8-bit values that a file would hold."""
    return np.rint(picture * 255).astype(int)


def assert_current(fresh: NDArray[np.int64], kept: NDArray[np.int64], edges: float, name: str = "") -> None:
    """Fails where more than the share `edges` of all pixels differ by more than STEPS, as some do along edges."""
    assert fresh.shape == kept.shape, name
    differs = np.abs(fresh - kept).max(axis=-1) > STEPS
    assert differs.mean() <= edges, f"{name}: {differs.sum()} pixels differ; look at them, then `make gallery`"
