"""The `m3d-plot` command: a scene in, a figure of its air, or the figure's data, out.

Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

# matplotlib leaves some types of its own open.
# pyright: reportUnknownMemberType=false
from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from m3d_render import command
from m3d_render.command import FINE, SCENE_ERROR, USAGE_ERROR, CommandError
from m3d_render.plot import figure, profile, rays, transfer
from m3d_render.ray_options import angles, distances
from m3d_render.rendering import SceneError
from m3dc.files.artefact import replacing, text_of
from m3dc.ir import SceneIR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Table = tuple[Sequence[str], Sequence[NDArray[Any]]]

MOST_PANELS = 6
MOST_POINTS = 20_000_000
LEGEND_COLUMN = 5.2
"""Width, cm, of the longest entry of a legend."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return command.ended("m3d-plot", lambda: _main(arguments))


def _main(arguments: Sequence[str] | None) -> int:
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.output is None and options.csv is None:
        parser.error("where should the figure go? Give -o FIGURE, or --csv FILE for its data")
    return _run(options)


def _parser() -> argparse.ArgumentParser:
    parser = command.parser(
        "m3d-plot",
        "Draw a figure of a scene's air: its temperature profile, the rays from the eye, or at which angle "
        "each height at a distance is seen.",
    )
    figures = parser.add_subparsers(dest="figure", metavar="FIGURE", required=True)
    shape = _add(
        figures,
        _profile,
        "profile",
        (18, 9),
        "temperature, its gradient and the curvature of level rays, against height",
    )
    _add_heights(shape)
    fan = _add(
        figures,
        _rays,
        "rays",
        (18, 10),
        "the fan of rays from the eye in the vertical plane of view, with layers, ground and solids in section",
    )
    _add_angles(fan, f"{rays.RAYS} over the picture's height")
    fan.add_argument(
        "--reach",
        type=_reach,
        metavar="R",
        help="how far the figure goes, m (a quarter beyond the distance of VIEW TO, or of the things behind it)",
    )
    fan.add_argument(
        "--turn", type=command.number, default=0.0, metavar="DEG", help="turn the plane so far to the right (0)"
    )
    _add_heights(fan)
    characteristic = _add(
        figures,
        _transfer,
        "transfer",
        (18, 11),
        "the transfer characteristic: at which angle each height at a distance is seen, and what is inverted, "
        "stretched or compressed",
    )
    characteristic.add_argument(
        "--at",
        type=distances,
        metavar="R1,R2,...",
        help=f"distances, m, at most {MOST_PANELS} (that of VIEW TO, or of the things behind it)",
    )
    _add_angles(characteristic, f"{transfer.ANGLES} over the picture's height")
    _add_heights(characteristic)
    return parser


Draw = Callable[["Figure"], None]
Work = Callable[[SceneIR, argparse.Namespace], tuple[Table, Draw]]


def _add(figures: Any, work: Work, name: str, size: tuple[float, float], says: str) -> argparse.ArgumentParser:
    parser: argparse.ArgumentParser = figures.add_parser(name, help=says, description=f"Draw {says}.")
    parser.set_defaults(work=work)
    command.add_scene(parser)
    parser.add_argument(
        "-o", dest="output", metavar="FIGURE", type=Path, help=f"where to draw it: {', '.join(figure.SUFFIXES)}"
    )
    parser.add_argument("--csv", metavar="FILE", help="where to write its data as a table; - is standard output")
    parser.add_argument(
        "--size",
        type=_size,
        default=size,
        metavar="WxH",
        help=f"width and height of the figure, cm ({size[0]}x{size[1]})",
    )
    return parser


def _add_angles(parser: argparse.ArgumentParser, default: str) -> None:
    parser.add_argument(
        "--angles",
        type=angles,
        metavar="FROM:TO:STEP",
        help=f"angles above the horizontal, in arcminutes ({default})",
    )


def _add_heights(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--heights", type=_heights, metavar="LOW:HIGH", help="the heights that are shown, m")


def _size(text: str) -> tuple[float, float]:
    width, _, height = text.partition("x")
    size = command.number(width), command.number(height)
    if min(size) < 2 or max(size) > 100:
        raise argparse.ArgumentTypeError("a figure is from 2 to 100 cm wide and high")
    return size


def _reach(text: str) -> float:
    reach = command.number(text)
    if reach <= 0:
        raise argparse.ArgumentTypeError("a figure must reach farther than 0 m")
    return reach


def _heights(text: str) -> tuple[float, float]:
    low, colon, high = text.partition(":")
    heights = command.number(low), command.number(high) if colon else float("nan")
    if not heights[0] < heights[1]:
        raise argparse.ArgumentTypeError(f"LOW:HIGH is expected, the lower height first, not '{text}'")
    return heights


def _run(options: argparse.Namespace) -> int:
    output: Path | None = options.output
    command.check_outputs(options.scene, [path for path in (output, options.csv) if path not in (None, "-")])
    if output is not None:
        command.check_folder(output)
        figure.check(output)
    if options.csv not in (None, "-"):
        command.check_folder(Path(options.csv))
    ir = command.load(options.scene)
    try:
        table, draw = options.work(ir, options)
    except SceneError as error:
        raise CommandError(SCENE_ERROR, f"{options.scene}: {error}") from None
    except ValueError as error:
        raise CommandError(USAGE_ERROR, str(error)) from None
    if output is not None:
        figure.save(output, options.size, draw)
    if options.csv is not None:
        _write(options.csv, table)
    return FINE


# --- the figures ----------------------------------------------------------------------------------------------------


def _profile(ir: SceneIR, options: argparse.Namespace) -> tuple[Table, Draw]:
    found = profile.temperature_profile(ir)

    def draw(paper: Figure) -> None:
        panels = list(paper.subplots(1, 3, sharey=True))
        profile.draw_profile(found, panels, options.heights)

    return profile.table(found), draw


def _rays(ir: SceneIR, options: argparse.Namespace) -> tuple[Table, Draw]:
    _check_points(0 if options.angles is None else len(options.angles) * rays.STEPS)
    found = rays.ray_fan(ir, _radians(options.angles), options.reach, options.turn)

    def draw(paper: Figure) -> None:
        panel = paper.subplots()
        rays.draw_fan(found, panel, options.heights)
        _add_legend(paper, [panel])

    return rays.table(found), draw


def _transfer(ir: SceneIR, options: argparse.Namespace) -> tuple[Table, Draw]:
    if options.at is not None and len(options.at) > MOST_PANELS and options.output is not None:
        raise CommandError(USAGE_ERROR, f"a figure has room for {MOST_PANELS} distances; --csv takes any number")
    angle_count = transfer.ANGLES if options.angles is None else len(options.angles)
    _check_points(angle_count * len(options.at or [0]))
    found = transfer.transfer_characteristic(ir, options.at, _radians(options.angles))

    def draw(paper: Figure) -> None:
        panels = list(paper.subplots(1, len(found.distances), sharey=True, squeeze=False)[0])
        for i, panel in enumerate(panels):
            transfer.draw_transfer(found, i, panel, options.heights)
            if i:
                panel.set_ylabel("")
        _add_legend(paper, panels)

    return transfer.table(found), draw


def _check_points(count: int) -> None:
    if count > MOST_POINTS:
        message = f"the data would have {count:,} points, and at most {MOST_POINTS:,} are traced: take larger steps"
        raise CommandError(USAGE_ERROR, message)


def _add_legend(paper: Figure, panels: Sequence[Axes]) -> None:
    """Below all panels, in as many columns as there is room for."""
    named: dict[str, Any] = {}
    for panel in panels:
        handles, labels = panel.get_legend_handles_labels()
        named.update(zip(labels, handles, strict=True))
    columns = max(1, int(paper.get_figwidth() * 2.54 / LEGEND_COLUMN))
    paper.legend(named.values(), named.keys(), loc="outside lower center", ncols=columns, frameon=False)


def _radians(minutes: NDArray[np.float64] | None) -> NDArray[np.float64] | None:
    return None if minutes is None else np.radians(minutes / 60)


# --- the table ------------------------------------------------------------------------------------------------------


def _write(file: str, table: Table) -> None:
    if file == "-":
        _print(table, sys.stdout)
        return
    try:
        with replacing(Path(file)) as (binary,), text_of(binary) as stream:
            _print(table, stream)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise CommandError(USAGE_ERROR, f"{file}: {command.reason(error)}") from None


def _print(table: Table, file: IO[str]) -> None:
    names, columns = table
    print(",".join(names), file=file)
    for row in zip(*(column.tolist() for column in columns), strict=True):
        print(",".join(_cell(value) for value in row), file=file)
    file.flush()


def _cell(value: float | int | str) -> str:
    """Numbers with ten digits, which is a micrometre at ten kilometres; nothing for what there is none of."""
    if isinstance(value, float):
        return "" if value != value else f"{value:.10g}"
    return str(value)


if __name__ == "__main__":
    sys.exit(main())
