"""A wireframe as SVG: a group for each thing, with its lines as strokes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from m3d_render.wireframe.raster import DASH, FAINT, Paper, visible

if TYPE_CHECKING:
    from m3d_render.wireframe.drawing import Drawing, Strokes

Points = NDArray[np.float64]


def svg(drawing: Drawing, paper: Paper = "black") -> str:
    """The text of the file. Groups are named by what they show, such as solid-3, and are layers in Inkscape; hidden
    lines are dashed and fainter. Coordinates are those of the pixels' middles."""
    columns, rows = drawing.columns, drawing.rows
    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'width="{columns}" height="{rows}" viewBox="-0.5 -0.5 {columns} {rows}" fill="none" stroke-linejoin="round" '
        'stroke-linecap="round">',
        f'<rect x="-0.5" y="-0.5" width="{columns}" height="{rows}" fill="{paper}"/>',
    ]
    by_name: dict[str, list[Strokes]] = {}
    for thing in drawing.things:
        by_name.setdefault(thing.name, []).append(thing)
    for name, things in by_name.items():
        paths = [path for thing in things for path in _paths(thing, paper)]
        if paths:
            group = f'<g id="{name}" inkscape:groupmode="layer" inkscape:label="{name}">'
            parts += [group, f"<title>{name}</title>", *paths, "</g>"]
    return "\n".join([*parts, "</svg>", ""])


def _paths(thing: Strokes, paper: Paper) -> list[str]:
    color = "".join(f"{round(255 * float(part)):02x}" for part in np.clip(visible(thing.color, paper), 0, 1))
    paths: list[str] = []
    for hidden in (True, False):
        chosen = thing.hidden == hidden
        if chosen.any():
            dashes = f' stroke-dasharray="{DASH}" stroke-opacity="{FAINT}"' if hidden else ""
            lines = _lines(thing.starts[chosen], thing.ends[chosen])
            paths.append(f'<path stroke="#{color}"{dashes} d="{lines}"/>')
    return paths


def _lines(starts: Points, ends: Points) -> str:
    """Path data; a line that begins where the one before ends continues it."""
    a, b = np.round(starts[:, :2], 2), np.round(ends[:, :2], 2)
    words: list[str] = []
    tip = None
    for (ax, ay), (bx, by) in zip(a.tolist(), b.tolist(), strict=True):
        if (ax, ay) != tip:
            words.append(f"M{ax:g} {ay:g}")
        words.append(f"L{bx:g} {by:g}")
        tip = (bx, by)
    return "".join(words)
