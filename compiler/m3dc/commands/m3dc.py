"""`m3dc`: compile a scene from the shell.

Exit status 0 when all is well (warnings allowed), 1 when a scene has errors, 2 for usage and files.
"""

from __future__ import annotations

import argparse
import gc
import os
import sys
from collections.abc import Sequence

from m3dc_command import (
    FINE,
    SCENE_ERROR,
    USAGE_ERROR,
    CommandError,
    check_outputs,
    ended,
    now,
    parser,
    read,
    reason,
    say,
    write_output,
)

from .. import Diagnostic, Result, compile
from ..diagnostics import report
from ..diagnostics.levels import Levels, levels
from ..ir.dump import dump
from ..text.files import Files

# The IR counts the bytes of its source in 32 bits.
LARGEST_SOURCE = 2**32 - 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit status."""
    # What has been imported stays: no collection of garbage needs to look through it again.
    gc.freeze()
    given = sys.argv[1:] if arguments is None else arguments
    # A bare --dump means standard output; argparse would take the scene for its file.
    words = ["--dump=-" if argument == "--dump" else argument for argument in given]
    return ended("m3dc", lambda: _run(_parser().parse_args(words)))


def _parser() -> argparse.ArgumentParser:
    made = parser(
        "m3dc",
        "m3dc",
        usage="m3dc [-o OUT.m3ir | --dump[=FILE]] [options] SCENE.m3d\n"
        "       m3dc --check [options] SCENE.m3d|FOLDER ...\n"
        "       m3dc --explain CODE",
        description="Compile a Mirage3D scene to flat scene IR, or show what it compiles to.",
        epilog="Exit status: 0 fine, 1 a scene has errors, 2 usage or files, 130 interrupted.",
    )
    made.add_argument("scenes", nargs="*", metavar="SCENE.m3d", help="the scene to compile; - reads standard input")
    what = made.add_mutually_exclusive_group()
    what.add_argument(
        "-o", dest="output", metavar="OUT.m3ir", help="where to write the IR (beside the scene); - is standard output"
    )
    what.add_argument(
        "--check",
        action="store_true",
        help="only report what is wrong; write nothing. Takes several scenes, and folders with all .m3d files in them",
    )
    what.add_argument("--dump", metavar="FILE", help="print the resolved scene; with --dump=FILE, write it to FILE")
    what.add_argument("--explain", metavar="CODE", help="say what a diagnostic's code means, with an example")
    made.add_argument(
        "--message-format",
        choices=("human", "json", "sarif"),
        default="human",
        help="diagnostics for people, on standard error; or for programs, on standard output: JSON lines, or SARIF",
    )
    made.add_argument(
        "--max-errors",
        type=_count,
        default=report.MOST_SHOWN,
        metavar="N",
        help="show at most N diagnostics of a scene (%(default)s)",
    )
    made.add_argument("--echo", action="store_true", help="list the scene, each diagnostic under its line")
    codes = made.add_argument_group("diagnostics by code", "CODE is a code, several with commas, or `all`")
    for option, does in (
        ("-W", "warn of a hint"),
        ("--deny", "make a warning an error"),
        ("--allow", "keep a warning back"),
    ):
        codes.add_argument(option, dest=option.strip("-"), action="append", default=[], metavar="CODE", help=does)
    return made


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"a whole number from 0 is expected, not '{text}'")
    return int(text)


def _run(options: argparse.Namespace) -> int:
    if options.explain:
        return _explain(options.explain)
    given: list[str] = options.scenes
    if not given:
        raise _usage("which scene? Give a .m3d file, or - for standard input; m3dc --help lists the options")
    chosen = levels(options.W, options.deny, options.allow)
    if chosen.unknown():
        raise _usage(f"{', '.join(chosen.unknown())} is no code of a diagnostic; docs/diagnostics.md lists them")
    if options.check:
        return _check(given, options, chosen)
    if len(given) > 1:
        raise _usage("one scene at a time is compiled; --check takes several")
    (name,) = given
    _check_target(name, options)
    result, shown = _compile(name, options, chosen)
    if options.message_format != "human":
        _print_for_programs([(shown, result.files)], options)
    if _has_errors(shown):
        return SCENE_ERROR
    _write(result, options, name)
    return FINE


def _check(given: list[str], options: argparse.Namespace, chosen: Levels) -> int:
    """Reports on all scenes; returns the worst exit status."""
    status = FINE
    found: list[tuple[Sequence[Diagnostic], Files]] = []
    unread = 0
    names = scenes_of(given)
    for name in names:
        try:
            result, shown = _compile(name, options, chosen)
        except CommandError as error:
            say(f"m3dc: error: {error}")
            unread, status = unread + 1, USAGE_ERROR
            continue
        found.append((shown, result.files))
        status = max(status, SCENE_ERROR if _has_errors(shown) else FINE)
    if options.message_format != "human":
        _print_for_programs(found, options)
    elif len(names) > 1:
        print(report.summary_of_scenes([shown for shown, _ in found], unread), file=sys.stderr)
    return status


def scenes_of(given: Sequence[str]) -> list[str]:
    """The names given, each folder replaced by the names of all .m3d files in it and its folders, but for hidden ones.

    Raises CommandError where a folder can not be read or holds none.
    """
    found: list[str] = []
    for name in given:
        found += _scenes_in(name) if name != "-" and os.path.isdir(name) else [name]
    return list(dict.fromkeys(found))


def _scenes_in(folder: str) -> list[str]:
    def refuse(error: OSError) -> None:
        raise _usage(f"cannot read {error.filename}: {reason(error)}")

    found: list[str] = []
    for path, folders, files in os.walk(folder, onerror=refuse):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        found += [os.path.join(path, name) for name in sorted(files) if name.lower().endswith(".m3d")]
    if not found:
        raise _usage(f"{folder}: there is no .m3d file in this folder")
    return found


def _compile(name: str, options: argparse.Namespace, chosen: Levels) -> tuple[Result, list[Diagnostic]]:
    """What comes of a scene, and what is to be said of it, which is said already where people read it."""
    text = read(name)
    if len(text) > LARGEST_SOURCE:
        raise _usage(f"{name} is {len(text) / 2**30:.1f} GiB; a scene is at most {LARGEST_SOURCE / 2**30:.0f} GiB")
    result = compile(text, name)
    shown = chosen.apply(result.diagnostics)
    if options.echo:
        report.print_echo(shown, result.source, sys.stdout)
    if options.message_format == "human":
        report.print_human(shown, result.files, sys.stderr, most=options.max_errors)
    return result, shown


def _print_for_programs(found: report.Found, options: argparse.Namespace) -> None:
    text = report.FOR_PROGRAMS[options.message_format]([(shown[: options.max_errors], files) for shown, files in found])
    write_output(text.encode())


def _has_errors(diagnostics: Sequence[Diagnostic]) -> bool:
    return any(diagnostic.severity == "error" for diagnostic in diagnostics)


def _target(name: str, options: argparse.Namespace) -> str:
    """Where the result goes; - is standard output."""
    if options.dump or options.output:
        return options.dump or options.output
    if name == "-":
        raise _usage("where should the IR of standard input go? Give -o OUT.m3ir")
    return os.path.splitext(name)[0] + ".m3ir"


def _check_target(name: str, options: argparse.Namespace) -> None:
    target = _target(name, options)
    if target != "-":
        check_outputs(name, [target])


def _write(result: Result, options: argparse.Namespace, name: str) -> None:
    target = _target(name, options)
    text = report.valid(dump(result.ir, now())).encode() if options.dump else b""
    if options.dump == "-":
        write_output(text)
        return
    # Here, because a dump to the screen should not wait for them.
    import io
    from pathlib import Path

    from ..files.artefact import write_file
    from ..ir import m3ir

    if target == "-":
        buffer = io.BytesIO()
        m3ir.write_to(result.ir, buffer)
        write_output(buffer.getvalue())
        return
    try:
        if options.dump:
            write_file(Path(target), text)
        else:
            m3ir.write(result.ir, Path(target))
    except BrokenPipeError:
        raise
    except (OSError, ValueError) as error:
        raise _usage(f"cannot write {target}: {reason(error)}; nothing was changed") from None


def _explain(code: str) -> int:
    text = report.explain(code.upper())
    if text is None:
        raise _usage(f"{code} is no code of a diagnostic; docs/diagnostics.md lists them")
    sys.stdout.write(text)
    return FINE


def _usage(message: str) -> CommandError:
    return CommandError(USAGE_ERROR, message)
