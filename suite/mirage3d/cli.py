"""The command line of 1993: `mirage3d datafile -w640 -h400 -S ...`. Thesis 7.2 and 7.3.

A thin layer on the same compiler and renderer: options in any order, no space before a value, and the messages of
Appendix B. Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import numpy as np
from m3dc_command import Terminated, now, say
from numpy.typing import NDArray

import m3dc
from m3d_render import command, wireframe
from m3d_render.command import FINE, SCENE_ERROR, USAGE_ERROR
from m3d_render.options import OPTIONS, RenderOptions
from m3d_render.picture import to_bytes
from m3d_render.rendering import Cancelled, SceneError, prepare
from m3dc.diagnostics import catalogue, report
from m3dc.diagnostics.levels import Levels
from m3dc.files.artefact import replacing, write_file
from m3dc.files.interrupt import Interrupt
from m3dc.ir.dump import dump
from mirage3d.versions import versions

LISTING = """\
usage: mirage3d datafile [-command ...]

Render a scene to three files, one a colour: a byte a pixel, row by row from the top.

  -r"filename"  Red output image file (red.raw)
  -g"filename"  Green output image file (green.raw)
  -b"filename"  Blue output image file (blue.raw)
  -D            Debug, dump processed input to stdout (No)
  -D"filename"  Debug, dump processed input to "filename"
  -E            Echo input file while parsed (No)
  -x"filename"  Scale image using filename as a temporary buffer (No)
  -w#           Image width 0 <= # < 1024 (320)
  -h#           Image height 0 <= # < 1024 (200)
  -s#           Starting image row 0 <= # < 1024 (0)
  -e#           Ending image row 0 <= # < 1024 (200)
  -d#           Maximum recursion depth # > 0 (2)
  -l#           Log scale # > 1.0 (0.0)
  -S            Enable shadow detection (No)
  -N            Check the orientation of polygon normals (No)
  -W            Wireframe display (No)
  --help        Show this list
  --version     Show the versions of everything that is installed

There is no space between a command and its value. Commands take precedence over the data file.
m3dc and m3d-render do all of this and more.
Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted.
"""

LARGEST = 1024

# What kind of error a code was in 1993 (thesis 7.3): by its hundreds, but for the unrecoverable ones.
_KINDS = {"M3D01": "Syntax", "M3D02": "Syntax", "M3D03": "Syntax", "M3D04": "Data", "M3D05": "Data"}
_UNRECOVERABLE = {
    entry.code
    for entry in (
        catalogue.EMPTY_FILE,
        catalogue.NOT_A_TEXT_FILE,
        catalogue.NO_PRIMITIVES,
        catalogue.TOO_MANY_TRANSFORMATIONS,
        catalogue.EYE_BELOW_PROFILE,
        catalogue.EYE_ABOVE_PROFILE,
    )
}


class UnrecoverableError(Exception):
    """Ends the command with a message of the thesis's Appendix B."""


@dataclass
class Options:
    """What the command line says; None where it says nothing."""

    datafile: str | None = None
    red: str = "red.raw"
    green: str = "green.raw"
    blue: str = "blue.raw"
    dump: str | None = None  # a file's name, or "" for standard output
    echo: bool = False
    buffer: str | None = None
    start: int | None = None
    end: int | None = None
    render: RenderOptions = field(default_factory=RenderOptions)
    check_normals: bool = False
    wireframe: bool = False
    unknown: list[str] = field(default_factory=list[str])


Setter = Callable[[Options, str], None]


def _file(name: str, command: str) -> Setter:
    def set_file(options: Options, value: str) -> None:
        if not value:
            raise UnrecoverableError(f"Missing file name for {command} command")
        setattr(options, name, value)

    return set_file


def _number(name: str, command: str, what: str, low: float, high: float, kind: type[int] | type[float]) -> Setter:
    """A number with low < number < high, kept under its name."""

    def set_number(options: Options, value: str) -> None:
        if not value:
            raise UnrecoverableError(f"Missing argument for {command} command")
        try:
            number = kind(value)
        except ValueError:
            number = None
        if number is None or not low < number < high:
            raise UnrecoverableError(f"Invalid {what} specified for {command} command")
        _set(options, name, number)

    return set_number


def _flag(name: str) -> Setter:
    def set_flag(options: Options, value: str) -> None:
        if value:
            options.unknown.append(value)
        _set(options, name, True)

    return set_flag


def _set(options: Options, name: str, value: Any) -> None:
    """Keeps a value under its name, with the render options if it is one of those."""
    if name in OPTIONS:
        options.render |= cast("RenderOptions", {name: value})
    else:
        setattr(options, name, value)


def _set_dump(options: Options, value: str) -> None:
    options.dump = value


COMMANDS: dict[str, Setter] = {
    "r": _file("red", "-r"),
    "g": _file("green", "-g"),
    "b": _file("blue", "-b"),
    "D": _set_dump,
    "E": _flag("echo"),
    "x": _file("buffer", "-x"),
    "w": _number("width", "-w", "width", 0, LARGEST, int),
    "h": _number("height", "-h", "height", 0, LARGEST, int),
    "s": _number("start", "-s", "starting row", -1, LARGEST, int),
    "e": _number("end", "-e", "ending row", -1, LARGEST, int),
    "d": _number("depth", "-d", "depth", 0, float("inf"), int),
    "l": _number("log_scale", "-l", "log scale value", 1, float("inf"), float),
    "S": _flag("shadows"),
    "N": _flag("check_normals"),
    "W": _flag("wireframe"),
}


def parse(arguments: Sequence[str]) -> Options:
    """The options of a command line. Raises UnrecoverableError."""
    options = Options()
    for argument in arguments:
        if not re.match(r"-[A-Za-z]", argument):
            if options.datafile is not None:
                raise UnrecoverableError(f"More than one input file specified: {options.datafile} and {argument}")
            options.datafile = argument
            continue
        setter = COMMANDS.get(argument[1])
        if setter is None:
            options.unknown.append(argument)
        else:
            setter(options, argument[2:].strip('"'))
    if options.unknown:
        raise UnrecoverableError(f"Unknown command {options.unknown[0]}; run mirage3d without arguments for a list")
    if options.datafile is None:
        raise UnrecoverableError("No input file specified")
    return options


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return command.ended("mirage3d", lambda: _main(sys.argv[1:] if arguments is None else arguments))


def _main(given: Sequence[str]) -> int:
    if not given or "--help" in given:
        print(LISTING, end="")
        return FINE
    if "--version" in given:
        print("\n".join(f"{name} {version}" for name, version in versions().items()))
        return FINE
    try:
        return _run(parse(given))
    except UnrecoverableError as error:
        say(f"Unrecoverable Error: {error}")
        return USAGE_ERROR


def _run(options: Options) -> int:
    assert options.datafile is not None
    try:
        text = Path(options.datafile).read_bytes()
    except (OSError, ValueError):
        raise UnrecoverableError(f"Unable to open input file: {options.datafile}") from None
    result = m3dc.compile(text, options.datafile)
    if options.echo:
        report.print_echo([], result.source, sys.stdout)
    deny = frozenset({catalogue.NORMAL_ON_WRONG_SIDE.code}) if options.check_normals else frozenset[str]()
    shown = Levels(deny=deny).apply(result.diagnostics)
    _print_errors(shown, result.source)
    if any(diagnostic.severity == "error" for diagnostic in shown):
        return SCENE_ERROR
    if options.dump is not None:
        _dump(result, options)
        return FINE
    _check_outputs(options)
    started = time.perf_counter()
    picture = _picture(result.ir, options)
    _write(picture, options)
    rows, columns, _ = picture.shape
    print(f"{columns} x {rows} pixels in {time.perf_counter() - started:.1f} s")
    print(f"written: {', '.join(map(str, _outputs(options).values()))}")
    return FINE


def _print_errors(diagnostics: Sequence[m3dc.Diagnostic], source: m3dc.Source) -> None:
    """Line, caret and message, as thesis 7.3.1 shows them."""
    for diagnostic in diagnostics:
        line, column = source.position(diagnostic.span.start)
        kind = "Unrecoverable" if diagnostic.code in _UNRECOVERABLE else _KINDS[diagnostic.code[:5]]
        word = "Error" if diagnostic.severity == "error" else "Warning"
        print(f"{line} {source.line(line)}", file=sys.stderr)
        print(f"{' ' * (len(str(line)) + column)}^", file=sys.stderr)
        print(f"{kind} {word} : {diagnostic.message}\n", file=sys.stderr)


def _dump(result: m3dc.Result, options: Options) -> None:
    assert options.datafile is not None
    data = report.valid(dump(result.ir, now())).encode()
    if not options.dump:
        command.write_output(data)
        return
    command.check_outputs(options.datafile, [options.dump])
    try:
        write_file(Path(options.dump), data)
    except OSError:
        raise UnrecoverableError(f"Unable to open debug file: {options.dump}") from None
    print(f"written: {options.dump}")


def _picture(ir: m3dc.SceneIR, options: Options) -> NDArray[np.float32]:
    view = ir.scene.view
    asked = options.render
    width, height = asked.get("width") or view.width, asked.get("height") or view.height
    if options.wireframe:
        return wireframe.draw(ir, width, height)
    first = 0 if options.start is None else options.start
    last = height - 1 if options.end is None else min(options.end, height - 1)
    if first > last:
        raise UnrecoverableError(f"Invalid starting row specified for -s command: {first} is not above row {last}")
    if options.start is not None or options.end is not None:
        asked |= {"rows": (first, last)}
    if asked.keys() & {"width", "height", "rows"}:
        asked |= {"width": width, "height": height}
    if options.buffer is not None:
        _check_buffer(Path(options.buffer))
        asked |= {"normalize": True}
    try:
        return _rendered(ir, asked)
    except SceneError as error:
        raise UnrecoverableError(str(error)) from None


def _rendered(ir: m3dc.SceneIR, asked: RenderOptions) -> NDArray[np.float32]:
    scene = prepare(ir)
    interrupt = Interrupt()
    try:
        with interrupt:
            rendering = scene.render(**(asked | {"cancel": interrupt.asked}))
    except Cancelled:
        raise Terminated(interrupt.number) from None
    return rendering.picture


def _check_buffer(buffer: Path) -> None:
    """The picture is scaled in memory, so the file itself is not needed; but a name that can not be one is refused."""
    if not _may_be_written(buffer):
        raise UnrecoverableError(f"Unable to open buffer file: {buffer}")


def _outputs(options: Options) -> dict[str, Path]:
    return {"RED": Path(options.red), "GREEN": Path(options.green), "BLUE": Path(options.blue)}


def _check_outputs(options: Options) -> None:
    """Refuse files that can not be written before the work is done, not after."""
    assert options.datafile is not None
    for color, path in _outputs(options).items():
        if not _may_be_written(path):
            raise UnrecoverableError(f"Unable to open {color} image file for output: {path}")
    command.check_outputs(options.datafile, _outputs(options).values())


def _may_be_written(path: Path) -> bool:
    try:
        return not path.is_dir() and path.absolute().parent.is_dir()
    except OSError:
        return False


def _write(picture: NDArray[np.float32], options: Options) -> None:
    values = to_bytes(picture)
    try:
        with replacing(*_outputs(options).values()) as files:
            for channel, file in enumerate(files):
                file.write(np.ascontiguousarray(values[..., channel]).tobytes())
    except BrokenPipeError:
        raise
    except OSError as error:
        raise UnrecoverableError(f"Unable to write the image files: {command.reason(error)}") from None
