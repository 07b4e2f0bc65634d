"""The `m3d-render` command: a scene in, a picture out.

Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path

from m3d_render import _kernel
from m3d_render.picture import SUFFIXES, PictureError, check_suffix, plane_paths, write_picture
from m3d_render.progress import ProgressLine
from m3d_render.rendering import LARGEST_SIDE, Rendering, SceneError, missing_textures, prepare
from m3dc import compile as compile_scene
from m3dc import m3ir, report
from m3dc.ir import SceneIR

FINE, SCENE_ERROR, USAGE_ERROR, INTERRUPTED = 0, 1, 2, 130


class _CommandError(Exception):
    """Ends the command with a status and, unless it has been said already, a message."""

    def __init__(self, status: int, message: str = "") -> None:
        super().__init__(message)
        self.status = status


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    options = _parser().parse_args(arguments)
    try:
        _run(options)
    except _CommandError as failure:
        if str(failure):
            _say(f"error: {failure}")
        return failure.status
    except KeyboardInterrupt:
        _say("interrupted: no picture was written")
        return INTERRUPTED
    except MemoryError:
        _say("error: the scene or its picture does not fit in memory; a smaller --width and --height may")
        return USAGE_ERROR
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return USAGE_ERROR
    return FINE


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="m3d-render",
        description="Render a scene to a picture; rays follow the scene's MIRAGE unless --straight.",
        epilog="Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.",
    )
    parser.add_argument("scene", metavar="SCENE", help="a scene, .m3d, or a compiled one, .m3ir")
    parser.add_argument(
        "-o", dest="output", metavar="PICTURE", required=True, type=Path,
        help=f"where to write the picture; its suffix names the format: {', '.join(SUFFIXES)}",
    )  # fmt: skip
    parser.add_argument("--straight", action="store_true", help="straight rays, whatever MIRAGE says")
    side = _whole(1, LARGEST_SIDE)
    parser.add_argument("--width", type=side, metavar="N", help="pixels in a row, instead of the scene's")
    parser.add_argument("--height", type=side, metavar="N", help="pixels in a column, instead of the scene's")
    parser.add_argument("--threads", type=_whole(1, 4096), metavar="N", help="threads; all processors if not given")
    parser.add_argument(
        "--shadows", action="store_true", default=None, help="cast shadows, even if the scene does not say so"
    )
    parser.add_argument(
        "--depth", type=_whole(1, 1_000_000_000), metavar="N", help="level of the last mirror ray; the eye ray is 1"
    )
    parser.add_argument("--log-scale", type=_number, metavar="S", help="LOGSCALE, instead of the scene's; above 1")
    parser.add_argument(
        "--stats", action="store_true", help="print a JSON object: seconds, rays of each kind, arcs, peak memory"
    )
    parser.add_argument("--version", action="version", version=f"m3d-render {_kernel.VERSION}")
    return parser


def _whole(least: int, most: int) -> Callable[[str], int]:
    def parse(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"a whole number is expected, not '{text}'") from None
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"{value} is not from {least} to {most}")
        return value

    return parse


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"a number is expected, not '{text}'")
    return value


def _run(options: argparse.Namespace) -> None:
    output: Path = options.output
    _check_output(output)
    started = time.perf_counter()
    ir = _load(options.scene)
    load = time.perf_counter() - started
    missing = missing_textures(ir)
    if missing:
        names, them = ", ".join(missing), "it" if len(missing) == 1 else "them"
        _say(f"warning: this version does not have the texture {names}: rendering without {them}")
    rendering = _render(ir, options)
    started = time.perf_counter()
    metadata = {"Software": f"m3d-render {_kernel.VERSION}", "ImageDescription": _name(options.scene)}
    try:
        write_picture(output, rendering.picture, metadata)
    except PictureError as error:
        raise _CommandError(USAGE_ERROR, str(error)) from None
    if options.stats:
        seconds = {
            "load": load,
            "build": rendering.build,
            "trace": rendering.trace,
            "write": time.perf_counter() - started,
        }
        print(json.dumps(_stats(rendering, seconds)), flush=True)


def _render(ir: SceneIR, options: argparse.Namespace) -> Rendering:
    progress = ProgressLine(sys.stderr) if sys.stderr.isatty() else None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)
            scene = prepare(ir)
        return scene.render(
            width=options.width,
            height=options.height,
            straight=options.straight,
            shadows=options.shadows,
            depth=options.depth,
            log_scale=options.log_scale,
            threads=options.threads,
            progress=progress,
        )
    except SceneError as error:
        raise _CommandError(SCENE_ERROR, f"{options.scene}: {error}") from None
    finally:
        if progress is not None:
            progress.clear()


def _check_output(output: Path) -> None:
    """Finds out before the work begins what would spoil its end."""
    try:
        check_suffix(output)
    except PictureError as error:
        raise _CommandError(USAGE_ERROR, str(error)) from None
    folder = output.parent
    if not folder.is_dir():
        what = "is not a folder" if folder.exists() else "does not exist"
        raise _CommandError(USAGE_ERROR, f"{output}: the folder {folder} {what}; make it first, or choose another")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise _CommandError(USAGE_ERROR, f"{output}: the folder {folder} does not allow writing")
    for path in plane_paths(output) if output.suffix.lower() == ".raw" else [output]:
        if path.is_dir():
            raise _CommandError(USAGE_ERROR, f"{path}: a folder of this name is in the way of the picture")


def _load(scene: str) -> SceneIR:
    if scene.lower().endswith(".m3ir"):
        try:
            return m3ir.read(Path(scene))
        except OSError as error:
            raise _CommandError(USAGE_ERROR, f"{scene}: {error.strerror or error}") from None
        except m3ir.FormatError as error:
            raise _CommandError(USAGE_ERROR, f"{scene}: {error}") from None
    try:
        source = sys.stdin.buffer.read() if scene == "-" else Path(scene).read_bytes()
    except OSError as error:
        raise _CommandError(USAGE_ERROR, f"{scene}: {error.strerror or error}") from None
    result = compile_scene(source, scene)
    report.print_human(result.diagnostics, result.source, sys.stderr)
    if not result.ok:
        raise _CommandError(SCENE_ERROR)
    return result.ir


def _name(scene: str) -> str:
    return "standard input" if scene == "-" else Path(scene).name


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


def _say(message: str) -> None:
    print(f"m3d-render: {message}", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
