"""`m3dc`: compile a scene from the shell.

Exit status 0 when all is well (warnings allowed), 1 when the scene has errors, 2 for usage and files.
"""

from __future__ import annotations

import argparse
import gc
import os
import sys
import time
from functools import partial

from . import Result, compile, report
from .dump import dump
from .levels import levels

# The IR counts the bytes of its source in 32 bits.
LARGEST_SOURCE = 2**32 - 1

_PRINT = {"json": report.print_json, "sarif": report.print_sarif}


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit status."""
    # What has been imported stays: no collection of garbage needs to look through it again.
    gc.freeze()
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
        # For each option that is added argparse makes one of these, which would ask for the terminal's width.
        formatter_class=partial(argparse.HelpFormatter, width=80),
        usage="m3dc [-o OUT.m3ir | --check | --dump[=FILE]] [options] SCENE.m3d\n       m3dc --explain CODE",
        description="Compile a Mirage3D scene to flat scene IR, or show what it compiles to.",
        epilog="Exit status: 0 fine, 1 the scene has errors, 2 usage or files.",
    )
    parser.add_argument("scene", nargs="?", metavar="SCENE.m3d", help="the scene to compile; - reads standard input")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("-o", dest="output", metavar="OUT.m3ir", help="where to write the IR (beside the scene)")
    what.add_argument("--check", action="store_true", help="only report what is wrong; write nothing")
    what.add_argument("--dump", metavar="FILE", help="print the resolved scene; with --dump=FILE, write it to FILE")
    what.add_argument("--explain", metavar="CODE", help="say what a diagnostic's code means, with an example")
    parser.add_argument(
        "--message-format",
        choices=("human", "json", "sarif"),
        default="human",
        help="diagnostics for people, on standard error; or for programs, on standard output: JSON lines, or SARIF",
    )
    parser.add_argument(
        "--max-errors",
        type=int,
        default=report.MOST_SHOWN,
        metavar="N",
        help="show at most N diagnostics (%(default)s)",
    )
    parser.add_argument("--echo", action="store_true", help="list the scene, each diagnostic under its line")
    codes = parser.add_argument_group("diagnostics by code", "CODE is a code, several with commas, or `all`")
    for option, does in (
        ("-W", "warn of a hint"),
        ("--deny", "make a warning an error"),
        ("--allow", "keep a warning back"),
    ):
        codes.add_argument(option, dest=option.strip("-"), action="append", default=[], metavar="CODE", help=does)
    parser.formatter_class = argparse.HelpFormatter
    return parser


def _run(options: argparse.Namespace) -> int:
    if options.explain:
        return _explain(options.explain)
    if options.scene is None:
        return fail("which scene? Give a .m3d file, or - for standard input; m3dc --help lists the options")
    chosen = levels(options.W, options.deny, options.allow)
    if chosen.unknown():
        return fail(f"{', '.join(chosen.unknown())} is no code of a diagnostic; docs/diagnostics.md lists them")
    name: str = options.scene
    try:
        text = _read(name)
    except OSError as error:
        return fail(f"cannot read {name}: {error.strerror or error}")
    if len(text) > LARGEST_SOURCE:
        return fail(f"{name} is {len(text) / 2**30:.1f} GiB; a scene is at most {LARGEST_SOURCE / 2**30:.0f} GiB")
    result = compile(text, name)
    shown = chosen.apply(result.diagnostics)
    if options.echo:
        report.print_echo(shown, result.source, sys.stdout)
    if options.message_format == "human":
        report.print_human(shown, result.source, sys.stderr, most=options.max_errors)
    else:
        _PRINT[options.message_format](shown[: options.max_errors], result.source, sys.stdout)
    if any(diagnostic.severity == "error" for diagnostic in shown):
        return 1
    return 0 if options.check else _write(result, options, name)


def _read(name: str) -> bytes:
    if name == "-":
        return sys.stdin.buffer.read()
    with open(name, "rb") as file:
        return file.read()


def _write(result: Result, options: argparse.Namespace, name: str) -> int:
    if options.dump == "-":
        return _print(dump(result.ir, time.ctime()))
    # Here, because a dump to the screen should not wait for them.
    from pathlib import Path

    from . import m3ir
    from .artefact import replacing

    if options.dump or options.output:
        target = Path(options.dump or options.output)
    elif name == "-":
        return fail("where should the IR of standard input go? Give -o OUT.m3ir")
    else:
        target = Path(name).with_suffix(".m3ir")
    try:
        if options.dump:
            with replacing(target) as (temporary,):
                temporary.write_text(dump(result.ir, time.ctime()), encoding="utf-8")
        else:
            m3ir.write(result.ir, target)
    except BrokenPipeError:
        raise
    except OSError as error:
        return fail(f"cannot write {target}: {error.strerror or error}; nothing was changed")
    return 0


def _print(text: str) -> int:
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        return fail(f"cannot write to standard output: {error.strerror or error}")
    return 0


def _explain(code: str) -> int:
    text = report.explain(code.upper())
    if text is None:
        return fail(f"{code} is no code of a diagnostic; docs/diagnostics.md lists them")
    sys.stdout.write(text)
    return 0


def fail(message: str) -> int:
    """Say why a command can not do its work; returns its exit status."""
    print(f"m3dc: {message}", file=sys.stderr)
    return 2
