"""How what compiling gave shows itself in a notebook: as HTML, what is wrong and what the scene holds."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from .diagnostics import Diagnostic
from .diagnostics.levels import Levels
from .diagnostics.report import summary
from .ir import SceneIR
from .ir.html import scene_html
from .text.files import Files

MOST_ROWS = 20
"""Diagnostics that are shown one by one."""

_COLORS = {"error": "#c00", "warning": "#a60", "hint": "#06a"}


def result_html(diagnostics: Sequence[Diagnostic], files: Files, ir: SceneIR) -> str:
    """The diagnostics, each with its line, then the scene as far as it was compiled."""
    shown = Levels().apply(diagnostics)
    parts: list[str] = []
    for diagnostic in shown[:MOST_ROWS]:
        source = files.read(diagnostic.span.file)
        line, column = source.position(diagnostic.span.start)
        kind = f'<b style="color: {_COLORS[diagnostic.severity]}">{diagnostic.severity}[{diagnostic.code}]</b>'
        text = escape(source.line(line))
        parts.append(f"<div>{line}:{column}: {kind}: {escape(diagnostic.message)}<pre>{text}</pre></div>")
    if len(shown) > MOST_ROWS:
        parts.append(f"<div>... and {len(shown) - MOST_ROWS} more</div>")
    if shown:
        parts.append(f"<div>{summary(shown)}</div>")
    return "\n".join([*parts, scene_html(ir.scene, ir.tables, ir.source)])
