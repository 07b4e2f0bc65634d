"""Running a program and seeing what it took: seconds of the clock, seconds of processor, largest memory."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

SPAWN = Path(__file__).resolve().parent / "spawn.py"


@dataclass(frozen=True, slots=True)
class Run:
    """One run of a program. `peak` is the largest resident memory of the process, in bytes."""

    wall: float
    cpu: float
    peak: int
    output: str
    errors: str


class RunError(RuntimeError):
    """The program is not there, or ended with another status than 0; the message holds its last words."""


def environment() -> dict[str, str]:
    """What children run in: ours, but with Python's bytecode kept, as it is on a user's machine."""
    made = dict(os.environ)
    if made.pop("PYTHONDONTWRITEBYTECODE", None):
        made["PYTHONPYCACHEPREFIX"] = str(Path("out/bench/bytecode").resolve())
    return made


def run(command: Sequence[str | Path]) -> Run:
    """Run a program to its end. Raises RunError where its status is not 0.

    The figures are what the system says at the end of the process (wait4), so nothing is sampled and nothing missed.
    """
    words = [str(word) for word in command]
    with tempfile.TemporaryDirectory() as folder:
        taken = Path(folder) / "taken.json"
        done = subprocess.run(
            [sys.executable, "-S", str(SPAWN), str(taken), *words],
            env=environment(),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
        )
        figures: dict[str, Any] = json.loads(taken.read_text()) if taken.exists() else {"status": None}
    if figures["status"] != 0:
        said = "\n".join((done.stderr or done.stdout).splitlines()[-8:])
        raise RunError(f"{' '.join(words)}: status {figures['status']}\n{said}")
    return Run(figures["wall"], figures["cpu"], figures["peak"], done.stdout, done.stderr)
