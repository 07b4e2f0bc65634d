"""The kernel on any IR: a scene of a few shapes, some of its numbers exchanged for others.

An input is JSON: the scene's text, the changes to its IR, and the options of the picture. Whatever they are, the scene
is refused in words or rendered; no value of the picture or of an extra output is something else than a number; and the
picture is the same from a kernel made anew, with any number of threads, with extra outputs or without, and row by row
or column by column. A rendering that takes too long is cancelled, which must be heard at once.
"""

from __future__ import annotations

import json
import random
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import m3dc
from m3d_render import Cancelled, SceneError, prepare
from m3d_render.rendering import LAYERS, Prepared
from m3dc.ir import TABLES, SceneIR

from . import repeating
from .scenes import Scenes

SUFFIX = ".json"
CASES = 60

# A case is cancelled after this, and the kernel must have heard it this soon.
PATIENCE_SECONDS, HEARD_SECONDS = 0.5, 1.0

SCALES = (1.0, 1.0, 1.0, 1.0, 1e-6, 1e3, 1e9, 1e12, 1e16, 1e18)
NUMBERS = (
    0.0, 0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1e-12, 1e-300, 5e-324, 1e12, 1e18, -1e20, 1e38, 1e75, 1e150, 1e300,
    float("inf"), float("-inf"), float("nan"),
)  # fmt: skip
WHOLE = (0, 1, -1, 2, 3, 7, 255, 100_000, 2**31 - 1, -(2**31))
TEXTURES = (
    "CHECKER { }", "MARBLE { COLORS { 0 0.5 < 1, 0, 0 > < 1, 0, 0 > } }", "WOOD { SQUEEZE 1 }", "SPOTTED { SCALE 2 }",
    "SNOW { ELEVATION 0.5 }", "GRADIENT { TURBULENCE 1 }", "BUMPS { TURBULENCE 1 }", "UBLEND { COLOR < 0, 1, 0 > }",
    "RIPPLES { WAVE { CENTER < 0, 0, 0 > AMPLITUDE 1 FREQ 1 } }", "CLOUDS { TURBULENCE 1 }", "GRANITE { TURBULENCE 1 }",
)  # fmt: skip
SAID = (
    "view.eye.0", "view.eye.2", "view.normal.1", "view.distance", "view.right.0", "view.up.2", "view.aspect",
    "ambient.samples", "ambient.depth", "ambient.intensity", "haze.density", "haze.intensity", "mirage.segments",
    "mirage.distance", "mirage.elevation", "sky.radius", "sky.sun", "sky.overcast", "log_scale", "extent.minimum.2",
)  # fmt: skip


def make(chance: random.Random) -> bytes:
    text = Scenes(chance).scene() if chance.random() < 0.2 else World(chance).scene()
    changes: list[list[Any]] = []
    for _ in range(chance.choice((0, 0, 0, 1, 1, 2, 5))):
        if chance.random() < 0.3:
            changes.append([chance.choice(SAID), chance.choice(NUMBERS)])
        else:
            table = chance.choice([name for name in TABLES if name not in ("normals", "color_ranges", "waves")])
            column = chance.choice([name for name in TABLES[table] if name not in ("span", "offset")])
            value = chance.choice(NUMBERS if TABLES[table][column].dtype == "f8" else WHOLE)
            changes.append([f"{table}.{column}", chance.random(), chance.random(), value])
    options = {
        "width": chance.randint(1, 9), "height": chance.randint(1, 7), "samples": chance.choice((1, 1, 2)),
        "shadows": chance.random() < 0.5, "refract_reflections": chance.random() < 0.5,
        "straight": chance.random() < 0.2, "depth": chance.choice((1, 2, 5, 1_000_000)),
        "normalize": chance.random() < 0.1,
    }  # fmt: skip
    return json.dumps({"scene": text, "changes": changes, "options": options}).encode()


def check(data: bytes) -> str | None:
    case = json.loads(data)
    ir = changed(m3dc.compile(case["scene"]).ir, case["changes"])
    options: dict[str, Any] = case["options"]
    try:
        prepared = prepare(ir)
        start = time.monotonic()
        whole = rendered(prepared, threads=1, **options)
        if whole is None:
            return None
        if time.monotonic() - start > PATIENCE_SECONDS / 4:
            return unlike(whole, "anew", lambda: rendered(prepare(ir), threads=2, **options))
        return divided(ir, prepared, whole, options)
    except (SceneError, MemoryError):
        return None
    except LateError as late:
        return str(late)


run = repeating(make, check)


class LateError(Exception):
    """A rendering went on long after it was cancelled."""


def divided(ir: SceneIR, prepared: Prepared, whole: np.ndarray, options: dict[str, Any]) -> str | None:
    """What differs when the picture is made in other ways."""
    if not np.all((whole >= 0) & (whole <= 1)):
        return "a value of the picture is not from 0 to 1"
    with_all = prepared.render(threads=2, aov=tuple(LAYERS), **options)
    for name, values in with_all.layers.items():
        if np.isnan(values).any():
            return f"{name} is no number somewhere"
    ways: dict[str, Callable[[], np.ndarray | None]] = {
        "anew": lambda: rendered(prepare(ir), threads=2, **options),
        "with extra outputs": lambda: with_all.picture,
        **{f"with {name}": lambda name=name: prepared.render(aov=[name], **options).picture for name in LAYERS},
    }
    if not options["normalize"]:
        height, width = whole.shape[:2]
        parts = [[(y, x, y, x) for x in range(width)] for y in range(height)]
        ways["pixel by pixel"] = lambda: np.vstack(
            [np.hstack([prepared.render(region=part, **options).picture for part in row]) for row in parts]
        )
        ways["row by row"] = lambda: np.vstack([prepared.render(rows=(y, y), **options).picture for y in range(height)])
    for how, make_it in ways.items():
        found = unlike(whole, how, make_it)
        if found:
            return found
    return None


def unlike(whole: np.ndarray, how: str, make_it: Callable[[], np.ndarray | None]) -> str | None:
    picture = make_it()
    if picture is None or picture.tobytes() == whole.tobytes():
        return None
    return f"the picture made {how} differs in {(picture != whole).any(axis=2).sum()} pixels"


def rendered(prepared: Prepared, **options: Any) -> np.ndarray | None:
    """The picture; None if it takes too long."""
    asked: list[float] = []
    end = time.monotonic() + PATIENCE_SECONDS

    def cancel() -> bool:
        if time.monotonic() < end:
            return False
        asked.append(time.monotonic())
        return True

    try:
        return prepared.render(cancel=cancel, **options).picture
    except Cancelled:
        took = time.monotonic() - asked[0]
        if took > HEARD_SECONDS:
            raise LateError(f"a cancelled rendering went on for {took:.1f} s") from None
        return None


def changed(ir: SceneIR, changes: list[list[Any]]) -> SceneIR:
    """The IR with numbers exchanged: by the path of what the scene says once, or by a table's column and shares of its
    rows and of an entry's numbers."""
    for where, *how in changes:
        if len(how) == 1:
            scene = _exchanged(ir.scene, where.split("."), how[0])
            ir = SceneIR(scene, ir.tables, ir.source)
        else:
            table, column = where.split(".")
            values = ir[table][column]
            if values.size:
                entry = values[int(how[0] * len(values))].reshape(-1)
                values = values.copy().reshape(len(values), -1)
                with np.errstate(all="ignore"):
                    values[int(how[0] * len(values)), int(how[1] * len(entry))] = how[2]
                ir.tables[table][column] = values.reshape(ir[table][column].shape)
    return ir


def _exchanged(of: Any, path: list[str], value: float) -> Any:
    if not path:
        return value
    if of is None:
        return None
    if path[0].isdigit():
        return tuple(value if i == int(path[0]) else x for i, x in enumerate(of))
    old = getattr(of, path[0])
    if isinstance(old, int):
        value = int(value) if abs(value) < 2**40 else 2**40  # also for what is no number
    return of._replace(**{path[0]: _exchanged(old, path[1:], value)})


class World:
    """Scenes in which much lies exactly upon something else: of few coordinates, at one scale, level looks, and eyes on
    the boundaries of the air's layers."""

    def __init__(self, chance: random.Random) -> None:
        self.chance = chance
        self.scale = chance.choice(SCALES)
        self.ends = -20 * self.scale, 20 * self.scale

    def scene(self) -> str:
        chance = self.chance
        solids = [self.solid() for _ in range(chance.randint(1, 4))]
        light = chance.choice(
            ("", "LIGHT { }", f"LIGHT {{ SOURCE {{ POINT FROM {self.point()} }} }}", f"LIGHT {{ {self.ball()} }}")
        )
        return f"SCENE {{ {self.air()} {self.surroundings()} VIEW {{ {self.view()} }} }} {light} {' '.join(solids)}"

    def number(self) -> float:
        return self.chance.choice((-3.0, -1.0, -0.5, 0.0, 0.0, 0.1, 1.0, 2.0, 10.0, round(self.chance.gauss(0, 5), 3)))

    def point(self) -> str:
        numbers = (self.scale * self.number() for _ in range(3))
        return f"< {', '.join(_written(number) for number in numbers)} >"

    def view(self) -> str:
        x, y, z = (self.scale * self.number() for _ in range(3))
        level = f"< {_written(x + self.scale)}, {_written(y)}, {_written(z)} >"
        target = level if self.chance.random() < 0.5 else self.point()
        return (
            f"FROM < {_written(x)}, {_written(y)}, {_written(z)} > TO {target} FOV {self.chance.choice((1, 45, 120))}"
        )

    def air(self) -> str:
        chance = self.chance
        if chance.random() < 0.4:
            return ""
        heights = sorted({self.scale * self.number() for _ in range(chance.randint(2, 6))} | {*self.ends, 0.0})
        steps = "  ".join(f"{_written(z)} {chance.choice((0, 5, 10, 20, 20.5, -200))}" for z in heights)
        segments = chance.choice((1, 3, 500, 100_000, 2_147_483_647))
        distance = chance.choice((0.0, 1.0, 20.0, 1e5, 1e20))
        return f"MIRAGE {{ SEGMENTS {segments} DISTANCE {_written(distance)} PROFILE {{ {steps} }} }}"

    def surroundings(self) -> str:
        return self.chance.choice(
            ("", "AMBIENT { NSAMPLES 2 DEPTH 3 }", "HAZE { DENSITY 0.01 }", "SKY { SUN { } }", "BACKGROUND < 0, 0, 1 >")
        )

    def solid(self) -> str:
        chance = self.chance
        shapes = " ".join(self.shape() for _ in range(chance.randint(1, 3)))
        mirror = chance.choice(("", "SPECULAR 1 HARD 1", "SPECULAR 0.5 HARD 0.5 FUZZ 0.1"))
        texture = chance.choice(("", f"TEXTURE {{ {chance.choice(TEXTURES)} }}"))
        turn = chance.choice(("", "", "TRANSFORM { ROTX 90 }", "TRANSFORM { SCALE < 1, 2, 1 > ROTZ 30 TRANSX 1 }"))
        return f"SOLID {{ {shapes} SURFACE {{ {mirror} {texture} }} {turn} }}"

    def ball(self) -> str:
        radius = _written(self.scale * (abs(self.number()) + 0.1))
        return f"SPHERE {{ CENTER {self.point()} RADIUS {radius} }}"

    def shape(self) -> str:
        corners = [self.point() for _ in range(4)]
        planar = " ".join(f"VERTEX{i + 1} {corner}" for i, corner in enumerate(corners[:3]))
        return self.chance.choice(
            (
                self.ball(),
                *(f"{keyword} {{ {planar} }}" for keyword in ("PLANE", "TRIANGLE", "RECTANGLE")),
                f"POLYGONS {{ VERTICES {{ 4 {' '.join(corners)} }} FACETS {{ 4 0 1 2 0 2 3 0 3 1 1 2 3 }} }}",
            )
        )


def _written(number: float) -> str:
    return f"{max(-1e20, min(1e20, number)):.12g}"
