"""The row about ray paths alone: every ray of the merman picture through its atmosphere, against plain C."""

from __future__ import annotations

import json
import time

import numpy as np
from numpy.typing import NDArray

from m3d_render import optics
from m3dc.ir import SceneIR

from .child import run
from .result import Aim, Result, alternate, middle, spread
from .workshop import Workshop

LEAST_OF = 5  # timings of one sample, of which the least counts, on both sides
ENDS = np.array(["ground", "top", "range", "segments"])  # by the C tracer's numbers


def slopes(ir: SceneIR) -> NDArray[np.float64]:
    """dz/dr of the ray through every pixel, row by row."""
    view = ir.scene.view
    u = 2.0 * np.arange(view.width) / (view.width - 1) - 1.0
    v = (1.0 - 2.0 * np.arange(view.height) / (view.height - 1)) * view.height / view.width * view.aspect
    ahead = np.array(view.normal) * view.distance
    rays = ahead + u[None, :, None] * np.array(view.right) + v[:, None, None] * np.array(view.up)
    return (rays[..., 2] / np.hypot(rays[..., 0], rays[..., 1])).ravel()


def paths(shop: Workshop) -> list[Result]:
    """64,000 paths, none of which meets an object. Both trace the same rays; where they end is compared."""
    ir = shop.ir("small")
    rays = slopes(ir)
    angles = np.arctan(rays)
    traced: list[optics.Paths] = []

    def ours() -> float:
        seconds: list[float] = []
        for _ in range(LEAST_OF):
            started = time.process_time()
            traced[:] = [optics.trace_paths(ir, angles)]
            seconds.append(time.process_time() - started)
        return min(seconds)

    program = shop.c_program("tracer/arcs.c", "m")
    if program is None:
        (mine,) = alternate(shop.repeats, ours)
        their_rate, note = None, "no C compiler"
    else:
        profile, start, ends = (shop.folder / f"paths-{name}.f64" for name in ("profile", "slopes", "ends"))
        np.stack([ir["profile"]["elevation"], ir["profile"]["temperature"]], 1).tofile(profile)
        rays.tofile(start)
        mirage, eye = ir.scene.mirage, ir.scene.view.eye[2]
        assert mirage is not None
        limits = (eye, mirage.distance, mirage.elevation, mirage.segments, LEAST_OF)

        def theirs() -> float:
            ended = run([program, profile, start, ends, *(f"{limit!r}" for limit in limits)])
            return float(json.loads(ended.output)["seconds"])

        mine, other = alternate(shop.repeats, ours, theirs)
        their_rate = len(rays) / middle(other) / 1e6
        note = _agreement(traced[0], np.fromfile(ends).reshape(-1, 4))
    seconds = middle(mine)
    arcs = int(traced[0].arcs.sum())
    return [
        Result(
            "paths",
            f"mirage ray paths alone, {len(rays):,} of the merman picture",
            "plain C, -O3, same model",
            "M paths/s",
            len(rays) / seconds / 1e6,
            their_rate,
            Aim(0.8, least=True),
            f"`m3d_render.optics.trace_paths`, one core, {arcs / seconds / 1e6:.1f} M arcs/s, {spread(mine)} s; {note}",
        )
    ]


def _agreement(ours: optics.Paths, theirs: NDArray[np.float64]) -> str:
    """How far the two tracers' results lie apart."""
    apart = np.abs(np.asarray(ours.end_points) - theirs[:, :2]).max()
    arcs = np.count_nonzero(ours.arcs != theirs[:, 2])
    ends = np.count_nonzero(ENDS[theirs[:, 3].astype(int)] != ours.ends)
    return f"the ends differ by at most {apart:.1e} m, {arcs} rays in their number of arcs, {ends} in why they ended"
