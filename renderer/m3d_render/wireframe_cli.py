"""The wireframe of `m3d-render --wireframe`: its options, and what is written."""

from __future__ import annotations

import argparse

from m3d_render import _kernel, command, destination
from m3d_render.command import FINE, SCENE_ERROR, USAGE_ERROR, CommandError
from m3d_render.formats import SUFFIXES
from m3d_render.options import OPTIONS
from m3d_render.picture import PictureError, encoded, write_picture
from m3d_render.rendering import SceneError
from m3d_render.wireframe.drawing import HIDDEN, project
from m3d_render.wireframe.marks import MARKS
from m3d_render.wireframe.raster import PAPERS, raster
from m3d_render.wireframe.svg import svg
from m3dc.diagnostics import report
from m3dc.files.artefact import write_file

WITHOUT_EFFECT = (*(name for name in OPTIONS if name not in ("width", "height")), "aov", "stats")
"""Options of a rendered picture that say nothing of a wireframe."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Adds the wireframe's options to those of m3d-render."""
    group = parser.add_argument_group("wireframe, instead of a rendered picture")
    group.add_argument(
        "--wireframe", action="store_true", help="draw the edges of everything, with straight rays; PICTURE may be .svg"
    )
    group.add_argument("--from-above", action="store_true", help="not from the scene's camera, but as a map")
    group.add_argument(
        "--hidden",
        choices=HIDDEN,
        default="show",
        help="lines behind surfaces: show them like all others (the default), dim them to dashes, or remove them",
    )
    group.add_argument(
        "--show", type=_marks, default=(), metavar="NAME,...", help=f"draw besides: {', '.join(MARKS)}; or all"
    )
    group.add_argument("--paper", choices=PAPERS, default="black", help="what the lines are drawn on (black)")


def _marks(text: str) -> tuple[str, ...]:
    names = MARKS if text == "all" else tuple(text.split(","))
    unknown = [name for name in names if name not in MARKS]
    if unknown:
        raise argparse.ArgumentTypeError(f"'{unknown[0]}' is none of {', '.join(MARKS)}")
    return names


def check_options(parser: argparse.ArgumentParser, options: argparse.Namespace) -> None:
    """Ends the command where options of a wireframe and of a rendered picture are mixed."""

    def given(names: tuple[str, ...]) -> list[str]:
        found = [name for name in names if getattr(options, name) != parser.get_default(name)]
        return [f"--{name.replace('_', '-')}" for name in found]

    if options.wireframe:
        idle = given(WITHOUT_EFFECT)
        if idle:
            parser.error(f"{idle[0]} has no effect on a --wireframe; leave one of them out")
    else:
        idle = given(("from_above", "hidden", "show", "paper"))
        if idle:
            parser.error(f"{idle[0]} is an option of --wireframe; add that")


def run(options: argparse.Namespace) -> int:
    """Draws the wireframe that the options ask for."""
    to = destination.destination(options, (".svg", *SUFFIXES), "wireframe")
    ir = command.load(options.scene)
    try:
        drawing = project(
            ir, options.width, options.height, from_above=options.from_above, hidden=options.hidden, show=options.show
        )
    except SceneError as error:
        raise CommandError(SCENE_ERROR, f"{options.scene}: {error}") from None
    described = {
        "Software": f"m3d-render {_kernel.VERSION}",
        "ImageDescription": f"{command.name(options.scene)}; wireframe{' from above' if options.from_above else ''}",
    }
    try:
        if to.path is not None and to.suffix != ".svg":
            write_picture(to.path, raster(drawing, options.paper), described, suffix=to.suffix)
            return FINE
        if to.suffix == ".svg":
            content = report.valid(svg(drawing, options.paper)).encode()
        else:
            content = encoded(to.suffix, raster(drawing, options.paper), described)
        if to.path is None:
            command.write_output(content)
        else:
            write_file(to.path, content)
    except PictureError as error:
        raise CommandError(USAGE_ERROR, str(error)) from None
    except BrokenPipeError:
        raise
    except OSError as error:
        raise CommandError(USAGE_ERROR, f"{to.name}: {command.reason(error)}") from None
    return FINE
