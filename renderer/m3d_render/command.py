"""What the command lines share: how a scene is read, numbers understood, and a command ended.

Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

from m3d_render import _kernel
from m3dc import Result, m3ir, report
from m3dc import compile as compile_scene
from m3dc.ir import SceneIR
from m3dc.levels import Levels

FINE, SCENE_ERROR, USAGE_ERROR, INTERRUPTED = 0, 1, 2, 130


_EXIT_STATUS = "Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted"


def parser(
    program: str, description: str, *, usage: str | None = None, interrupted: str = ""
) -> argparse.ArgumentParser:
    """A command's options, as far as all commands have them; `interrupted` says what an interruption leaves."""
    epilog = f"{_EXIT_STATUS}{interrupted and f': {interrupted}'}."
    made = argparse.ArgumentParser(prog=program, usage=usage, description=description, epilog=epilog)
    made.add_argument("--version", action="version", version=f"{program} {_kernel.VERSION}")
    return made


def add_scene(parser: argparse.ArgumentParser) -> None:
    """The argument that `load` takes."""
    parser.add_argument("scene", metavar="SCENE", help="a scene, .m3d, or a compiled one, .m3ir; - reads a .m3d")


class CommandError(Exception):
    """Ends the command with a status and, unless it has been said already, a message."""

    def __init__(self, status: int, message: str = "") -> None:
        super().__init__(message)
        self.status = status


def ended(program: str, action: Callable[[], int]) -> int:
    """The exit status of a command, its failures explained."""

    def say(message: str) -> None:
        print(f"{program}: {message}", file=sys.stderr)

    try:
        return action()
    except CommandError as failure:
        if str(failure):
            say(str(failure) if failure.status == INTERRUPTED else f"error: {failure}")
        return failure.status
    except KeyboardInterrupt:
        say("interrupted: nothing was written")
        return INTERRUPTED
    except MemoryError:
        say("error: this does not fit in memory; a picture of a smaller --width and --height may")
        return USAGE_ERROR
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return USAGE_ERROR


def load(scene: str) -> SceneIR:
    """The IR of a scene file, or of a compiled one; what is wrong with it goes to standard error."""
    if scene.lower().endswith(".m3ir"):
        try:
            return m3ir.read(Path(scene))
        except OSError as error:
            raise CommandError(USAGE_ERROR, f"{scene}: {error.strerror or error}") from None
        except m3ir.FormatError as error:
            raise CommandError(USAGE_ERROR, f"{scene}: {error}") from None
    result = compiled(scene, sys.stderr)
    if not result.ok:
        raise CommandError(SCENE_ERROR)
    return result.ir


def compiled(scene: str, to: TextIO) -> Result:
    """What comes of a scene file, or of standard input; what is wrong with it is written. Raises CommandError where
    there is nothing to read."""
    result = compile_scene(read(scene), scene)
    report.print_human(Levels().apply(result.diagnostics), result.source, to)
    return result


def read(scene: str) -> bytes:
    """The text of a scene file; of standard input if it is called -."""
    try:
        return sys.stdin.buffer.read() if scene == "-" else Path(scene).read_bytes()
    except OSError as error:
        raise CommandError(USAGE_ERROR, f"{scene}: {error.strerror or error}") from None


def name(scene: str) -> str:
    """What to call a scene file."""
    return "standard input" if scene == "-" else Path(scene).name


def check_folder(output: Path) -> None:
    """Finds out before the work begins whether a file can be written at all."""
    folder = output.parent
    if not folder.is_dir():
        what = "is not a folder" if folder.exists() else "does not exist"
        raise CommandError(USAGE_ERROR, f"{output}: the folder {folder} {what}; make it first, or choose another")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise CommandError(USAGE_ERROR, f"{output}: the folder {folder} does not allow writing")


def whole(least: int, most: int) -> Callable[[str], int]:
    """For argparse: a whole number within bounds."""

    def parse(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"a whole number is expected, not '{text}'") from None
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"{value} is not from {least} to {most}")
        return value

    return parse


def number(text: str) -> float:
    """For argparse: a finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"a number is expected, not '{text}'")
    return value


def numbers(count: int, separator: str, shape: str) -> Callable[[str], tuple[int, ...]]:
    """For argparse: so many whole numbers, not below 0, with a separator between them."""

    def parse(text: str) -> tuple[int, ...]:
        try:
            values = tuple(int(part) for part in text.split(separator))
        except ValueError:
            values = ()
        if len(values) != count or min(values) < 0:
            raise argparse.ArgumentTypeError(f"{shape} is expected, whole numbers from 0, not '{text}'")
        return values

    return parse
