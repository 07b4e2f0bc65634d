"""The formats of picture files: the one table.

A format is chosen by a suffix. The commands read this table; the file dialog of the VS Code extension and the table in
docs/rendering.md are made of it (`make generate`).
"""

from __future__ import annotations

import zlib
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

SRGB = "srgb_rec709_scene"
LINEAR = "lin_rec709_scene"


class Format(NamedTuple):
    """One format. The first of the `suffixes` is the usual one; `name` is what a file dialog calls it, and `holds` what
    the docs say of it.

    `levels` is the number that 1 becomes, or None where values are floating point. `color` is how OpenImageIO calls the
    encoding of its values, which the file names: LINEAR or SRGB. `writer` is what OpenImageIO calls the format; one
    without is three planes of bytes, a file each. `layers` is whether it holds extra outputs, and where in a larger
    picture this one is. `is_whole` finds what a reader of OpenImageIO would not say of a file that was cut short.
    """

    suffixes: tuple[str, ...]
    name: str
    holds: str
    kind: type[np.uint8] | type[np.uint16] | type[np.float32]
    levels: float | None = None
    color: str = SRGB
    writer: str | None = None
    layers: bool = False
    is_whole: Callable[[bytes], bool] = lambda _: True


def _is_whole_png(content: bytes) -> bool:
    """Whether all chunks are there, each with its checksum, up to the last."""
    place, kind = 8, b""
    while kind != b"IEND":
        length = int.from_bytes(content[place : place + 4], "big")
        body = content[place + 4 : place + 8 + length]
        kind = body[:4]
        place += length + 12
        if len(body) != length + 4 or zlib.crc32(body) != int.from_bytes(content[place - 4 : place], "big"):
            return False
    return place == len(content)


FORMATS = (
    Format((".png",), "PNG, 8 bits", "8 bits a channel, sRGB", np.uint8, 255.0, writer="png", is_whole=_is_whole_png),
    Format((".tif", ".tiff"), "TIFF, 16 bits", "16 bits a channel, sRGB", np.uint16, 65535.0, writer="tiff"),
    Format(
        (".exr",),
        "OpenEXR, floating point",
        "floating point, linear light, and the extra outputs",
        np.float32,
        color=LINEAR,
        writer="openexr",
        layers=True,
    ),
    Format(
        (".raw",),
        "Three planes of the 1993 program, 8 bits",
        "three files of the 1993 program, NAME.red.raw, NAME.green.raw, NAME.blue.raw, 8 bits",
        np.uint8,
        255.0,
    ),
)

BY_SUFFIX = {suffix: format_ for format_ in FORMATS for suffix in format_.suffixes}
SUFFIXES = tuple(BY_SUFFIX)
"""The suffixes that name a format."""

USUAL = ".png"
"""The format where nothing names one."""


def with_layers() -> str:
    """The formats that hold extra outputs, for people."""
    return " or ".join(format_.suffixes[0] for format_ in FORMATS if format_.layers)
