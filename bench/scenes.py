"""The scenes that are measured: the same text on every machine and in every run, never kept in the repository.

python -m bench.scenes FOLDER        writes all of them: merman.m3d, small.m3d, terrain.m3d (34 MB), long.m3d
"""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

EXAMPLE = Path(__file__).resolve().parent.parent / "examples" / "merman.m3d"

GRID = 1001, 501  # vertices of the terrain along x and along y: exactly 1,000,000 facets
LENGTH, BREADTH = 4000.0, 2000.0  # metres
SPHERES = 100


def merman() -> str:
    """The merman example as a picture of 1280 x 800 pixels with shadows: few objects, many pixels, a long MIRAGE."""
    text = EXAMPLE.read_text()
    for statement, value in (("WIDTH", "1280"), ("HEIGHT", "800"), ("REGION", "0, 0, 799, 1279")):
        text = re.sub(rf"\b{statement}\b[^\n<A-Z]*\d", f"{statement} {value}", text)
    return re.sub(r"\bSCENE\s*{", "SCENE\n{\n  SHADOWS", text, count=1)


def small() -> str:
    """The merman example as it stands, for what a command costs before it does much."""
    return EXAMPLE.read_text()


def heights(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """The terrain's elevation in metres, between 0 and 120: hills on hills, each half as wide and half as high."""
    total = np.zeros(np.broadcast(x, y).shape)
    for octave in range(6):
        wave = 2.0 * math.pi * 2.0**octave / 1600.0
        turn = 1.1 * octave
        along, across = x * math.cos(turn) + y * math.sin(turn), y * math.cos(turn) - x * math.sin(turn)
        total += 0.5**octave * np.sin(wave * along + octave) * np.cos(wave * across + 2 * octave)
    return 60.0 + 60.0 * np.tanh(total)


def terrain(*, mirage: bool = True, grid: tuple[int, int] = GRID) -> str:
    """A landscape of 1,000,000 triangles, written out as POLYGONS, with 100 mirror spheres on it, 1280 x 800."""
    columns, rows = grid
    x = -np.linspace(0.0, LENGTH, columns)[:, None]
    y = np.linspace(-BREADTH / 2, BREADTH / 2, rows)[None, :]
    vertices = np.stack(np.broadcast_arrays(x, y, heights(x, y)), -1).reshape(-1, 3)
    number = np.arange(columns * rows).reshape(columns, rows)
    near, right, far, left = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    facets = np.stack([np.stack([near, right, far], -1), np.stack([near, far, left], -1)], 2).reshape(-1, 3)
    return "\n".join(
        [
            _SCENE.format(mirage=_MIRAGE if mirage else ""),
            "SOLID",
            "{",
            "  POLYGONS",
            "  {",
            "    VERTICES",
            "    {",
            f"      {len(vertices)}",
            *map("<%.3f,%.3f,%.3f>".__mod__, map(tuple, vertices.tolist())),
            "    }",
            "    FACETS",
            "    {",
            f"      {len(facets)}",
            *map("%d %d %d".__mod__, map(tuple, facets.tolist())),
            "    }",
            "  }",
            "  SURFACE { COLOR <0.35, 0.45, 0.25> AMBIENT 0.3 SPECULAR 0 HARD 0 ROUGH 1 }",
            "}",
            "SOLID",
            "{",
            *_spheres(),
            "  SURFACE { COLOR <0.8, 0.8, 0.85> AMBIENT 0.2 SPECULAR 1 HARD 1 ROUGH 0.2 METALLIC 1 REFINDEX 1.4 }",
            "}",
            "",
        ]
    )


def _spheres() -> list[str]:
    """Spread evenly and without a pattern: the fractional parts of multiples of two irrational numbers."""
    step = np.arange(1, SPHERES + 1)
    x = -LENGTH * (0.05 + 0.6 * np.modf(step * 0.7548776662466927)[0])
    y = BREADTH * 0.6 * (np.modf(step * 0.5698402909980532)[0] - 0.5)
    radius = 5.0 + 15.0 * np.modf(step * 0.6180339887498949)[0]
    z = heights(x, y) + radius
    return [
        f"  SPHERE {{ CENTER <{cx:.2f}, {cy:.2f}, {cz:.2f}> RADIUS {r:.2f} }}"
        for cx, cy, cz, r in zip(x, y, z, radius, strict=True)
    ]


_SCENE = """\
SCENE
{{
  VIEW
  {{
    FROM <0, 0, 181>
    TO <-1500, 0, -140>
    FOV 45
    WIDTH 1280
    HEIGHT 800
    ASPECT 1
    REGION 0, 0, 799, 1279
  }}
  DEPTH 3
  AMBIENT {{ INTENSITY 0.3 COLOR <1, 1, 1> }}
  SKY
  {{
    RADIUS 1.0e8
    INTENSITY 0.9
    ZENITHCOLOR <0.1, 0.2, 0.9>
    HORIZONCOLOR <0.5, 0.7, 0.9>
    SUN {{ INTENSITY 1 AZIMUTH 40 ZENITH 65 COLOR <1, 1, 1> }}
  }}
{mirage}}}"""


def _profile() -> str:
    """Twenty-five temperatures from 0 to 240 m: an inversion of 7 degrees about 120 m over air that hardly changes."""
    elevations = np.linspace(0.0, 240.0, 25)
    temperatures = 4.0 + 3.5 * (1.0 + np.tanh((elevations - 120.0) / 25.0))
    return "\n".join(f"      {z:.1f} {t:.3f}" for z, t in zip(elevations, temperatures, strict=True))


_MIRAGE = f"""\
  MIRAGE
  {{
    DISTANCE 25000
    ELEVATION 240
    SEGMENTS 300
    PROFILE
    {{
{_profile()}
    }}
  }}
"""


def long(solids: int = 85) -> str:
    """About 2,000 lines as a person might write them: variables, copies, transforms. For the language server."""
    parts = [_LONG_HEAD]
    for n in range(solids):
        a, b = math.modf(n * 0.7548776662466927)[0], math.modf(n * 0.5698402909980532)[0]
        parts.append(
            _LONG_SOLID.format(
                n=n,
                x=round(-20 - 200 * a, 2),
                y=round(100 * (b - 0.5), 2),
                r=round(0.5 + 2 * a, 2),
                h=round(1 + 4 * b, 2),
                turn=round(360 * a, 1),
                red=round(0.2 + 0.8 * a, 3),
                green=round(0.2 + 0.8 * b, 3),
            )
        )
    return "\n".join(parts) + "\n"


_LONG_HEAD = """\
/* Many small things on a plain: a scene long enough for an editor to feel it. */
VARIABLES
{
  SURFACE matte, polished;
  POLYGONS cube;
  VECTOR white, dark;
  NUMBER little;
}

white = <1, 1, 1>
dark = <0.1, 0.1, 0.2>
little = 0.05

matte =
{
  COLOR white
  AMBIENT 0.3
  SPECULAR 0
  ROUGH 1
}

polished = matte
{
  SPECULAR 0.8
  HARD 0.6
  ROUGH 0.2
}

cube =
{
  VERTICES
  {
    8
    <1, -1, 1> <1, 1, 1> <-1, 1, 1> <-1, -1, 1>
    <1, -1, 0> <1, 1, 0> <-1, 1, 0> <-1, -1, 0>
  }
  FACETS
  {
    10
    0 4 5   0 5 1   1 5 6   1 6 2   2 6 7
    2 7 3   3 7 4   3 4 0   0 1 2   0 2 3
  }
}

SCENE
{
  VIEW { FROM <0, 0, 3> TO <-1, 0, 3> FOV 40 WIDTH 320 HEIGHT 200 }
  DEPTH 2
  AMBIENT { INTENSITY 0.3 COLOR white }
  BACKGROUND <0.2, 0.6, 0.8>
}
"""

_LONG_SOLID = """\
/* number {n} */
SOLID
{{
  SPHERE
  {{
    CENTER <{x}, {y}, {h}>
    RADIUS {r}
  }}
  POLYGONS cube
  {{
    TRANSFORM
    {{
      ROTZ {turn}
      TRANSLATE <{x}, {y}, 0>
    }}
  }}
  SURFACE polished
  {{
    COLOR <{red}, {green}, 0.4>
    AMBIENT little
  }}
}}
"""


def many() -> str:
    """4,000 solids of a sphere each: 390 KB."""
    return "\n".join(
        f"SOLID {{ SPHERE {{ CENTER < {number}, 0, 0 > RADIUS 0.5 }} SURFACE {{ COLOR < 1, 0, 0 > SPECULAR 0.5 }} }}"
        for number in range(4000)
    )


def _undeclared(count: int) -> str:
    declared = ", ".join(f"name{number}x" for number in range(count))
    used = " ".join(f"RADIUS name{number}" for number in range(count))
    return f"VARIABLES {{ NUMBER {declared}; }} SOLID {{ SPHERE {{ {used} }} }}"


HOSTILE: dict[str, Callable[[], str]] = {
    "names that are not declared": lambda: _undeclared(15_000),
    "blocks that are not closed": lambda: "SOLID { " * 48_000,
    "lines that are not closed": lambda: "SOLID {\n" * 48_000,
    "junk": lambda: "ab $ {} < 3 ; foo\n" * 21_000,
    "parts added one by one": lambda: "VARIABLES { SOLID a; } " + "a = { SPHERE { } } " * 20_000 + "SOLID a",
    "a solid copied without end": lambda: "VARIABLES { SOLID a; } a = { "
    + "SPHERE { } " * 2000
    + "} "
    + "SOLID a " * 45_000,
}
"""Texts of about as many bytes as `many`, that would cost much more if work were not bounded."""

SCENES: dict[str, Callable[[], str]] = {
    "small": small,
    "merman": merman,
    "terrain": terrain,
    "long": long,
    "many": many,
}
"""What can be made, by the name of its file."""


def make(name: str, folder: Path) -> Path:
    """The file of a scene, written anew."""
    path = folder / f"{name}.m3d"
    path.write_text(SCENES[name]())
    return path


def main() -> None:
    """Write all scenes into a folder."""
    parser = argparse.ArgumentParser(prog="python -m bench.scenes", description="Write the scenes that are measured.")
    parser.add_argument("folder", type=Path)
    folder: Path = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for name in SCENES:
        path = make(name, folder)
        print(f"{path}  {path.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
