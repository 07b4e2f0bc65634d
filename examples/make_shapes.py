"""Writes cylinder-and-cone.m3d and terrain.m3d: shapes that nobody types by hand.

    python examples/make_shapes.py

A cylinder with normals for smooth shading, a cone with flat facets, and a grid of hills. After Robinson 1993,
Appendix E.
"""

import math
from pathlib import Path

HERE = Path(__file__).parent
SLICES = 16


def vector(*components: float) -> str:
    return "< " + ", ".join(f"{component + 0.0:.4f}" for component in components) + " >"


def table(keyword: str, *head: int, rows: list[str], indent: int = 4) -> str:
    rows = [f"    {row}" for row in (" ".join(str(number) for number in head), *rows)]
    return "\n".join(" " * indent + line for line in (keyword, "{", *rows, "}"))


def on_circle(slice_: int) -> tuple[float, float]:
    angle = 2 * math.pi * slice_ / SLICES
    return round(math.cos(angle), 10), round(math.sin(angle), 10)


def cylinder() -> str:
    """Radius 1, from z = 0 to z = 1 about the z axis, open at both ends. The normals point outwards."""
    circle = [on_circle(i) for i in range(SLICES)]
    vertices = [vector(x, y, z) for x, y in circle for z in (1, 0)]
    normals = [vector(x, y, 0) for x, y in circle]
    facets: list[str] = []
    for i in range(SLICES):
        j = (i + 1) % SLICES
        facets.append(f"{2 * i} {2 * i + 1} {2 * j + 1}  {normals[i]} {normals[i]} {normals[j]}")
        facets.append(f"{2 * i} {2 * j + 1} {2 * j}  {normals[i]} {normals[j]} {normals[j]}")
    return table("VERTICES", len(vertices), rows=vertices) + "\n" + table("SFACETS", len(facets), rows=facets)


def cone() -> str:
    """Apex at z = 1, base of radius 1 at z = 0, open below."""
    vertices = [vector(0, 0, 1), *(vector(*on_circle(i), 0) for i in range(SLICES))]
    facets = [f"0 {i + 1} {(i + 1) % SLICES + 1}" for i in range(SLICES)]
    return table("VERTICES", len(vertices), rows=vertices) + "\n" + table("FACETS", len(facets), rows=facets)


CYLINDER_AND_CONE = """\
/* Surfaces of revolution: a smooth cylinder, the same with flat facets, and a cone. Made by make_shapes.py. */

VARIABLES {{ POLYGONS cylinder, cone; SURFACE clay; }}

SCENE
{{
    SHADOWS
    LOGSCALE 5
    BACKGROUND < 0.8, 0.85, 0.9 >
    AMBIENT {{ INTENSITY 0.4 COLOR < 1, 1, 1 > }}
    VIEW {{ FROM < 12, 0, 6 > TO < 0, 0, 1.2 > FOV 40 WIDTH 320 HEIGHT 200 }}
}}

LIGHT {{ SOURCE {{ FROM < 10, -10, 14 > TO < 0, 0, 0 > }} }}

cylinder =
{{
{cylinder}
}}

cone =
{{
{cone}
}}

clay = {{ COLOR < 0.8, 0.45, 0.3 > SPECULAR 0.3 ROUGH 0.3 HARD 0 AMBIENT 0.5 }}

SOLID
{{
    POLYGONS cylinder {{ PHONG TRANSFORM {{ SCALE < 1, 1, 2.5 > }} }}
    SURFACE clay
    TRANSFORM {{ TRANSY -3 }}
}}

SOLID {{ POLYGONS cylinder {{ TRANSFORM {{ SCALE < 1, 1, 2.5 > }} }} SURFACE clay }}
SOLID {{ POLYGONS cone {{ TRANSFORM {{ SCALE < 1.2, 1.2, 3 > }} }} SURFACE clay TRANSFORM {{ TRANSY 3 }} }}
SOLID {{ PLANE {{ }} SURFACE {{ COLOR < 0.7, 0.7, 0.7 > SPECULAR 0 AMBIENT 0.4 }} }}
"""


def height(x: float, y: float) -> float:
    ridge = math.exp(-(((x - 4) / 3) ** 2 + ((y - 1) / 4) ** 2))
    knoll = math.exp(-(((x + 3) / 2) ** 2 + ((y + 4) / 2.5) ** 2))
    return 3.2 * ridge + 1.8 * knoll + 0.25 * math.sin(1.3 * x) * math.cos(0.9 * y)


TERRAIN = """\
/* Hills, a grid of {size} by {size} points, shaded smoothly. Made by make_shapes.py. */

SCENE
{{
    SHADOWS
    LOGSCALE 5
    AMBIENT {{ INTENSITY 0.4 COLOR < 1, 1, 1 > }}
    SKY {{ INTENSITY 0.3 HORIZONCOLOR < 0.7, 0.8, 1 > SUN {{ AZIMUTH -60 ZENITH 60 }} }}
    VIEW {{ FROM < 22, -6, 9 > TO < -1, 0, 0 > FOV 45 WIDTH 320 HEIGHT 200 }}
}}

SOLID
{{
    TERRAIN
    {{
        PHONG
{vertices}
    }}
    SURFACE {{ COLOR < 0.45, 0.55, 0.3 > SPECULAR 0 AMBIENT 0.4 }}
}}
"""


def terrain(size: int = 33, extent: float = 10.0) -> str:
    steps = [extent * (2 * i / (size - 1) - 1) for i in range(size)]
    rows = ["  ".join(vector(x, y, height(x, y)) for y in steps) for x in steps]
    return TERRAIN.format(size=size, vertices=table("VERTICES", size, size, rows=rows, indent=8))


def main() -> None:
    text = CYLINDER_AND_CONE.format(cylinder=cylinder(), cone=cone())
    (HERE / "cylinder-and-cone.m3d").write_text(text, encoding="utf-8")
    (HERE / "terrain.m3d").write_text(terrain(), encoding="utf-8")


if __name__ == "__main__":
    main()
