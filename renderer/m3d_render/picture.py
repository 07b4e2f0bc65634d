"""Pictures in files: PNG (8 bits), TIFF (16 bits), EXR (32-bit floating point), and the three planar files of the
1993 program, NAME.red.raw, NAME.green.raw and NAME.blue.raw (8 bits).

A file is written beside its place and then moved there, so that a failed or interrupted write leaves what was
there before. Values are stored as they are, without gamma.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Generator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from m3dc.artefact import replacing

if TYPE_CHECKING:
    import OpenImageIO

SUFFIXES = (".png", ".tif", ".tiff", ".exr", ".raw")
"""The suffixes that name a format."""

CHANNELS: dict[str, list[str]] = {
    "depth": ["Z"],
    "normal": ["N.X", "N.Y", "N.Z"],
    "position": ["P.X", "P.Y", "P.Z"],
    "solid": ["solid"],
    "primitive": ["primitive"],
    "uv": ["U", "V"],
    "path": ["path.length", "path.arcs"],
}
"""What the extra outputs are called in an EXR."""

_PLANES = ("red", "green", "blue")


class PictureError(OSError):
    """A picture cannot be written where, or as, it was asked."""


def write_picture(
    path: str | os.PathLike[str],
    picture: NDArray[np.floating],
    metadata: Mapping[str, str] | None = None,
    *,
    layers: Mapping[str, NDArray[np.floating]] | None = None,
    origin: tuple[int, int] = (0, 0),
    whole: tuple[int, int] | None = None,
) -> list[Path]:
    """Writes a picture (rows x columns x 3, 0..1) in the format of the path's suffix; returns the files written.

    An EXR holds more: extra outputs, `layers`, as channels (see `CHANNELS`), and where in a `whole` picture of so
    many columns and rows this one has its upper left pixel, `origin`, as (column, row).
    """
    target = Path(path)
    check_suffix(target)
    suffix = target.suffix.lower()
    if layers and suffix != ".exr":
        raise PictureError(f"{target}: only an .exr can hold extra outputs")
    if suffix == ".raw":
        return _write_planes(target, picture)
    with _replacing(target) as (temporary,):
        if suffix == ".exr":
            _write_exr(temporary, picture, metadata or {}, layers or {}, origin, whole)
        else:
            levels, kind = (255.0, np.uint8) if suffix == ".png" else (65535.0, np.uint16)
            pixels = np.rint(np.clip(picture, 0.0, 1.0) * levels).astype(kind)
            _write_image(temporary, pixels, _spec(pixels, metadata or {}))
    return [target]


def png(picture: NDArray[np.floating]) -> bytes:
    """The bytes of a PNG file of a picture."""
    with tempfile.TemporaryDirectory() as folder:
        (file,) = write_picture(Path(folder) / "picture.png", picture)
        return file.read_bytes()


def check_suffix(target: Path) -> None:
    """Refuses a path whose suffix names no format."""
    if target.suffix.lower() not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        found = f"'{target.suffix}'" if target.suffix else "no suffix"
        raise PictureError(f"{target}: {found}, where one of {known} must name the picture's format")


def plane_paths(target: Path) -> list[Path]:
    """The three files of a .raw picture."""
    return [target.with_name(f"{target.stem}.{channel}{target.suffix}") for channel in _PLANES]


def to_bytes(picture: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Values in 8 bits: 255 v, rounded."""
    return np.rint(np.clip(picture, 0.0, 1.0) * 255.0).astype(np.uint8)


def _write_planes(target: Path, picture: NDArray[np.floating]) -> list[Path]:
    planes = plane_paths(target)
    values = to_bytes(picture)
    with _replacing(*planes) as temporaries:
        for channel, temporary in enumerate(temporaries):
            temporary.write_bytes(np.ascontiguousarray(values[..., channel]).tobytes())
    return planes


def _write_exr(
    temporary: Path,
    picture: NDArray[np.floating],
    metadata: Mapping[str, str],
    layers: Mapping[str, NDArray[np.floating]],
    origin: tuple[int, int],
    whole: tuple[int, int] | None,
) -> None:
    names = ["R", "G", "B"]
    parts = [picture]
    for name, values in layers.items():
        names += CHANNELS[name]
        parts.append(values.reshape(*picture.shape[:2], len(CHANNELS[name])))
    pixels = np.concatenate(parts, axis=2, dtype=np.float32, casting="same_kind")
    spec = _spec(pixels, metadata)
    spec.channelnames = tuple(names)
    spec.x, spec.y = origin
    if whole is not None:
        spec.full_width, spec.full_height = whole
    _write_image(temporary, pixels, spec)


def _spec(pixels: NDArray[Any], metadata: Mapping[str, str]) -> OpenImageIO.ImageSpec:
    import OpenImageIO

    rows, columns, channels = pixels.shape
    kind = {"uint8": "uint8", "uint16": "uint16", "float32": "float"}[pixels.dtype.name]
    spec = OpenImageIO.ImageSpec(columns, rows, channels, kind)
    for name, value in metadata.items():
        spec.attribute(name, value)
    return spec


def _write_image(temporary: Path, pixels: NDArray[Any], spec: OpenImageIO.ImageSpec) -> None:
    import OpenImageIO

    output = OpenImageIO.ImageOutput.create(str(temporary))
    if not output:
        raise PictureError(f"no writer for {temporary.suffix}: {OpenImageIO.geterror()}")
    try:
        # The stub leaves one of its overloads open.
        opened = output.open(str(temporary), spec)  # pyright: ignore[reportUnknownMemberType]
        written = opened and output.write_image(np.ascontiguousarray(pixels))
        reason = output.geterror()
    finally:
        closed = output.close()
    if not (written and closed):
        raise PictureError(f"the picture could not be written: {reason or output.geterror()}")


@contextlib.contextmanager
def _replacing(*targets: Path) -> Generator[list[Path]]:
    """`replacing`, whose failures name the picture."""
    try:
        with replacing(*targets) as temporaries:
            yield temporaries
    except PictureError:
        raise
    except OSError as error:
        raise PictureError(f"{targets[0]}: {error.strerror or error}") from None
