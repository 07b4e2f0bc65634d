"""Running a program and seeing what it took: seconds of the clock, seconds of processor, largest memory."""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Run:
    """One run of a program. `peak` is the largest resident memory of the process, in bytes."""

    wall: float
    cpu: float
    peak: int
    status: int
    output: str
    errors: str


class RunError(RuntimeError):
    """The program ended with another status than 0; the message holds its last words."""


def environment() -> dict[str, str]:
    """What children run in: ours, but with Python's bytecode kept, as it is on a user's machine."""
    made = dict(os.environ)
    if made.pop("PYTHONDONTWRITEBYTECODE", None):
        made["PYTHONPYCACHEPREFIX"] = str(Path("out/bench/bytecode").resolve())
    return made


def run(command: Sequence[str | Path], folder: Path | None = None) -> Run:
    """Run a program to its end. Raises RunError where its status is not 0, FileNotFoundError where it is not there.

    The memory is what the kernel says at the end of the process (wait4), so nothing is sampled and nothing missed.
    """
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        started = time.perf_counter()
        process = subprocess.Popen(
            [str(word) for word in command],
            cwd=folder,
            env=environment(),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=errors,
        )
        _, wait_status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - started
        process.returncode = os.waitstatus_to_exitcode(wait_status)
        output.seek(0)
        errors.seek(0)
        ended = Run(
            wall=wall,
            cpu=usage.ru_utime + usage.ru_stime,
            peak=usage.ru_maxrss * 1024,
            status=process.returncode,
            output=output.read().decode("utf-8", "replace"),
            errors=errors.read().decode("utf-8", "replace"),
        )
    if ended.status != 0:
        said = "\n".join((ended.errors or ended.output).splitlines()[-8:])
        raise RunError(f"{' '.join(map(str, command))}: status {ended.status}\n{said}")
    return ended
