"""Pictures in files, in the formats of `formats`.

Values from 0 to 1 are what a screen is to show: brightness as sRGB encodes it. A format holds them as they are, or as
linear light, where that is what its readers expect: the same brightness. All but planes say which of the two they hold.

A picture is encoded and read back before anything is written, and its file takes its place only once it is whole, so
that a failed or interrupted write leaves what was there before.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
import time
from collections.abc import Generator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from m3d_render.formats import BY_SUFFIX, LINEAR, SUFFIXES, Format, with_layers
from m3dc.files.artefact import replacing

if TYPE_CHECKING:
    import OpenImageIO

Layers = Mapping[str, NDArray[np.floating]]

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
    layers: Layers | None = None,
    origin: tuple[int, int] = (0, 0),
    whole: tuple[int, int] | None = None,
    suffix: str | None = None,
) -> list[Path]:
    """Writes a picture (rows x columns x 3, 0..1); returns the files written. `suffix` names the format; it is the
    path's if not given.

    Some formats hold more: extra outputs, `layers`, as channels (see `CHANNELS`), and where in a `whole` picture of so
    many columns and rows this one has its upper left pixel, `origin`, as (column, row).
    """
    target = Path(path)
    if suffix is None:
        check_suffix(target)
        suffix = target.suffix.lower()
    targets = paths(target, suffix)
    if BY_SUFFIX[suffix].writer is None:
        contents = _planes(picture)
    else:
        try:
            contents = [encoded(suffix, picture, metadata, layers=layers, origin=origin, whole=whole)]
        except PictureError as error:
            raise PictureError(f"{target}: {error}") from None
    with _replacing(*targets) as files:
        for file, content in zip(files, contents, strict=True):
            file.write(content)
    return targets


def png(picture: NDArray[np.floating]) -> bytes:
    """The bytes of a PNG file of a picture."""
    return encoded(".png", picture)


def encoded(
    suffix: str,
    picture: NDArray[np.floating],
    metadata: Mapping[str, str] | None = None,
    *,
    layers: Layers | None = None,
    origin: tuple[int, int] = (0, 0),
    whole: tuple[int, int] | None = None,
) -> bytes:
    """The bytes of a picture's file in the format of a suffix, one with a writer. Raises PictureError."""
    format_ = BY_SUFFIX[suffix]
    pixels = stored(format_, picture)
    if format_.layers:
        pixels, spec = _with_layers(format_, pixels, metadata or {}, layers or {}, origin, whole)
    elif layers:
        raise PictureError(f"only an {with_layers()} can hold extra outputs")
    else:
        spec = _spec(pixels, metadata or {}, format_.color)
    try:
        with _scratch() as file:
            name = f"/dev/fd/{file.fileno()}"
            _write_image(name, format_.writer or "", np.ascontiguousarray(pixels), spec)
            file.seek(0)
            content = file.read()
            # Not every writer of OpenImageIO says that there was no room; and the reader of PNG shouts.
            if not (format_.is_whole(content) and _can_be_read(name, pixels, spec)):
                raise PictureError("the picture could not be encoded: there is no room for it")
            return content
    except PictureError:
        raise
    except OSError as error:
        raise PictureError(f"the picture could not be encoded: {error.strerror or error}") from None


def _scratch() -> BinaryIO:
    """A file without a name, in memory where the system has that: nothing is left of it, whatever happens."""
    if hasattr(os, "memfd_create"):
        return os.fdopen(os.memfd_create("picture"), "w+b")
    return tempfile.TemporaryFile()


def stored(format_: Format, values: NDArray[np.floating]) -> NDArray[np.uint8 | np.uint16 | np.float32]:
    """Values from 0 to 1 as the format holds them: a level is the value times the number of levels, rounded."""
    if format_.color == LINEAR:
        values = linear(values)
    if format_.levels is None:
        return values.astype(np.float32)
    return np.rint(np.clip(values, 0.0, 1.0) * format_.levels).astype(format_.kind)


def linear(values: NDArray[np.floating]) -> NDArray[np.float32]:
    """Linear light from values as sRGB encodes them (IEC 61966-2-1), both 0..1."""
    exact = np.asarray(values, np.float64)
    return np.where(exact <= 0.04045, exact / 12.92, ((exact + 0.055) / 1.055) ** 2.4).astype(np.float32)


def check_suffix(target: Path) -> None:
    """Refuses a path whose suffix names no format."""
    if target.suffix.lower() not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        found = f"'{target.suffix}'" if target.suffix else "no suffix"
        raise PictureError(f"{target}: {found}, where one of {known} must name the picture's format")


def paths(target: Path, suffix: str) -> list[Path]:
    """The files of a picture in the format of a suffix: one, or three planes."""
    if BY_SUFFIX[suffix].writer is not None:
        return [target]
    return [target.with_name(f"{target.stem}.{channel}{target.suffix}") for channel in _PLANES]


def to_bytes(picture: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Values in 8 bits: 255 v, rounded."""
    return np.rint(np.clip(picture, 0.0, 1.0) * 255.0).astype(np.uint8)


def _planes(picture: NDArray[np.floating]) -> list[bytes]:
    values = to_bytes(picture)
    return [np.ascontiguousarray(values[..., channel]).tobytes() for channel in range(3)]


def _with_layers(
    format_: Format,
    pixels: NDArray[Any],
    metadata: Mapping[str, str],
    layers: Layers,
    origin: tuple[int, int],
    whole: tuple[int, int] | None,
) -> tuple[NDArray[np.float32], OpenImageIO.ImageSpec]:
    names = ["R", "G", "B"]
    parts: list[NDArray[np.floating]] = [pixels]
    for name, values in layers.items():
        names += CHANNELS[name]
        parts.append(values.reshape(*pixels.shape[:2], len(CHANNELS[name])))
    joined = np.concatenate(parts, axis=2, dtype=np.float32, casting="same_kind")
    spec = _spec(joined, metadata, format_.color)
    spec.channelnames = tuple(names)
    spec.x, spec.y = origin
    if whole is not None:
        spec.full_width, spec.full_height = whole
    return joined, spec


def _spec(pixels: NDArray[Any], metadata: Mapping[str, str], color_space: str) -> OpenImageIO.ImageSpec:
    import OpenImageIO

    rows, columns, channels = pixels.shape
    kind = {"uint8": "uint8", "uint16": "uint16", "float32": "float"}[pixels.dtype.name]
    spec = OpenImageIO.ImageSpec(columns, rows, channels, kind)
    spec.attribute("oiio:ColorSpace", color_space)
    spec.attribute("DateTime", _date())
    for name, value in metadata.items():
        spec.attribute(name, value)
    return spec


def _date() -> str:
    """SOURCE_DATE_EPOCH as pictures hold a time. Without it they hold none: the same picture is the same file."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    return time.strftime("%Y:%m:%d %H:%M:%S", time.gmtime(int(epoch))) if epoch.isdecimal() else ""


def _write_image(name: str, kind: str, pixels: NDArray[Any], spec: OpenImageIO.ImageSpec) -> None:
    import OpenImageIO

    output = OpenImageIO.ImageOutput.create(kind)
    if not output:
        raise PictureError(f"no writer for {kind}: {OpenImageIO.geterror()}")
    try:
        # The stub leaves one of its overloads open.
        opened = output.open(name, spec)  # pyright: ignore[reportUnknownMemberType]
        written = opened and output.write_image(pixels)
        reason = output.geterror()
    finally:
        closed = output.close()
    if not (written and closed):
        raise PictureError(f"the picture could not be written: {reason or output.geterror()}")


def _can_be_read(name: str, pixels: NDArray[Any], spec: OpenImageIO.ImageSpec) -> bool:
    """Whether what was written is the picture."""
    import OpenImageIO

    source: Any = OpenImageIO.ImageInput.open(name)
    if not source:
        OpenImageIO.geterror()
        return False
    found = source.read_image(0, 0, 0, spec.nchannels, "unknown")
    source.geterror()  # else it would be printed in the end
    names: list[str] = list(source.spec().channelnames)
    wanted: list[str] = list(spec.channelnames)  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]
    source.close()
    if found is None or sorted(names) != sorted(wanted):
        return False
    order = [names.index(channel) for channel in wanted]
    return np.array_equal(found[..., order], pixels, equal_nan=pixels.dtype.kind == "f")


@contextlib.contextmanager
def _replacing(*targets: Path) -> Generator[list[BinaryIO]]:
    """`replacing`, whose failures name the picture."""
    try:
        with replacing(*targets) as files:
            yield files
    except BrokenPipeError:
        raise
    except OSError as error:
        raise PictureError(f"{targets[0]}: {error.strerror or error}") from None
