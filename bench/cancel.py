"""The row about giving up: how soon a rendering ends that is told to."""

from __future__ import annotations

import threading
import time
from typing import Any

import m3d_render
import m3dc
from m3d_render.rendering import Prepared

from .result import Aim, Result, middle, spread
from .workshop import Workshop

ENOUGH = 100.0
"""Milliseconds within which a person feels that something happens at once."""


def _ignore(_: object) -> None:
    """Looks at no tile."""


SLOW: dict[str, dict[str, Any]] = {
    "many pixels": {"width": 20_000, "height": 10_000},
    "many samples a pixel": {"samples": 65_536},
    "tiles": {"width": 20_000, "height": 10_000, "tiles": _ignore},
}
"""What the merman scene is asked for: each would take from minutes to days."""

LONG = """
SCENE
{
    VIEW { FROM < 0, 0, 5.1 > TO < 100, 0, 5.1 > FOV 1 WIDTH 4000 HEIGHT 4000 }
    MIRAGE { SEGMENTS 1000000 DISTANCE 1e20 PROFILE { 0 20 5 0 10 20 } }
}
SOLID { SPHERE { CENTER < 5e19, 0, 5 > RADIUS 3e19 } }
LIGHT { }
"""
"""A scene in which each ray has a million arcs, of which all are kept."""


def cancelled(shop: Workshop) -> list[Result]:
    """From the moment, in the midst of the work, at which it is told to end, to its end; the slowest counts."""
    scene = m3d_render.prepare(shop.ir("merman"))
    kinds = {name: (scene, options) for name, options in SLOW.items()}
    kinds["rays of a million arcs"] = m3d_render.prepare(m3dc.compile(LONG).ir), {}
    samples = {name: [_milliseconds(*kind) for _ in range(shop.repeats)] for name, kind in kinds.items()}
    return [
        Result(
            "cancel",
            "giving up a rendering, the slowest of four kinds",
            "a tenth of a second",
            "ms",
            max(middle(taken) for taken in samples.values()),
            ENOUGH,
            Aim(1.0),
            "; ".join(f"{name} {spread(taken)} ms" for name, taken in samples.items()),
        )
    ]


def _milliseconds(scene: Prepared, options: dict[str, Any]) -> float:
    asked: list[float] = []
    timer = threading.Timer(0.5, lambda: asked.append(time.perf_counter()))
    timer.start()
    try:
        scene.render(cancel=lambda: bool(asked), **options)
    except m3d_render.Cancelled:
        return 1000.0 * (time.perf_counter() - asked[0])
    raise RuntimeError("the rendering was done before it could be given up")
