"""Where a run keeps its things: scenes, translations and C programs, each made when it is first asked for."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import m3dc
from m3dc.ir import SceneIR

from . import povray, scenes
from .child import RunError, run

HERE = Path(__file__).resolve().parent


class Workshop:
    """The folder of a run, how often each thing is measured, and what may be fetched."""

    def __init__(self, folder: Path, repeats: int, *, fetch: bool = False) -> None:
        self.folder = folder.resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.repeats = repeats
        self.fetch = fetch
        self.scene = cache(self._scene)
        self.ir = cache(self._ir)
        self.povray_scene = cache(self._povray_scene)
        self.c_program = cache(self._c_program)

    def _scene(self, name: str) -> Path:
        """The file of a scene, by its name in bench.scenes."""
        return scenes.make(name, self.folder)

    def _ir(self, name: str) -> SceneIR:
        """A scene, compiled."""
        result = m3dc.compile(self.scene(name).read_bytes(), name)
        if not result.ok:
            raise RuntimeError(f"the scene {name} does not compile: {result.diagnostics[0].message}")
        return result.ir

    def _povray_scene(self, name: str, shadows: bool) -> Path:
        """A scene in POV-Ray's language."""
        path = self.folder / f"{name}{'-shadows' if shadows else ''}.pov"
        return povray.write(self.ir(name), path, shadows=shadows)

    def _c_program(self, source: str, *libraries: str) -> Path | None:
        """A C program of this folder, compiled; None where there is no compiler or a library is missing."""
        compiler = shutil.which("cc")
        if compiler is None:
            return None
        program = self.folder / Path(source).stem
        command = [compiler, "-O3", "-std=c11", "-o", program, HERE / source, *(f"-l{name}" for name in libraries)]
        done = subprocess.run(command, capture_output=True, check=False)
        return program if done.returncode == 0 else None

    @staticmethod
    def command(name: str) -> str:
        """One of our commands: of this Python's environment, else of the path."""
        own = Path(sys.executable).parent / name
        return str(own) if own.exists() else shutil.which(name) or name


def version(*command: str) -> str:
    """The line in which a program says its version; nothing where it is not installed."""
    try:
        ended = run(command)
    except RunError:
        return ""
    lines = (ended.output + ended.errors).splitlines()
    return next((line.strip() for line in lines if re.search(r"\d+\.\d+", line) and "/" not in line), "")
