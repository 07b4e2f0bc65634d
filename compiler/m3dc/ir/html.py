"""How a compiled scene shows itself in a notebook: as HTML, what it holds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from html import escape
from typing import TypeAlias

import numpy as np

from .tables import Columns, Globals, PrimitiveKind, TextureKind, Triple

Tables: TypeAlias = Mapping[str, Columns]

MOST_ROWS = 20
"""Solids that are shown one by one."""

_CELL = "text-align: left; padding: 0.1em 0.8em 0.1em 0"


def scene_html(scene: Globals, tables: Tables, source: str) -> str:
    """What a scene says once, how much of everything it has, and its solids."""
    facts = "\n".join(
        f'<tr><th style="{_CELL}">{name}</th><td style="{_CELL}">{says}</td></tr>'
        for name, says in _facts(scene, tables, source)
    )
    return f"<table>\n{facts}\n</table>\n{_solids(tables)}"


def _facts(scene: Globals, tables: Tables, source: str) -> list[tuple[str, str]]:
    view, mirage, extent = scene.view, scene.mirage, scene.extent
    facts = [("scene", escape(source) or "without a name")]
    size = f"{view.width} x {view.height} pixels, {view.fov:g}° wide"
    facts.append(("view", f"from {_vector(view.eye)} to {_vector(view.target)}, {size}"))
    if mirage is None:
        facts.append(("air", "straight rays"))
    else:
        elevation, temperature = tables["profile"]["elevation"], tables["profile"]["temperature"]
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
    counts = {name: len(next(iter(tables[name].values()))) for name in ("solids", "lights", "facets", "textures")}
    facts.append(("holds", _counted(counts) or "nothing"))
    return facts


def _counted(counts: dict[str, int]) -> str:
    """Such as `3 solids, 1 light`; what there is none of is left out."""
    return ", ".join(f"{n:,} {name[:-1] if n == 1 else name}" for name, n in counts.items() if n)


def _solids(tables: Tables) -> str:
    solids, surfaces = tables["solids"], tables["surfaces"]
    count = len(solids["first_primitive"])
    if not count:
        return ""
    rows: list[str] = []
    for row in range(min(count, MOST_ROWS)):
        cells = [str(row), _swatch(surfaces["color"][row]), _primitives(tables, row), _textures(tables, row)]
        rows.append("<tr>" + "".join(f'<td style="{_CELL}">{cell}</td>' for cell in cells) + "</tr>")
    if count > MOST_ROWS:
        rows.append(f'<tr><td colspan="4" style="{_CELL}">... and {count - MOST_ROWS:,} more</td></tr>')
    head = "".join(f'<th style="{_CELL}">{name}</th>' for name in ("solid", "colour", "primitives", "textures"))
    return "\n".join(["<table>", f"<tr>{head}</tr>", *rows, "</table>"])


def _primitives(tables: Tables, solid: int) -> str:
    first, count = (int(tables["solids"][column][solid]) for column in ("first_primitive", "primitive_count"))
    kinds = Counter(PrimitiveKind(kind).name for kind in tables["primitives"]["kind"][first : first + count].tolist())
    return ", ".join(name if number == 1 else f"{number} x {name}" for name, number in kinds.items())


def _textures(tables: Tables, solid: int) -> str:
    first, count = (int(tables["surfaces"][column][solid]) for column in ("first_texture", "texture_count"))
    return ", ".join(TextureKind(kind).name for kind in tables["textures"]["kind"][first : first + count].tolist())


def _vector(vector: Triple) -> str:
    return f"&lt; {', '.join(f'{part:.6g}' for part in vector)} &gt;"


def _swatch(color: Triple) -> str:
    """A square of the colour, and its numbers."""
    red, green, blue = (round(255 * float(part)) for part in np.clip(color, 0, 1))
    square = f'<span style="background: rgb({red}, {green}, {blue}); border: 1px solid #888">&emsp;</span>'
    return f"{square} {_vector(color)}"
