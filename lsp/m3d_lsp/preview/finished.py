"""A finished picture, and what can be asked of it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from m3d_render import Prepared, Rendering, optics
from m3dc.ir import SceneIR

# The path is not among them: it is dear, and one pixel's is soon traced again.
LAYERS = ("depth", "normal", "position", "solid", "primitive", "uv")


class Finished:
    """A picture with its layers, and the scene that it was made of."""

    def __init__(self, prepared: Prepared, rendering: Rendering) -> None:
        self._prepared = prepared
        self._rendering = rendering

    @property
    def _ir(self) -> SceneIR:
        return self._prepared.ir

    def pick(self, x: int, y: int) -> dict[str, Any] | None:
        """What a pixel shows; None where it shows no primitive."""
        layers = self._rendering.layers
        primitive = int(layers["primitive"][y, x])
        if primitive < 0:
            return None
        length, arcs = self._path(x, y)
        return {
            "solid": int(layers["solid"][y, x]),
            "primitive": primitive,
            "color": _numbers(self._rendering.picture[y, x]),
            "position": _numbers(layers["position"][y, x]),
            "normal": _numbers(layers["normal"][y, x]),
            "depth": _numbers(layers["depth"][y : y + 1, x])[0],
            "uv": _numbers(layers["uv"][y, x]),
            "path": {"length": length, "arcs": int(arcs or 0)},
        }

    def mask(self, primitives: NDArray[np.int64]) -> list[tuple[int, int, int]]:
        """Where the picture shows some primitives: row, first column and end column of each run of pixels."""
        shown = np.isin(self._rendering.layers["primitive"], primitives)
        edges = np.diff(shown.astype(np.int8), axis=1, prepend=0, append=0)
        rows, starts = np.nonzero(edges == 1)
        _, ends = np.nonzero(edges == -1)
        return list(zip(rows.tolist(), starts.tolist(), ends.tolist(), strict=True))

    def ray(self, x: int, y: int) -> dict[str, Any]:
        """The ray through a pixel: points (r, z), and how it ends."""
        direction = self._direction(x, y)
        across = math.hypot(direction[0], direction[1])
        slope = float(direction[2]) / max(across, 1e-12)
        hit = None
        if self._rendering.layers["primitive"][y, x] >= 0:
            place = self._rendering.layers["position"][y, x].astype(np.float64)
            eye = self._ir.scene.view.eye
            hit = (math.hypot(place[0] - eye[0], place[1] - eye[1]), float(place[2]))
        points, end = self._bent(slope) if self._rendering.bent else self._straight(slope)
        if hit is not None:
            points, end = [*(point for point in points if point[0] < hit[0]), hit], "hit"
            if not self._rendering.bent:
                points = [points[0], hit]
        return {"points": points, "end": end}

    def _path(self, x: int, y: int) -> list[float | None]:
        """Length, and number of arcs, of the ray through a pixel."""
        rendering = self._rendering
        alone = self._prepared.render(
            width=rendering.width,
            height=rendering.height,
            region=(y, x, y, x),
            straight=not rendering.bent,
            shadows=False,
            depth=1,
            threads=1,
            aov=["path"],
        )
        return _numbers(alone.layers["path"][0, 0])

    def _direction(self, x: int, y: int) -> NDArray[np.float64]:
        """From the eye through the middle of a pixel (see View)."""
        view, width, height = self._ir.scene.view, self._rendering.width, self._rendering.height
        u = x / (width - 1) if width > 1 else 0.5
        v = y / (height - 1) if height > 1 else 0.5
        upright = height / width * view.aspect
        right, up = np.array(view.right), np.array(view.up)
        ahead = view.distance * np.array(view.normal)
        return ahead + (2 * u - 1) * right + (1 - 2 * v) * upright * up

    def _bent(self, slope: float) -> tuple[list[tuple[float, float]], str]:
        angle = math.atan(slope)
        air = optics.Air(self._ir)
        crossings = air.crossings(angle)
        (end,) = air.paths([angle]).ends
        return [(r, z) for r, z in crossings.tolist()], str(end)

    def _straight(self, slope: float) -> tuple[list[tuple[float, float]], str]:
        """To where the scene's air ends; without any, to where its things do."""
        scene = self._ir.scene
        eye = scene.view.eye
        ends: list[tuple[float, str]] = []
        if scene.mirage is not None:
            ends.append((scene.mirage.distance, "range"))
            heights = (float(self._ir["profile"]["elevation"][0]), "ground"), (scene.mirage.elevation, "top")
            ends += [((z - eye[2]) / slope, end) for z, end in heights if slope and (z - eye[2]) / slope > 0]
        elif scene.extent is not None:
            corners = zip(*(scene.extent.minimum[:2], scene.extent.maximum[:2]), strict=True)
            far = math.hypot(*(max(abs(a - e), abs(b - e)) for (a, b), e in zip(corners, eye[:2], strict=True)))
            ends.append((far, "range"))
        r, end = min(ends, default=(1.0, "range"))
        return [(0.0, eye[2]), (r, eye[2] + slope * r)], end


def _numbers(values: NDArray[np.float32]) -> list[float | None]:
    """Numbers for JSON, which has none that is not finite."""
    return [float(value) if np.isfinite(value) else None for value in values]
