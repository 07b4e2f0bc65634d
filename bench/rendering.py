"""Rows about pictures: straight against POV-Ray and Embree, curved against straight, two threads against one.

Where the reference gives processor seconds of tracing alone, so do we: the processor time of the call that renders
with one thread a scene that is already in the kernel, as POV-Ray's "Trace Time" leaves out its parsing. What the
whole command takes, from text to picture, is a row of its own.
"""

from __future__ import annotations

import json
import time
from functools import partial
from itertools import pairwise

import numpy as np

import m3d_render
from m3d_render.rendering import Prepared, usable_threads
from m3dc.ir import SceneIR, m3ir

from . import povray
from .child import Run, run
from .result import MEGABYTE, Aim, Result, alternate, middle, spread
from .workshop import Workshop

POVRAY = "POV-Ray 3.7, +WT1, its tracing"

LEAST_OF = 3
"""So many pictures of eye rays alone make a sample, ours as Embree's: the least of them counts."""

BANDS = 8
"""Parts of a picture that are measured by turns, curved and straight, so that a busy moment falls on both alike."""


def _seconds(scene: Prepared, *, straight: bool, shadows: bool, rows: tuple[int, int] | None = None) -> float:
    """Processor seconds of a picture, or of some of its rows, with one thread."""
    started = time.process_time()
    scene.render(straight=straight, shadows=shadows, rows=rows, threads=1)
    return time.process_time() - started


def straight(shop: Workshop, name: str, shadows: bool, work: str, aim: Aim) -> list[Result]:
    """A straight picture against POV-Ray's of the same geometry, and how far their silhouettes agree."""
    ir = shop.ir(name)
    view = ir.scene.view
    scene = m3d_render.prepare(ir)
    ours = partial(_seconds, scene, straight=True, shadows=shadows)
    theirs: list[povray.Rendered] = []
    if povray.program():
        translated, picture = shop.povray_scene(name, shadows), shop.folder / f"{name}.ppm"
        mine, theirs = alternate(
            shop.repeats, ours, lambda: povray.render(translated, picture, view.width, view.height)
        )
    else:
        (mine,) = alternate(shop.repeats, ours)
    rays = scene.render(straight=True, shadows=shadows, threads=1).rays
    counts = f"{rays.eye + rays.reflected:,} rays, {rays.shadow:,} shadow rays"
    note = f"{counts}, {spread(mine)} s; build {scene.seconds:.2f} s"
    if theirs:
        note += (
            f"; POV-Ray {theirs[0].rays:,} rays, {theirs[0].shadow_tests:,} shadow tests; "
            f"silhouettes differ in {_apart(shop, name):,} of {view.width * view.height:,} pixels"
        )
    return [
        Result(
            f"{name}{'-shadows' if shadows else ''}",
            work,
            POVRAY,
            "s",
            middle(mine),
            middle(t.trace for t in theirs) if theirs else None,
            aim,
            note,
        )
    ]


def _apart(shop: Workshop, name: str) -> int:
    """In how many pixels one program sees an object and the other does not."""
    ir = povray.silhouette(shop.ir(name))
    view = ir.scene.view
    scene, picture = shop.folder / f"{name}-silhouette.pov", shop.folder / f"{name}-silhouette.ppm"
    povray.write(ir, scene, shadows=False)
    povray.render(scene, picture, view.width, view.height)
    theirs = povray.read_picture(picture)[..., 0] > 127
    ours = m3d_render.render(ir, straight=True)[..., 0] > 0.5
    return int(np.count_nonzero(ours != theirs))


def whole(shop: Workshop) -> list[Result]:
    """The commands as they are typed: text in, picture out, with shadows."""
    scene, picture = shop.scene("terrain"), shop.folder / "terrain.png"

    def ours() -> Run:
        return run([shop.command("m3d-render"), scene, "-o", picture, "--straight", "--shadows", "--stats"])

    theirs: list[povray.Rendered] = []
    if povray.program():
        translated = shop.povray_scene("terrain", True)
        mine, theirs = alternate(
            shop.repeats, ours, lambda: povray.render(translated, shop.folder / "terrain.ppm", 1280, 800)
        )
    else:
        (mine,) = alternate(shop.repeats, ours)
    compiled = shop.folder / "terrain.m3ir"
    m3ir.write(shop.ir("terrain"), compiled)
    from_ir = run([shop.command("m3d-render"), compiled, "-o", picture, "--straight", "--shadows"])
    stages = json.loads(mine[-1].output)["seconds"]
    return [
        Result(
            "terrain-whole",
            "`m3d-render`, the terrain from text to picture, shadows, all threads' processor time",
            "`povray`, whole process",
            "s",
            middle(r.cpu for r in mine),
            middle(t.cpu for t in theirs) if theirs else None,
            None,
            f"{middle(r.wall for r in mine):.2f} s by the clock, last run: "
            + ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in stages.items()),
        ),
        Result(
            "terrain-memory",
            "the same, largest memory",
            "`povray`, whole process",
            "MB",
            middle(r.peak / MEGABYTE for r in mine),
            middle(t.peak / MEGABYTE for t in theirs) if theirs else None,
            Aim(1.0),
            f"from the compiled .m3ir: {from_ir.peak / MEGABYTE:.0f} MB",
        ),
    ]


def primary(shop: Workshop) -> list[Result]:
    """Eye rays alone on the terrain: no light, no mirror, every object the same white."""
    ir = povray.silhouette(shop.ir("terrain"))
    view = ir.scene.view
    scene = m3d_render.prepare(ir)
    count = view.width * view.height

    def ours() -> float:
        return min(_seconds(scene, straight=True, shadows=False) for _ in range(LEAST_OF))

    program = shop.c_program("embree/primary.c", "embree3", "m")
    theirs: list[float] = []
    note = ""
    if program is None:
        (mine,) = alternate(shop.repeats, ours)
    else:
        inputs = _embree_inputs(shop, ir)

        def embree() -> float:
            ended = json.loads(run([program, *inputs, str(view.width), str(view.height), str(LEAST_OF)]).output)
            found[:] = [ended["hits"], ended["build"]]
            return float(ended["seconds"])

        found: list[float] = []
        mine, theirs = alternate(shop.repeats, ours, embree)
        note = f"; Embree hits {found[0] / count:.1%}, builds in {found[1]:.2f} s"
    hit = float((m3d_render.render(ir, straight=True)[..., 0] > 0.5).mean())
    return [
        Result(
            "terrain-primary",
            "eye rays alone, the terrain",
            "Embree 3, single rays, coherent, single precision",
            "M rays/s a thread",
            count / middle(mine) / 1e6,
            count / middle(theirs) / 1e6 if theirs else None,
            Aim(0.6, least=True),
            f"{hit:.1%} hit, {spread(mine)} s{note}; ours makes the picture's pixels too",
            missing="not installed (libembree-dev)",
        )
    ]


def _embree_inputs(shop: Workshop, ir: SceneIR) -> list[str]:
    """The files that embree/primary.c reads."""
    view = ir.scene.view
    up = np.array(view.up) * (view.height / view.width * view.aspect)
    spheres = np.column_stack([ir["spheres"]["center"], ir["spheres"]["radius"]])
    camera = np.concatenate([view.eye, np.array(view.normal) * view.distance, view.right, up])
    names: list[str] = []
    for name, values in (
        ("vertices", ir["vertices"]["position"]),
        ("facets", ir["facets"]["vertex"].astype(np.uint32)),
        ("spheres", spheres),
        ("camera", camera),
    ):
        path = shop.folder / f"embree-{name}.bin"
        np.ascontiguousarray(values).tofile(path)
        names.append(str(path))
    return names


def mirage(shop: Workshop, name: str, shadows: bool, work: str) -> list[Result]:
    """The picture with curved rays against the same with straight ones."""
    scene = m3d_render.prepare(shop.ir(name))
    height = scene.ir.scene.view.height
    edges = [band * height // BANDS for band in range(BANDS + 1)]
    samples = [
        alternate(
            shop.repeats,
            partial(_seconds, scene, straight=False, shadows=shadows, rows=(top, end - 1)),
            partial(_seconds, scene, straight=True, shadows=shadows, rows=(top, end - 1)),
        )
        for top, end in pairwise(edges)
    ]
    # Of each kind of picture its bands' samples: a sample of the whole is the sum of one of each band.
    curved, plain = ([sum(taken) for taken in zip(*bands, strict=True)] for bands in zip(*samples, strict=True))
    rays = scene.render(shadows=shadows, threads=1).rays
    return [
        Result(
            f"mirage-{name}{'-shadows' if shadows else ''}",
            work,
            "our straight picture",
            "s",
            sum(middle(bent) for bent, _ in samples),
            sum(middle(straight) for _, straight in samples),
            Aim(2.0),
            f"{rays.arcs / max(rays.mirage, 1):.1f} arcs a ray made, {spread(curved)} s against {spread(plain)} s",
        )
    ]


def threads(shop: Workshop) -> list[Result]:
    """How much faster two threads are, by the clock: on a busy machine less than they could be."""
    scene = m3d_render.prepare(shop.ir("terrain"))

    def wall(count: int) -> float:
        started = time.perf_counter()
        scene.render(straight=True, shadows=True, threads=count)
        return time.perf_counter() - started

    two, one = alternate(shop.repeats, partial(wall, 2), partial(wall, 1))
    return [
        Result(
            "threads-terrain",
            "speed of two threads, the terrain, shadows",
            "one thread",
            "pictures/s",
            1.0 / middle(two),
            1.0 / middle(one),
            Aim(1.8, least=True),
            f"by the clock: {spread(two)} s with two, {spread(one)} s with one; {usable_threads()} processors usable",
        )
    ]
