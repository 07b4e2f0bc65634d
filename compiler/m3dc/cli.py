"""`m3dc`: compile a scene from the shell.

Exit status 0 when all is well (warnings allowed), 1 when the scene has errors, 2 for usage and files.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path

from . import compile
from .artefact import replacing
from .dump import dump
from .report import print_human, print_json


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit status."""
    given = sys.argv[1:] if arguments is None else arguments
    # A bare --dump means standard output; argparse would take the scene for its file.
    options = _parser().parse_args(["--dump=-" if argument == "--dump" else argument for argument in given])
    try:
        return _run(options)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 2
    except KeyboardInterrupt:
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="m3dc",
        usage="m3dc [-o OUT.m3ir | --check | --dump[=FILE]] [--message-format human|json] SCENE.m3d",
        description="Compile a Mirage3D scene to flat scene IR, or show what it compiles to.",
        epilog="Exit status: 0 fine, 1 the scene has errors, 2 usage or files.",
    )
    parser.add_argument("scene", metavar="SCENE.m3d", help="the scene to compile; - reads standard input")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("-o", dest="output", metavar="OUT.m3ir", help="where to write the IR (beside the scene)")
    what.add_argument("--check", action="store_true", help="only report what is wrong; write nothing")
    what.add_argument("--dump", metavar="FILE", help="print the resolved scene; with --dump=FILE, write it to FILE")
    parser.add_argument(
        "--message-format",
        choices=("human", "json"),
        default="human",
        help="how diagnostics are shown: for people on standard error, or one JSON object a line on standard output",
    )
    return parser


def _run(options: argparse.Namespace) -> int:
    name: str = options.scene
    try:
        text = sys.stdin.buffer.read() if name == "-" else Path(name).read_bytes()
    except OSError as error:
        return fail(f"cannot read {name}: {error.strerror or error}")
    result = compile(text, name)
    if options.message_format == "json":
        print_json(result.diagnostics, result.source, sys.stdout)
    else:
        print_human(result.diagnostics, result.source, sys.stderr)
    if not result.ok:
        return 1
    if options.check:
        return 0
    target = options.dump or options.output or _beside(name)
    try:
        if options.dump == "-":
            sys.stdout.write(dump(result.ir, time.ctime()))
            sys.stdout.flush()
        elif options.dump:
            with replacing(Path(options.dump)) as (temporary,):
                temporary.write_text(dump(result.ir, time.ctime()), encoding="utf-8")
        elif target is None:
            return fail("where should the IR of standard input go? Give -o OUT.m3ir")
        else:
            from . import m3ir

            m3ir.write(result.ir, Path(target))
    except BrokenPipeError:
        raise
    except OSError as error:
        return fail(f"cannot write {target}: {error.strerror or error}; nothing was changed")
    return 0


def _beside(scene: str) -> str | None:
    return None if scene == "-" else str(Path(scene).with_suffix(".m3ir"))


def fail(message: str) -> int:
    """Say why a command can not do its work; returns its exit status."""
    print(f"m3dc: {message}", file=sys.stderr)
    return 2
