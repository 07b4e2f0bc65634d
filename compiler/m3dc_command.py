"""How every command of the project starts and ends, and where `m3dc` and `m3dfmt` start.

A command ends with 0 when all is well, 1 when a scene has errors, 2 for usage, files and everything else that keeps
it from its work, and 128 + N where signal N ended it: 130 for an interrupt (Ctrl-C), 143 for SIGTERM. Whatever goes
wrong is one line on standard error, never a traceback.

This is no part of the package `m3dc`, and imports nothing of it: an interrupt while NumPy is being loaded ends a
command like any other.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import re
import signal
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from types import FrameType
from typing import Any, TypeVar

T = TypeVar("T")

FINE, SCENE_ERROR, USAGE_ERROR = 0, 1, 2

EXIT_STATUS = "Exit status: 0 fine, 1 the scene has errors, 2 usage or files, 130 interrupted"

TRACEBACK = "MIRAGE3D_TRACEBACK"
"""The environment variable that asks for the traceback of an internal error."""


_TERMINATING: list[int] = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]


class CommandError(Exception):
    """Ends the command with a status and, unless it has been said already, a message."""

    def __init__(self, status: int, message: str = "") -> None:
        super().__init__(message)
        self.status = status


class Terminated(KeyboardInterrupt):
    """A signal that asks the process to end, `number`: handled as an interrupt is."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


# --- starting and ending ----------------------------------------------------------------------------------------------


def started(program: str, load: Callable[[], Callable[[], int]]) -> int:
    """The exit status of a command of which `load` imports the main function: what an installed script calls."""
    status = ended(program, lambda: undisturbed(load)())
    # While Python itself ends there is nobody left to explain an interrupt.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return status


def undisturbed(load: Callable[[], T]) -> T:
    """What `load` imports. A signal that comes meanwhile interrupts afterwards, a second one at once: compiled modules
    that are being loaded take an interrupt for a module that is missing, or lose it."""
    came: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        came.append(number)
        if len(came) > 1:
            handlers[number](number, frame)

    handlers: dict[int, Callable[[int, FrameType | None], Any]] = {}
    for number in (signal.SIGINT, *_TERMINATING):
        handler = signal.getsignal(number)
        if callable(handler):  # neither ignored nor left to the system
            handlers[number] = handler
            signal.signal(number, note)
    try:
        return load()
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])


def ended(program: str, action: Callable[[], int]) -> int:
    """The exit status of a command, its failures explained. Nothing that `action` raises leaves it."""
    _prepare_streams()
    heard = _hear_signals()
    try:
        status, message = _outcome(program, action)
        if message:
            say(f"{program}: {message}")
        try:
            sys.stdout.flush()
        except OSError:
            # Nothing else can be written there, not even when Python ends.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return status
    finally:
        for number in heard:
            signal.signal(number, signal.SIG_DFL)


def say(line: str) -> None:
    """Writes one line to standard error, whatever is in it, if anything can be written there."""
    shown = "".join(character if character.isprintable() else "\ufffd" for character in line)
    with contextlib.suppress(OSError):
        print(shown, file=sys.stderr, flush=True)


def _outcome(program: str, action: Callable[[], int]) -> tuple[int, str]:
    """The exit status, and what there is to say about it."""
    try:
        try:
            status = action()
        except SystemExit as end:  # argparse's way
            status = end.code if isinstance(end.code, int) else FINE
        sys.stdout.flush()
    except CommandError as failure:
        signalled = failure.status > 128
        return failure.status, str(failure) and (str(failure) if signalled else f"error: {failure}")
    except KeyboardInterrupt as interrupt:
        number = interrupt.number if isinstance(interrupt, Terminated) else signal.SIGINT
        return 128 + number, "interrupted"
    except MemoryError:
        return USAGE_ERROR, "error: this does not fit in memory"
    except BrokenPipeError:
        # As `| head` does it: whoever read the output has enough.
        return USAGE_ERROR, ""
    except OSError as error:
        where = f"{os.fsdecode(error.filename)}: " if isinstance(error.filename, (str, bytes)) else ""
        return USAGE_ERROR, f"error: {where or 'cannot write the output: '}{error.strerror or error}"
    except BaseException as error:  # whatever it is: no traceback
        return USAGE_ERROR, _internal(program, error)
    return status, ""


def _internal(program: str, error: BaseException) -> str:
    if os.environ.get(TRACEBACK):
        import traceback

        traceback.print_exception(error)
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    place = "" if trace is None else f" ({os.path.basename(trace.tb_frame.f_code.co_filename)}:{trace.tb_lineno})"
    what = f"{type(error).__name__}: {error}{place}"
    return f"internal error: {what}; this is a fault of {program}; {TRACEBACK}=1 shows how it came to it"


def _prepare_streams() -> None:
    """Opens the standard streams that were closed (`>&-`), so that no file takes their numbers. To read or write one
    of them fails, and what is said on standard error is lost."""
    for name, mode, how in (("stdin", "r", os.O_WRONLY), ("stdout", "w", os.O_RDONLY), ("stderr", "w", os.O_WRONLY)):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.open(os.devnull, how), mode, encoding="utf-8"))  # noqa: SIM115
    # A name that the terminal's encoding lacks is shown in escapes; it is no reason to fail.
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")


def _hear_signals() -> list[int]:
    """From now on the signals that ask to end are interrupts; returns which were not heard before."""
    heard: list[int] = []
    for number in _TERMINATING:
        if signal.getsignal(number) is signal.SIG_DFL:
            try:
                signal.signal(number, _terminate)
            except ValueError:  # not in the main thread
                return heard
            heard.append(number)
    return heard


def _terminate(number: int, frame: FrameType | None) -> None:
    raise Terminated(number)


# --- options ----------------------------------------------------------------------------------------------------------


class Parser(argparse.ArgumentParser):
    """argparse's, but that what begins with a minus and a digit (-2:2:0.5) is a value, never an option; and that help
    which can not be written is an error."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._negative_number_matcher = re.compile(r"-[.\d]")

    def print_help(self, file: Any = None) -> None:
        (file or sys.stdout).write(self.format_help())


def parser(program: str, distribution: str, **options: Any) -> Parser:
    """A command's options, as far as all commands have them. `distribution` is what it is installed with."""
    # For each option that is added argparse makes one of these, which would ask for the terminal's width.
    made = Parser(prog=program, formatter_class=partial(argparse.HelpFormatter, width=80), **options)
    made.add_argument("--version", action=_Version, distribution=distribution)
    made.formatter_class = argparse.HelpFormatter
    return made


class _Version(argparse.Action):
    """Prints the version of what is installed, which only then is looked for."""

    def __init__(self, option_strings: Sequence[str], dest: str, distribution: str) -> None:
        super().__init__(option_strings, argparse.SUPPRESS, nargs=0, help="show the program's version and exit")
        self._distribution = distribution

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        print(version_line(parser.prog, self._distribution))
        parser.exit()


def version_line(program: str, distribution: str) -> str:
    """Such as `m3dc 0.1.0`."""
    from importlib.metadata import version

    return f"{program} {version(distribution)}"


# --- files ------------------------------------------------------------------------------------------------------------


def read(scene: str) -> bytes:
    """The text of a scene file; of standard input if it is called -. Raises CommandError."""
    try:
        if scene == "-":
            return sys.stdin.buffer.read()
        with open(scene, "rb") as file:
            return file.read()
    except (OSError, ValueError) as error:
        raise CommandError(USAGE_ERROR, f"cannot read {scene}: {reason(error)}") from None


def write_output(data: bytes) -> None:
    """Writes bytes to standard output. Raises OSError."""
    sys.stdout.flush()
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()


def reason(error: Exception) -> str:
    """Why a file can not be read or written."""
    return getattr(error, "strerror", None) or str(error)


def check_outputs(scene: str, outputs: Iterable[str | os.PathLike[str]]) -> None:
    """Refuses files to write that would take the place of a scene, or of one another. Raises CommandError."""
    seen: list[str] = []
    for output in map(os.fspath, outputs):
        if same(scene, output):
            raise CommandError(
                USAGE_ERROR, f"{output} is the scene itself: writing would destroy it; give another name"
            )
        if output.lower().endswith(".m3d"):
            raise CommandError(USAGE_ERROR, f"{output}: a name that ends in .m3d is a scene's; give another name")
        if any(same(output, other) for other in seen):
            raise CommandError(USAGE_ERROR, f"{output} is named twice; each output needs a file of its own")
        seen.append(output)


def same(one: str, other: str) -> bool:
    """Whether two paths lead to one regular file, or would."""
    try:
        if os.path.exists(one) and os.path.exists(other):
            return os.path.isfile(one) and os.path.samefile(one, other)
        return os.path.realpath(one) == os.path.realpath(other)
    except (OSError, ValueError):
        return one == other


def now() -> str:
    """The time that a dump shows: SOURCE_DATE_EPOCH where that is set, so that two runs give the same bytes."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    return time.asctime(time.gmtime(int(epoch))) if epoch.isdecimal() else time.ctime()


# --- the compiler's commands ------------------------------------------------------------------------------------------


def m3dc() -> int:
    """Run the compiler's command; returns its exit status."""
    _without_threads()

    def load() -> Callable[[], int]:
        from m3dc.commands.m3dc import main

        return main

    return started("m3dc", load)


def m3dfmt() -> int:
    """Run the formatter's command; returns its exit status."""
    _without_threads()

    def load() -> Callable[[], int]:
        from m3dc.commands.m3dfmt import main

        return main

    return started("m3dfmt", load)


def _without_threads() -> None:
    """NumPy's linear algebra starts a thread for each processor as it is loaded, which is up to half of what compiling
    a small scene costs. These commands have nothing for them to do; other programs decide on their threads themselves.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
