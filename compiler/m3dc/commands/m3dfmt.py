"""`m3dfmt`: lay out scenes from the shell.

Exit status 0 when all is well, 1 when a scene has syntax errors or, with --check or --diff, is not laid out, 2 for
usage and files.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from m3dc_command import USAGE_ERROR, CommandError, ended, parser, read, reason, say, write_output

from ..files.artefact import write_file
from ..format import FormatError, edits, format
from ..format.diff import unified_diff
from ..text.source import Source


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit status."""
    return ended("m3dfmt", lambda: _run(_parser().parse_args(arguments)))


def _parser() -> argparse.ArgumentParser:
    made = parser(
        "m3dfmt",
        "m3dc",
        usage="m3dfmt [--check | --diff] SCENE.m3d ...",
        description="Put Mirage3D scenes into their canonical layout. Only white space changes, never a comment, a"
        " number or what the scene means. A scene with syntax errors is left alone.",
        epilog="Exit status: 0 fine, 1 a scene has syntax errors or, with --check or --diff, is not laid out,"
        " 2 usage or files, 130 interrupted.",
    )
    made.add_argument("scenes", nargs="+", metavar="SCENE.m3d", help="a scene; - is standard input to output")
    how = made.add_mutually_exclusive_group()
    how.add_argument("--check", action="store_true", help="write nothing; list the scenes that would change")
    how.add_argument("--diff", action="store_true", help="write nothing; show what would change as a unified diff")
    return made


def _run(options: argparse.Namespace) -> int:
    status = 0
    for name in options.scenes:
        try:
            status = max(status, _one(name, options))
        except CommandError as error:
            say(f"m3dfmt: error: {error}")
            status = max(status, error.status)
    return status


def _one(name: str, options: argparse.Namespace) -> int:
    data = read(name)
    try:
        if options.diff:
            return _show_difference(data, name)
        laid_out = format(data)
    except FormatError as error:
        print(f"{name}:{Source(data).position(error.span[0]).line}: {error.message}", file=sys.stderr)
        return 1
    if options.check:
        if laid_out != data:
            write_output(os.fsencode(name) + b"\n")
        return int(laid_out != data)
    if name == "-":
        write_output(laid_out)
    elif laid_out != data:
        _replace(Path(name), laid_out)
    return 0


def _show_difference(data: bytes, name: str) -> int:
    differs = 0
    for part in unified_diff(data, edits(data), name):
        sys.stdout.buffer.write(part)
        differs = 1
    return differs


def _replace(path: Path, text: bytes) -> None:
    try:
        write_file(path, text)
    except OSError as error:
        raise CommandError(USAGE_ERROR, f"cannot write {path}: {reason(error)}; nothing was changed") from None
