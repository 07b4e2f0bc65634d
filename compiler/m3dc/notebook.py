"""How a compiled scene shows itself in a notebook: as HTML, what is wrong with it and what it holds."""

from __future__ import annotations

from collections import Counter
from html import escape

import numpy as np

from .compiler import Result
from .ir import PrimitiveKind, SceneIR, TextureKind, Triple
from .levels import Levels
from .report import summary

MOST_ROWS = 20
"""Solids and diagnostics that are shown one by one."""

_CELL = "text-align: left; padding: 0.1em 0.8em 0.1em 0"
_COLORS = {"error": "#c00", "warning": "#a60", "hint": "#06a"}


def result_html(result: Result) -> str:
    """The diagnostics, each with its line, then the scene as far as it was compiled."""
    shown = Levels().apply(result.diagnostics)
    parts: list[str] = []
    for diagnostic in shown[:MOST_ROWS]:
        line, column = result.source.position(diagnostic.span[0])
        kind = f'<b style="color: {_COLORS[diagnostic.severity]}">{diagnostic.severity}[{diagnostic.code}]</b>'
        text = escape(result.source.line(line))
        parts.append(f"<div>{line}:{column}: {kind}: {escape(diagnostic.message)}<pre>{text}</pre></div>")
    if len(shown) > MOST_ROWS:
        parts.append(f"<div>... and {len(shown) - MOST_ROWS} more</div>")
    if shown:
        parts.append(f"<div>{summary(shown)}</div>")
    return "\n".join([*parts, scene_html(result.ir)])


def scene_html(ir: SceneIR) -> str:
    """What a scene says once, how much of everything it has, and its solids."""
    facts = "\n".join(
        f'<tr><th style="{_CELL}">{name}</th><td style="{_CELL}">{says}</td></tr>' for name, says in _facts(ir)
    )
    return f"<table>\n{facts}\n</table>\n{_solids(ir)}"


def _facts(ir: SceneIR) -> list[tuple[str, str]]:
    scene = ir.scene
    view, mirage, extent = scene.view, scene.mirage, scene.extent
    facts = [("scene", escape(ir.source) or "without a name")]
    size = f"{view.width} x {view.height} pixels, {view.fov:g}° wide"
    facts.append(("view", f"from {_vector(view.eye)} to {_vector(view.target)}, {size}"))
    if mirage is None:
        facts.append(("air", "straight rays"))
    else:
        elevation, temperature = ir["profile"]["elevation"], ir["profile"]["temperature"]
        facts.append(
            (
                "air",
                f"{len(elevation)} points from {elevation[0]:g} to {elevation[-1]:g} m, "
                f"{temperature.min():g} to {temperature.max():g} °C; rays bent for {mirage.distance:g} m",
            )
        )
    behind = "sky" if scene.sky else f"background {_swatch(scene.background)}"
    if scene.haze.defined:
        behind += f", haze {_swatch(scene.haze.color)}"
    facts.append(("behind", behind))
    if extent is not None:
        facts.append(("extent", f"{_vector(extent.minimum)} to {_vector(extent.maximum)}"))
    counts = {name: len(next(iter(ir[name].values()))) for name in ("solids", "lights", "facets", "textures")}
    facts.append(("holds", _counted(counts) or "nothing"))
    return facts


def _counted(counts: dict[str, int]) -> str:
    """Such as `3 solids, 1 light`; what there is none of is left out."""
    return ", ".join(f"{n:,} {name[:-1] if n == 1 else name}" for name, n in counts.items() if n)


def _solids(ir: SceneIR) -> str:
    solids, surfaces = ir["solids"], ir["surfaces"]
    count = len(solids["first_primitive"])
    if not count:
        return ""
    rows: list[str] = []
    for row in range(min(count, MOST_ROWS)):
        cells = [str(row), _swatch(surfaces["color"][row]), _primitives(ir, row), _textures(ir, row)]
        rows.append("<tr>" + "".join(f'<td style="{_CELL}">{cell}</td>' for cell in cells) + "</tr>")
    if count > MOST_ROWS:
        rows.append(f'<tr><td colspan="4" style="{_CELL}">... and {count - MOST_ROWS:,} more</td></tr>')
    head = "".join(f'<th style="{_CELL}">{name}</th>' for name in ("solid", "colour", "primitives", "textures"))
    return "\n".join(["<table>", f"<tr>{head}</tr>", *rows, "</table>"])


def _primitives(ir: SceneIR, solid: int) -> str:
    first, count = (int(ir["solids"][column][solid]) for column in ("first_primitive", "primitive_count"))
    kinds = Counter(PrimitiveKind(kind).name for kind in ir["primitives"]["kind"][first : first + count].tolist())
    return ", ".join(name if number == 1 else f"{number} x {name}" for name, number in kinds.items())


def _textures(ir: SceneIR, solid: int) -> str:
    first, count = (int(ir["surfaces"][column][solid]) for column in ("first_texture", "texture_count"))
    return ", ".join(TextureKind(kind).name for kind in ir["textures"]["kind"][first : first + count].tolist())


def _vector(vector: Triple) -> str:
    return f"&lt; {', '.join(f'{part:.6g}' for part in vector)} &gt;"


def _swatch(color: Triple) -> str:
    """A square of the colour, and its numbers."""
    red, green, blue = (round(255 * float(part)) for part in np.clip(color, 0, 1))
    square = f'<span style="background: rgb({red}, {green}, {blue}); border: 1px solid #888">&emsp;</span>'
    return f"{square} {_vector(color)}"
