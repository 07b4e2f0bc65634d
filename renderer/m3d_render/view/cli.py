"""The `m3d-view` command: a scene to walk around in, or a picture of it.

Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from m3dc_command import Terminated

from m3d_render import command
from m3d_render.command import FINE, USAGE_ERROR, CommandError, say
from m3d_render.view.backend import check_window, load_pyvista
from m3d_render.view.fan import MOST_RAYS, RAYS
from m3d_render.view.follower import Follower
from m3d_render.view.opening import Fault, Opened, open_scene
from m3d_render.view.stage import LAYERS, Stage
from m3d_render.view.viewpoint import FROM, LEAST_VERTICAL, MOST_VERTICAL
from m3d_render.view.window import Window, heading
from m3dc.files.artefact import write_file

SUFFIXES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp")
LARGEST_SIDE = 8192
NOTHING = "nothing is there"


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return command.ended("m3d-view", lambda: _run(_parser().parse_args(arguments)))


def _parser() -> argparse.ArgumentParser:
    parser = command.parser(
        "m3d-view",
        "Show a scene in a window to walk around in: its solids in their colours, its camera, lights, "
        "extent, and the rays from the eye as the air bends them. The window follows the file as it is saved; the keys "
        "are written in it, and a click names a solid.",
    )
    command.add_scene(parser)
    parser.add_argument(
        "--screenshot",
        type=Path,
        metavar="PICTURE",
        help=f"open no window, which needs no display: write what it would show ({', '.join(SUFFIXES)})",
    )
    parser.add_argument(
        "--from",
        dest="place",
        choices=FROM,
        default="camera",
        help="from where: the scene's camera (the default), above, or the side, both with parallel lines of sight",
    )
    parser.add_argument(
        "--vertical",
        type=_vertical,
        metavar="N",
        help="stretch heights N times: mirages are kilometres long and metres high (from the side as much as shows "
        "something, else 1)",
    )
    parser.add_argument(
        "--rays",
        type=command.whole(0, MOST_RAYS),
        default=RAYS,
        metavar="N",
        help=f"how many rays ({RAYS}); 0 for none",
    )
    parser.add_argument(
        "--hide", type=_layers, default=(), metavar="NAME,...", help=f"what not to show at first: {', '.join(LAYERS)}"
    )
    parser.add_argument("--size", type=_size, default=(1200, 750), metavar="WxH", help="pixels (1200x750)")
    parser.add_argument(
        "--pick",
        type=command.numbers(2, ",", "COLUMN,ROW"),
        metavar="COLUMN,ROW",
        help="say what a click there would, pixels from 0 at the top left; also to standard output",
    )
    return parser


def _vertical(text: str) -> float:
    value = command.number(text)
    if not LEAST_VERTICAL <= value <= MOST_VERTICAL:
        raise argparse.ArgumentTypeError(f"{value:g} is not from {LEAST_VERTICAL:g} to {MOST_VERTICAL:g}")
    return value


def _layers(text: str) -> tuple[str, ...]:
    names = tuple(text.split(","))
    unknown = [name for name in names if name not in LAYERS]
    if unknown:
        raise argparse.ArgumentTypeError(f"'{unknown[0]}' is none of {', '.join(LAYERS)}")
    return names


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    side = command.whole(16, LARGEST_SIDE)
    return side(width), side(height)


def _run(options: argparse.Namespace) -> int:
    output: Path | None = options.screenshot
    if output is not None:
        if output.suffix.lower() not in SUFFIXES:
            raise CommandError(USAGE_ERROR, f"{output}: one of {', '.join(SUFFIXES)} must name the picture's format")
        command.check_outputs(options.scene, [output])
        command.check_folder(output)
    with ThreadPoolExecutor(1) as executor:
        follower = None if options.scene == "-" else Follower(Path(options.scene), executor)
        opened = _first(options.scene)
        stage = _stage(load_pyvista(window=output is None), opened, options)
        if output is not None:
            _write(output, stage, options)
            say(f"m3d-view: {_shown(stage, options)}; written: {output}")
            return FINE
        window = Window(stage, command.name(options.scene), follower)
        say(f"m3d-view: {_shown(stage, options)}; the window follows the file, and q closes it")
        if options.pick is not None:
            print(window.click(*options.pick) or NOTHING, flush=True)
        if number := window.run():
            raise Terminated(number)
        return FINE


def _shown(stage: Stage, options: argparse.Namespace) -> str:
    """What is shown, and how, in words."""
    where = {"camera": "from the scene's camera", "above": "from above", "side": "from the side"}[options.place]
    if stage.vertical == 1:
        return f"{command.name(options.scene)} {where}"
    why = "" if options.vertical is not None else ", or little would be seen; --vertical 1 shows them as they are"
    return f"{command.name(options.scene)} {where}, heights stretched {stage.vertical:g} times{why}"


def _first(scene: str) -> Opened:
    opened = open_scene(scene)
    if isinstance(opened, Fault):
        print(opened.report, end="", file=sys.stderr)
        raise CommandError(opened.status)
    return opened


def _stage(pyvista: Any, opened: Opened, options: argparse.Namespace) -> Stage:
    stage = Stage(
        pyvista,
        size=options.size,
        off_screen=options.screenshot is not None,
        rays=options.rays,
        hidden=options.hide,
        vertical=options.vertical,
        title=f"{command.name(options.scene)} - m3d-view",
    )
    if options.screenshot is None:
        check_window(stage.plotter)
    stage.show(opened)
    stage.look(options.place)
    return stage


def _write(output: Path, stage: Stage, options: argparse.Namespace) -> None:
    stage.say(heading(command.name(options.scene), stage))
    if options.pick is not None:
        picked = stage.pick(*options.pick)
        text = NOTHING if picked is None else stage.describe(picked)
        stage.say(text, "upper_right")
        print(text)
    try:
        write_file(output, stage.photograph(output.suffix))
    except BrokenPipeError:
        raise
    except OSError as error:
        raise CommandError(USAGE_ERROR, f"{output}: {command.reason(error)}") from None
    finally:
        stage.plotter.close()


if __name__ == "__main__":
    sys.exit(main())
