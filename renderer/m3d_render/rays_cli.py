"""The `m3d-rays` command: a scene in, the paths of rays through its air out, as a table.

Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from m3d_render import command
from m3d_render.command import FINE, SCENE_ERROR, USAGE_ERROR, CommandError
from m3d_render.optics import Air
from m3d_render.ray_options import angles, distances
from m3d_render.rendering import SceneError
from m3dc.files.artefact import replacing, text_of
from m3dc.ir import SceneIR

HEADING = "angle_arcmin,r_m,z_m,end"
_BATCH = 1024


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return command.ended("m3d-rays", lambda: _run(_parser().parse_args(arguments)))


def _parser() -> argparse.ArgumentParser:
    parser = command.parser(
        "m3d-rays",
        "Trace rays from a scene's observer through its MIRAGE, without a picture. The table has a row "
        "for each crossing of a layer of the air, or for each distance of --at; a ray's last row says in the column "
        "`end` why it ended: ground, top, range or segments.",
    )
    command.add_scene(parser)
    parser.add_argument(
        "--angles",
        required=True,
        type=angles,
        metavar="FROM:TO:STEP",
        help="angles above the horizontal, in arcminutes",
    )
    parser.add_argument(
        "--at", type=distances, metavar="R1,R2,...", help="horizontal distances, m, instead of every crossing"
    )
    parser.add_argument("--csv", default="-", metavar="FILE", help="where to write the table; - is standard output")
    return parser


def _run(options: argparse.Namespace) -> int:
    to_screen = options.csv == "-"
    if not to_screen:
        command.check_outputs(options.scene, [options.csv])
        command.check_folder(Path(options.csv))
    ir = command.load(options.scene)
    if ir.scene.mirage is None:
        raise CommandError(SCENE_ERROR, f"{options.scene}: the scene has no MIRAGE, so its rays are straight")
    lines = _lines(ir, options.angles, options.at)
    try:
        if to_screen:
            _print(lines, sys.stdout)
        else:
            with replacing(Path(options.csv)) as (binary,), text_of(binary) as file:
                _print(lines, file)
    except SceneError as error:
        raise CommandError(SCENE_ERROR, f"{options.scene}: {error}") from None
    except BrokenPipeError:
        raise
    except OSError as error:
        raise CommandError(USAGE_ERROR, f"{options.csv}: {command.reason(error)}") from None
    return FINE


def _print(lines: Iterator[str], file: IO[str]) -> None:
    # The first ray is traced before anything is written: most of what can go wrong goes wrong there.
    first = next(lines)
    print(HEADING, file=file)
    print(first, file=file)
    for line in lines:
        print(line, file=file)
    file.flush()


def _lines(ir: SceneIR, all_angles: NDArray[np.float64], at: list[float] | None) -> Iterator[str]:
    air = Air(ir)
    for first in range(0, len(all_angles), _BATCH):
        batch = all_angles[first : first + _BATCH]
        paths = air.paths(np.radians(batch / 60), at=at)
        for i, angle in enumerate(batch):
            end = _row(angle, paths.end_points[i], paths.ends[i])
            if at is None:
                crossings = air.crossings(math.radians(angle / 60))
                yield from (_row(angle, crossing, "") for crossing in crossings[:-1])
                yield end
                continue
            reached = ~np.isnan(paths.heights[i])
            points = np.column_stack([paths.at, paths.heights[i]])[reached]
            yield from (_row(angle, point, "") for point in points)
            if not reached.all():
                yield end


def _row(angle: float, point: Sequence[float] | NDArray[np.float64], end: str) -> str:
    return f"{angle:.10g},{point[0]:.6f},{point[1]:.6f},{end}"


if __name__ == "__main__":
    sys.exit(main())
