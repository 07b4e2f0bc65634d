"""What the command lines of this package share: their options, how a scene is read and numbers are understood.

How a command ends is in `m3dc_command`, for all commands alike.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TextIO, cast

from m3dc_command import (
    EXIT_STATUS,
    FINE,
    SCENE_ERROR,
    USAGE_ERROR,
    CommandError,
    Parser,
    check_outputs,
    ended,
    read,
    reason,
    say,
    write_output,
)
from m3dc_command import parser as _parser

from m3d_render.options import OPTIONS, Option, Real, RenderOptions, Switch, Whole
from m3dc import Result
from m3dc import compile as compile_scene
from m3dc.diagnostics import report
from m3dc.diagnostics.levels import Levels
from m3dc.ir import SceneIR, m3ir

__all__ = [
    "DISTRIBUTION",
    "FINE",
    "SCENE_ERROR",
    "USAGE_ERROR",
    "CommandError",
    "add_render_options",
    "add_scene",
    "asked",
    "check_folder",
    "check_outputs",
    "compiled",
    "ended",
    "how_to_get",
    "load",
    "name",
    "number",
    "numbers",
    "parser",
    "read",
    "reason",
    "say",
    "whole",
    "write_output",
]

DISTRIBUTION = "m3d-render"


def how_to_get(extra: str) -> str:
    """Which command brings an extra, whichever way the project was installed; in quotes that every shell knows."""
    return f'uv tool install "mirage3d[{extra}]" or pip install "mirage3d[{extra}]" brings it'


def parser(program: str, description: str, *, usage: str | None = None, interrupted: str = "") -> Parser:
    """A command's options, as far as all commands have them; `interrupted` says what an interruption leaves."""
    epilog = f"{EXIT_STATUS}{interrupted and f': {interrupted}'}."
    return _parser(program, DISTRIBUTION, usage=usage, description=description, epilog=epilog)


def add_scene(parser: argparse.ArgumentParser) -> None:
    """The argument that `load` takes."""
    parser.add_argument("scene", metavar="SCENE", help="a scene, .m3d, or a compiled one, .m3ir; - reads a .m3d")


def add_render_options(parser: argparse.ArgumentParser) -> dict[str, argparse._ArgumentGroup]:  # pyright: ignore[reportPrivateUsage]
    """Adds the options that `asked` reads; returns their groups by heading."""
    titles = list(dict.fromkeys(option.group for option in OPTIONS.values()))
    groups = {title: parser.add_argument_group(title) for title in titles}
    parts = {title: group.add_mutually_exclusive_group() for title, group in groups.items()}
    for name, option in OPTIONS.items():
        _add(parts[option.group] if option.part else groups[option.group], name, option)
    return groups


def _add(group: argparse._ActionsContainer, name: str, option: Option) -> None:  # pyright: ignore[reportPrivateUsage]
    flag, kind = f"--{name.replace('_', '-')}", option.kind
    if isinstance(kind, Switch):
        group.add_argument(flag, action="store_true", default=option.default, help=option.help)
        return
    if isinstance(kind, Whole):
        parse = whole(kind.least, kind.most)
    elif isinstance(kind, Real):
        parse = number
    else:
        parse = numbers(kind.many, kind.separator, kind.metavar)
    group.add_argument(flag, type=parse, default=option.default, metavar=kind.metavar, help=option.help)


def asked(options: argparse.Namespace) -> RenderOptions:
    """What a command line with `add_render_options` asks of a picture."""
    return cast("RenderOptions", {name: getattr(options, name) for name in OPTIONS})


def load(scene: str) -> SceneIR:
    """The IR of a scene file, or of a compiled one; the errors in it go to standard error. Raises CommandError."""
    if scene.lower().endswith(".m3ir"):
        try:
            return m3ir.read(Path(scene))
        except (OSError, m3ir.FormatError) as error:
            raise CommandError(USAGE_ERROR, f"{scene}: {reason(error)}") from None
    result = compiled(scene, sys.stderr)
    if not result.ok:
        raise CommandError(SCENE_ERROR)
    return result.ir


def compiled(scene: str, to: TextIO) -> Result:
    """What comes of a scene file, or of standard input; the errors in it are written. Its warnings are not: they are
    what `m3dc` is asked for. Raises CommandError where there is nothing to read."""
    result = compile_scene(read(scene), scene)
    shown = Levels().apply(result.diagnostics)
    report.print_human([found for found in shown if found.severity == "error"], result.files, to)
    return result


def name(scene: str) -> str:
    """What to call a scene file."""
    return "standard input" if scene == "-" else report.valid(Path(scene).name)


def check_folder(output: Path) -> None:
    """Finds out before the work begins whether a file can be written at all."""
    try:
        if output.is_dir():
            raise CommandError(USAGE_ERROR, f"{output}: a folder of this name is in the way")
    except OSError as error:
        raise CommandError(USAGE_ERROR, f"{output}: {reason(error)}") from None
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
