"""A scene file as it is now: compiled, or what is wrong with it."""

from __future__ import annotations

import io
from typing import NamedTuple

from m3d_render import command
from m3d_render.command import SCENE_ERROR, CommandError
from m3dc.ir import SceneIR
from m3dc.text.source import Source


class Opened(NamedTuple):
    """A scene that can be shown. `source` is its text, None of a compiled one."""

    ir: SceneIR
    source: Source | None


class Fault(NamedTuple):
    """Why there is nothing to show: in one line, as a report for the terminal, and as an exit status."""

    summary: str
    report: str
    status: int


def open_scene(scene: str) -> Opened | Fault:
    """What is in a scene file, .m3d or .m3ir; standard input if it is called -. Never raises on what is in it."""
    printed = io.StringIO()
    try:
        if scene.lower().endswith(".m3ir"):
            return Opened(command.load(scene), None)
        result = command.compiled(scene, printed)
    except CommandError as failure:
        return Fault(str(failure), f"m3d-view: error: {failure}\n", failure.status)
    if result.ok:
        return Opened(result.ir, result.source)
    first = next(diagnostic for diagnostic in result.diagnostics if diagnostic.severity == "error")
    line = result.files.read(first.span.file).position(first.span.start).line
    return Fault(f"line {line}: {first.headline}", printed.getvalue(), SCENE_ERROR)
