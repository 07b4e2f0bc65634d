"""Where things are while distributions are made, and how programs are run for that."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from tools.version import ROOT

DIST = ROOT / "dist"
WORK = ROOT / "out/packaging"
TOOLS = WORK / "tools"
UV = ROOT / ".venv/bin/uv"


class ReleaseError(Exception):
    """Says what keeps the distributions from being made or used."""


def epoch() -> int:
    """The time that stands in every file that is made, seconds: that of the last commit, or SOURCE_DATE_EPOCH."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    return int(given or output("git", "log", "-1", "--format=%ct").strip())


def run(*words: str | Path, cwd: Path = ROOT, env: Mapping[str, str] | None = None) -> None:
    """Runs a program, and shows what it says only where it fails. Raises ReleaseError."""
    output(*words, cwd=cwd, env=env)


def output(*words: str | Path, cwd: Path = ROOT, env: Mapping[str, str] | None = None) -> str:
    """What a program writes to standard output. Raises ReleaseError, which holds all that it said, where it fails."""
    done = subprocess.run(words, cwd=cwd, env=env, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ReleaseError(f"{' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
    return done.stdout


def tool(name: str) -> Path:
    """A program of the tools' own environment."""
    return TOOLS / "bin" / name


def say(line: str) -> None:
    """Tells the person who waits."""
    print(line, flush=True, file=sys.stderr if line.startswith("error") else sys.stdout)
