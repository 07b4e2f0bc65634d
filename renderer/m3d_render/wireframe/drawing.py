"""A wireframe in lines between pixels: what is in the picture, and which of it surfaces hide."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Literal, TypedDict, Unpack

import numpy as np
from numpy.typing import NDArray

from m3d_render.rendering import prepare
from m3d_render.wireframe.camera import above, before_the_eye, between, to_camera, to_pixels, to_scene, within
from m3d_render.wireframe.edges import CIRCLE_STEPS, Edges, edges
from m3d_render.wireframe.marks import MARKS, frustum_points, marks
from m3dc.ir import SceneIR, View

Points = NDArray[np.float64]
Hidden = Literal["show", "dim", "remove"]

HIDDEN: tuple[Hidden, ...] = ("show", "dim", "remove")
"""What becomes of lines behind surfaces: they are like all others, dashed, or left out."""

_PIECE = 2.0  # pixels: how well it is known where a line is hidden
_TOLERANCE = 1e-6  # of its distance: what a line must lie behind a surface to be hidden
_MOST_STEPS = 4000  # of a circle


@dataclass(frozen=True, slots=True)
class Strokes:
    """The lines of one thing: `starts` and `ends` (n, 3) in columns and rows of the picture and nearness (see
    `camera.to_pixels`). `hidden` (n) says which lie behind a surface."""

    name: str
    color: Points
    starts: Points
    ends: Points
    hidden: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Drawing:
    """A picture of lines, `columns` x `rows` pixels."""

    columns: int
    rows: int
    things: list[Strokes]


class Options(TypedDict, total=False):
    """What is drawn, and from where."""

    from_above: bool
    """Not from the scene's camera, but as a map."""
    hidden: Hidden
    """What becomes of lines behind surfaces; they are shown if not given."""
    show: Iterable[str]
    """Marks (MARKS) that are drawn besides."""


def project(ir: SceneIR, width: int | None = None, height: int | None = None, **options: Unpack[Options]) -> Drawing:
    """The lines of a scene in a picture of so many pixels (the scene's), seen by its camera or from above.

    Raises SceneError where hidden lines are asked for in a scene that cannot be traced, ValueError for marks there are
    not.
    """
    named, hidden = frozenset(options.get("show", ())), options.get("hidden", "show")
    if not named <= set(MARKS):
        raise ValueError(f"there is no mark {', '.join(sorted(named - set(MARKS)))}; there are {', '.join(MARKS)}")
    scene = ir.scene
    columns, rows = width or scene.view.width, height or scene.view.height
    marked = frustum_points(ir) if "frustum" in named else np.zeros((0, 3))
    view = above(ir, columns, rows, marked) if options.get("from_above") else scene.view
    found = edges(ir) if hidden == "show" else edges(ir, partial(_roundness, view, columns))
    groups = [*found, *marks(ir, view, named)]
    things = [_strokes(group, view, columns, rows) for group in groups]
    if hidden != "show":
        things = list(_divided(ir, view, columns, rows, things, [group.curved for group in groups]))
        if hidden == "remove":
            things = [_without_hidden(thing) for thing in things]
    return Drawing(columns, rows, things)


def _strokes(group: Edges, view: View, columns: int, rows: int) -> Strokes:
    starts, ends = before_the_eye(view, to_camera(view, group.starts), to_camera(view, group.ends), columns, rows)
    a, b = within(to_pixels(view, starts, columns, rows), to_pixels(view, ends, columns, rows), columns, rows)
    return Strokes(group.name, group.color, a, b, np.zeros(len(a), bool))


def _roundness(view: View, columns: int, centre: Points, radius: float) -> int:
    """Segments of a circle that are no longer than a piece, wherever on the sphere it is."""
    nearest = max(float(np.linalg.norm(centre - np.array(view.eye))) - radius, 0.02 * radius)
    if nearest == 0:
        return CIRCLE_STEPS
    pixels = radius / nearest * view.distance * (columns - 1) / 2
    return int(np.clip(2 * np.pi * pixels / _PIECE, CIRCLE_STEPS, _MOST_STEPS))


def _divided(
    ir: SceneIR, view: View, columns: int, rows: int, things: list[Strokes], curved: list[bool]
) -> Iterator[Strokes]:
    """Things whose lines are either hidden or not: those that are hidden in part are divided."""
    tracer = prepare(SceneIR(ir.scene._replace(view=view), ir.tables, ir.source)).kernel
    for thing, one_piece in zip(things, curved, strict=True):
        across = np.abs(thing.ends - thing.starts)[:, :2].max(axis=1, initial=0.0)
        counts = np.ones(len(across), np.int64) if one_piece else np.ceil(across / _PIECE).astype(np.int64) + 1
        line = np.repeat(np.arange(len(counts)), counts)
        step = np.arange(len(line)) - np.repeat(np.cumsum(counts) - counts, counts)
        a, b = thing.starts[line], thing.ends[line]
        starts, ends = (between(a, b, place / counts[line]) for place in (step, step + 1))
        hidden = np.zeros(len(line), bool)
        for points in (starts, ends):
            hidden |= ~tracer.sees(to_scene(view, points, columns, rows), _TOLERANCE)
        first = np.flatnonzero(np.append(True, (line[1:] != line[:-1]) | (hidden[1:] != hidden[:-1])))[: len(line)]
        last = np.append(first[1:], len(line)) - 1 if len(line) else first
        yield Strokes(thing.name, thing.color, starts[first], ends[last], hidden[first])


def _without_hidden(thing: Strokes) -> Strokes:
    kept = ~thing.hidden
    return Strokes(thing.name, thing.color, thing.starts[kept], thing.ends[kept], thing.hidden[kept])
