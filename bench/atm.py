"""The row about a picture with one curved ray a pixel, against Runge-Kutta in fixed steps.

The reference is the crate atm-refraction, the engine of the program atm-raytracer (which itself is not on crates.io).
It is fetched and built only when asked for, into the folder of the run.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np

import m3d_render

from . import paths
from .child import RunError, run
from .result import Aim, Result, alternate, middle, spread
from .workshop import HERE, Workshop

STEP, FINE_STEP, DISTANCE, AT = "50", "1", "25000", "1000"  # metres


def _program(shop: Workshop) -> Path:
    """The Rust program of bench/atm-refraction, built; a copy, since cargo writes beside what it builds."""
    source = shop.folder / "atm-refraction"
    shutil.copytree(HERE / "atm-refraction", source, dirs_exist_ok=True)
    command = ["cargo", "build", "--release", "--quiet", "--target-dir", source / "target"]
    done = subprocess.run(command, cwd=source, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RunError(f"atm-refraction can not be built:\n{done.stderr[-2000:]}")
    return source / "target" / "release" / "atm-paths"


def picture(shop: Workshop) -> list[Result]:
    """Our whole mirage picture of 320 x 200, one thread, against that many of its rays without a picture."""
    ir = shop.ir("small")
    scene = m3d_render.prepare(ir)

    def ours() -> float:
        started = time.process_time()
        scene.render(threads=1)
        return time.process_time() - started

    theirs: list[float] = []
    note = "`--with-atm-raytracer` fetches, builds and measures it"
    if shop.fetch:
        program, eye = _program(shop), repr(ir.scene.view.eye[2])
        profile, every, column = (shop.folder / f"atm-{name}.f64" for name in ("profile", "slopes", "column"))
        np.stack([ir["profile"]["elevation"], ir["profile"]["temperature"]], 1).tofile(profile)
        slopes = paths.slopes(ir)
        slopes.tofile(every)
        slopes[:: ir.scene.view.width].tofile(column)

        def heights(step: str) -> list[float | None]:
            return json.loads(run([program, profile, column, eye, DISTANCE, step, AT]).output)["heights"]

        mine = alternate(shop.repeats, ours)[0]
        theirs = [run([program, profile, every, eye, DISTANCE, STEP, AT]).cpu for _ in range(min(shop.repeats, 2))]
        apart = [abs(a - b) for a, b in zip(heights(STEP), heights(FINE_STEP), strict=True) if a and b]
        note = (
            f"theirs are the rays alone, in {len(theirs)} runs; at {AT} m they lie up to {max(apart):.3f} m from its "
            f"own with steps of {FINE_STEP} m"
        )
    else:
        mine = alternate(shop.repeats, ours)[0]
    return [
        Result(
            "atm",
            "mirage picture with a ray per pixel, merman scene, 320 x 200, one thread",
            f"atm-refraction 0.6.1 (atm-raytracer's engine), RK4, {STEP} m steps, 25 km",
            "s",
            middle(mine),
            middle(theirs) if theirs else None,
            Aim(0.01),
            f"{spread(mine)} s; {note}",
            missing="not measured",
        )
    ]
