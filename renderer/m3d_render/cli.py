"""The `m3d-render` command: a scene in, a picture out.

Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence

from m3d_render import command, destination, wireframe_cli
from m3d_render.command import FINE, SCENE_ERROR, USAGE_ERROR, CommandError
from m3d_render.destination import Destination
from m3d_render.formats import BY_SUFFIX, SUFFIXES, with_layers
from m3d_render.metadata import metadata
from m3d_render.options import BEYOND, WORK
from m3d_render.picture import PictureError, encoded, write_picture
from m3d_render.progress import ProgressLine
from m3d_render.rendering import LAYERS, Cancelled, Rendering, SceneError, prepare
from m3dc import compile as compile_scene
from m3dc.diagnostics import catalogue, report
from m3dc.files.interrupt import Interrupt
from m3dc.ir import SceneIR


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return command.ended("m3d-render", lambda: _main(arguments))


def _main(arguments: Sequence[str] | None) -> int:
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.check_normals:
        return _check_normals(options.scene)
    if options.output is None:
        parser.error("where should the picture go? Give -o PICTURE, or -o - for standard output")
    wireframe_cli.check_options(parser, options)
    if options.wireframe:
        return wireframe_cli.run(options)
    return _run(options)


def _parser() -> argparse.ArgumentParser:
    parser = command.parser(
        "m3d-render",
        usage="m3d-render SCENE -o PICTURE [options]\n       m3d-render SCENE -o PICTURE --wireframe [options]\n"
        "       m3d-render SCENE.m3d --check-normals",
        description="Render a scene to a picture; rays follow the scene's MIRAGE unless --straight.",
        interrupted="the finished rows are written",
    )
    command.add_scene(parser)
    destination.add_options(parser, SUFFIXES, ", and .svg for a wireframe")
    parser.add_argument(
        "--check-normals",
        action="store_true",
        help="render nothing: report facets whose normals point to the wrong side",
    )
    groups = command.add_render_options(parser)
    groups[BEYOND].add_argument(
        "--aov",
        type=_layers,
        default=(),
        metavar="NAME,...",
        help=f"extra channels in an {with_layers()}: {', '.join(LAYERS)}; or all",
    )
    groups[WORK].add_argument(
        "--stats", action="store_true", help="print a JSON object: seconds, rays of each kind, arcs, peak memory"
    )
    wireframe_cli.add_options(parser)
    return parser


def _layers(text: str) -> tuple[str, ...]:
    if text == "all":
        return tuple(LAYERS)
    names = tuple(text.split(","))
    unknown = [name for name in names if name not in LAYERS]
    if unknown:
        raise argparse.ArgumentTypeError(f"'{unknown[0]}' is none of {', '.join(LAYERS)}")
    return names


def _check_normals(scene: str) -> int:
    if scene.lower().endswith(".m3ir"):
        raise CommandError(USAGE_ERROR, f"{scene}: normals are checked in the scene's text; give the .m3d")
    result = compile_scene(command.read(scene), scene)
    wrong = catalogue.NORMAL_ON_WRONG_SIDE.code
    shown = [found for found in result.diagnostics if found.code == wrong or found.severity == "error"]
    report.print_human(shown, result.files, sys.stderr)
    return SCENE_ERROR if shown else FINE


def _run(options: argparse.Namespace) -> int:
    to = destination.destination(options, SUFFIXES)
    if options.aov and not BY_SUFFIX[to.suffix].layers:
        raise CommandError(USAGE_ERROR, f"{to.name}: only an {with_layers()} can hold what --aov asks for")
    if options.stats and to.path is None:
        raise CommandError(USAGE_ERROR, "--stats and the picture can not both go to standard output; give -o PICTURE")
    started = time.perf_counter()
    ir = command.load(options.scene)
    load = time.perf_counter() - started
    rendering, interrupted = _render(ir, options)
    started = time.perf_counter()
    if rendering.picture.size:
        _write(to, ir, rendering, options)
    if interrupted:
        raise CommandError(128 + interrupted, _interrupted(to, rendering))
    if options.stats:
        seconds = {
            "load": load,
            "build": rendering.build,
            "trace": rendering.trace,
            "write": time.perf_counter() - started,
        }
        print(json.dumps(_stats(rendering, seconds)), flush=True)
    return FINE


def _render(ir: SceneIR, options: argparse.Namespace) -> tuple[Rendering, int]:
    """What was rendered, and the signal that ended it before it was all that was asked for, or 0."""
    progress = ProgressLine(sys.stderr) if sys.stderr.isatty() else None
    interrupt = Interrupt()
    try:
        scene = prepare(ir)
        with interrupt:
            rendering = scene.render(
                aov=options.aov,
                **(command.asked(options) | {"progress": progress, "cancel": interrupt.asked}),
            )
        return rendering, 0
    except Cancelled as cancelled:
        return cancelled.rendering, interrupt.number
    except SceneError as error:
        asked = options.region is not None or options.rows is not None
        status = USAGE_ERROR if asked and "lie" in str(error) else SCENE_ERROR
        raise CommandError(status, f"{options.scene}: {error}") from None
    finally:
        if progress is not None:
            progress.clear()


def _write(to: Destination, ir: SceneIR, rendering: Rendering, options: argparse.Namespace) -> None:
    described = metadata(ir, rendering, command.name(options.scene))
    origin = (rendering.region.left, rendering.region.top)
    whole = (rendering.width, rendering.height)
    picture, layers = rendering.picture, rendering.layers
    try:
        if to.path is None:
            command.write_output(encoded(to.suffix, picture, described, layers=layers, origin=origin, whole=whole))
        else:
            write_picture(to.path, picture, described, layers=layers, origin=origin, whole=whole, suffix=to.suffix)
    except PictureError as error:
        raise CommandError(USAGE_ERROR, str(error)) from None


def _interrupted(to: Destination, rendering: Rendering) -> str:
    part = rendering.region
    if not rendering.picture.size:
        return "interrupted: no row was finished, and no picture written"
    return (
        f"interrupted: {to.name} holds rows {part.top} to {part.bottom}; "
        f"rows from {part.bottom + 1} on are not rendered (--rows, --region)"
    )


def _stats(rendering: Rendering, seconds: dict[str, float]) -> dict[str, object]:
    rows, columns, _ = rendering.picture.shape
    rays = rendering.rays
    return {
        "seconds": {stage: round(value, 6) for stage, value in seconds.items()},
        "rays": {
            "eye": rays.eye,
            "mirage": rays.mirage,
            "reflected": rays.reflected,
            "shadow": rays.shadow,
            "ambient": rays.ambient,
        },
        "arcs": rays.arcs,
        "peak_memory": _peak_memory(),
        "width": columns,
        "height": rows,
        "threads": rendering.threads,
    }


def _peak_memory() -> int | None:
    """Bytes that the process has had in memory at most, where the system says."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else 1024 * peak


if __name__ == "__main__":
    sys.exit(main())
