"""Rows about the compiler: what starting it costs, and a text of 34 MB."""

from __future__ import annotations

import sys
from functools import partial
from pathlib import Path

from . import povray, scenes
from .child import Run, run
from .result import MEGABYTE, Aim, Result, alternate, middle, spread
from .workshop import Workshop


def start(shop: Workshop) -> list[Result]:
    """`m3dc --dump` of a small scene, the whole process, against a Python that imports NumPy and ends."""
    scene = shop.scene("small")
    ours, theirs = alternate(
        4 * shop.repeats,
        lambda: run([shop.command("m3dc"), "--dump", scene]).wall,
        lambda: run([sys.executable, "-c", "import numpy"]).wall,
    )
    return [
        Result(
            "dump-small",
            "`m3dc --dump`, merman scene, whole process",
            "`python -c 'import numpy'`",
            "s",
            middle(ours),
            middle(theirs),
            Aim(1.6),
            f"{len(ours)} runs each in turn; ours {spread(ours)} s, theirs {spread(theirs)} s",
        )
    ]


def terrain(shop: Workshop) -> list[Result]:
    """`m3dc` from the text of the million triangles to its .m3ir, against POV-Ray's parse of the same."""
    scene, output = shop.scene("terrain"), shop.folder / "terrain.m3ir"

    def ours() -> Run:
        return run([shop.command("m3dc"), "-o", output, scene])

    theirs: list[povray.Rendered] = []
    size = ""
    if povray.program():
        translated = shop.povray_scene("terrain", False)
        size = f"; POV-Ray's has {translated.stat().st_size / MEGABYTE:.1f} MB"
        runs, theirs = alternate(
            shop.repeats, ours, lambda: povray.render(translated, shop.folder / "parse.ppm", 16, 10)
        )
    else:
        (runs,) = alternate(shop.repeats, ours)
    cpu = [r.cpu for r in runs]
    note = (
        f"{scene.stat().st_size / MEGABYTE:.1f} MB of text; processor seconds of the whole process, reading and "
        f"writing included ({spread(cpu)} s; {middle(r.wall for r in runs):.2f} s by the clock){size}"
    )
    return [
        Result(
            "compile-terrain",
            "`m3dc`, 1,000,000 triangles",
            "POV-Ray 3.7, its parse",
            "s",
            middle(cpu),
            middle(t.parse for t in theirs) if theirs else None,
            Aim(0.2),
            note,
        ),
        Result(
            "compile-terrain-memory",
            "the same, largest memory",
            "POV-Ray 3.7, same scene at 16 x 10",
            "MB",
            middle(r.peak / MEGABYTE for r in runs),
            middle(t.peak / MEGABYTE for t in theirs) if theirs else None,
            Aim(1.0),
        ),
    ]


_COMPILE = "import sys, m3dc; m3dc.compile(open(sys.argv[1], 'rb').read())"


def hostile(shop: Workshop) -> list[Result]:
    """Texts that are made to cost much, against a sound scene of as many bytes."""
    ordinary = shop.scene("many")
    places: dict[str, Path] = {}
    for number, (what, text) in enumerate(scenes.HOSTILE.items()):
        places[what] = shop.folder / f"hostile-{number}.m3d"
        places[what].write_text(text())

    def cost(scene: Path) -> float:
        return run([sys.executable, "-c", _COMPILE, scene]).cpu

    theirs, *ours = alternate(1, lambda: cost(ordinary), *(partial(cost, place) for place in places.values()))
    costs = dict(zip(places, (middle(seconds) for seconds in ours), strict=True))
    dearest = max(costs, key=lambda what: costs[what])
    return [
        Result(
            "compile-hostile",
            f"compiling {dearest}: the dearest of {len(costs)} hostile texts",
            "the same of 4,000 solids, as many bytes",
            "s",
            costs[dearest],
            middle(theirs),
            Aim(5.0),
            "; ".join(f"{what} {seconds:.2f} s" for what, seconds in costs.items()),
        )
    ]
