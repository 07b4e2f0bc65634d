"""`m3dfmt`: lay out scenes from the shell.

Exit status 0 when all is well, 1 when a scene has syntax errors or, with --check or --diff, is not laid out, 2 for
usage and files.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from .artefact import replacing
from .format import FormatError, edits, format
from .format_diff import unified_diff
from .source import Source


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit status."""
    options = _parser().parse_args(arguments)
    try:
        status = max([_one(name, options) for name in options.scenes])
        sys.stdout.flush()
    except OSError as error:
        # Nothing else can be written there, not even when Python ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 2 if isinstance(error, BrokenPipeError) else _fail(f"cannot write the output: {error.strerror or error}")
    except KeyboardInterrupt:
        return 130
    return status


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="m3dfmt",
        usage="m3dfmt [--check | --diff] SCENE.m3d ...",
        description="Put Mirage3D scenes into their canonical layout. Only white space changes, never a comment, a"
        " number or what the scene means. A scene with syntax errors is left alone.",
        epilog="Exit status: 0 fine, 1 a scene has syntax errors or, with --check or --diff, is not laid out,"
        " 2 usage or files.",
    )
    parser.add_argument("scenes", nargs="+", metavar="SCENE.m3d", help="a scene; - is standard input to output")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--check", action="store_true", help="write nothing; list the scenes that would change")
    how.add_argument("--diff", action="store_true", help="write nothing; show what would change as a unified diff")
    return parser


def _one(name: str, options: argparse.Namespace) -> int:
    try:
        data = sys.stdin.buffer.read() if name == "-" else Path(name).read_bytes()
    except (OSError, ValueError) as error:
        return _fail(f"cannot read {name}: {getattr(error, 'strerror', None) or error}")
    try:
        if options.diff:
            return _show_difference(data, name)
        laid_out = format(data)
    except FormatError as error:
        print(f"{name}:{Source(data).position(error.span[0]).line}: {error.message}", file=sys.stderr)
        return 1
    if options.check:
        if laid_out != data:
            sys.stdout.buffer.write(os.fsencode(name) + b"\n")
        return int(laid_out != data)
    if name == "-":
        sys.stdout.buffer.write(laid_out)
    elif laid_out != data:
        return _replace(Path(name), laid_out)
    return 0


def _show_difference(data: bytes, name: str) -> int:
    differs = 0
    for part in unified_diff(data, edits(data), name):
        sys.stdout.buffer.write(part)
        differs = 1
    return differs


def _replace(path: Path, text: bytes) -> int:
    try:
        with replacing(path) as (temporary,):
            temporary.write_bytes(text)
    except OSError as error:
        return _fail(f"cannot write {path}: {error.strerror or error}; nothing was changed")
    return 0


def _fail(message: str) -> int:
    print(f"m3dfmt: {message}", file=sys.stderr)
    return 2
