"""Where a picture goes that a command makes: a file, or standard output, and in which format."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from m3d_render import command
from m3d_render.command import USAGE_ERROR, CommandError
from m3d_render.formats import BY_SUFFIX, USUAL
from m3d_render.picture import paths
from m3dc.files.artefact import names_stream

STANDARD_OUTPUT = "-"


class Destination(NamedTuple):
    """`path` is None for standard output; `suffix` names the format; `name` is what to call it."""

    name: str
    path: Path | None
    suffix: str


def add_options(parser: argparse.ArgumentParser, suffixes: Sequence[str], more: str) -> None:
    """The options that `destination` reads."""
    parser.add_argument(
        "-o",
        dest="output",
        metavar="PICTURE",
        help=f"where to write the picture; its suffix names the format: {', '.join(suffixes)}{more}; - is standard "
        "output",
    )
    parser.add_argument(
        "--format",
        metavar="NAME",
        type=str.lower,
        help="the format, whatever the suffix: png, tif, exr ...; on standard output it is png if not given",
    )


def destination(options: argparse.Namespace, suffixes: Sequence[str], what: str = "picture") -> Destination:
    """Where the options want the picture, which messages call `what`. Finds out before the work begins what would spoil
    its end, and loads what writes the format. Raises CommandError."""
    output: str = options.output
    path = None if output == STANDARD_OUTPUT else Path(output)
    suffix = _suffix(options.format, path)
    if suffix not in suffixes:
        known = ", ".join(suffixes)
        if options.format:
            raise CommandError(USAGE_ERROR, f"--format {options.format}: one of {known.replace('.', '')} is expected")
        found = f"'{suffix}'" if suffix else "no suffix"
        raise CommandError(USAGE_ERROR, f"{output}: {found}, where one of {known} must name the {what}'s format")
    format_ = BY_SUFFIX.get(suffix)  # none of an .svg
    planes = format_ is not None and format_.writer is None
    if path is None and planes:
        raise CommandError(USAGE_ERROR, f"a {suffix[1:]} picture is three files, and standard output is one")
    if path is not None:
        files = [path] if format_ is None else paths(path, suffix)
        command.check_outputs(options.scene, files)
        for each in files:
            command.check_folder(each)
    if format_ is not None and not planes:
        # Now, because an interrupt while it is being loaded would cost the whole rendering later.
        import OpenImageIO  # noqa: F401  # pyright: ignore[reportUnusedImport]
    return Destination("standard output" if path is None else output, path, suffix)


def _suffix(given: str | None, path: Path | None) -> str:
    if given:
        return f".{given.removeprefix('.')}"
    if path is None or names_stream(path):
        return USUAL
    return path.suffix.lower()
