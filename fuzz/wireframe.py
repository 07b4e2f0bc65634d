"""The wireframe of any scene without errors is drawn within its picture, without an exception or a warning."""

from __future__ import annotations

import random
import warnings

import numpy as np

import m3dc
from m3d_render.rendering import SceneError
from m3d_render.wireframe.drawing import HIDDEN, project
from m3d_render.wireframe.marks import MARKS
from m3d_render.wireframe.raster import raster
from m3d_render.wireframe.svg import svg

from . import repeating
from .scenes import Scenes

SUFFIX = ".m3d"
CASES = 60

COLUMNS, ROWS = 32, 20
SLACK = 1e-9  # of a pixel


def make(chance: random.Random) -> bytes:
    return Scenes(chance, chance.choice((0.0, 0.1, 0.4))).scene().encode()


def check(data: bytes) -> str | None:
    result = m3dc.compile(data)
    if not result.ok:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for hidden in HIDDEN:
            for from_above in (False, True):
                try:
                    drawing = project(result.ir, COLUMNS, ROWS, from_above=from_above, hidden=hidden, show=MARKS)
                except SceneError:
                    continue  # which lines are hidden is told by rays: there may be none through such an atmosphere
                raster(drawing)
                text = svg(drawing)
                if "nan" in text or "inf" in text:
                    return f"a coordinate of the SVG is not finite (hidden={hidden}, from_above={from_above})"
                for thing in drawing.things:
                    for points in (thing.starts, thing.ends):
                        inside = (points[:, :2] >= -0.5 - SLACK) & (
                            points[:, :2] <= np.array([COLUMNS, ROWS]) - 0.5 + SLACK
                        )
                        if not inside.all():
                            return f"{thing.name} is drawn outside of the picture"
    return None


run = repeating(make, check)
