"""Scenes for the renderer's tests, built row by row as IR, without the language.

>>> scene = SceneBuilder(eye=(10, 0, 0), target=(0, 0, 0))
>>> scene.sphere((0, 0, 0), 1, scene.solid(color=(1, 0, 0)))
>>> ir = scene.build()
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Self, TypeAlias

import numpy as np
from array_types import Floats
from numpy.typing import ArrayLike

from m3dc.ir import (
    TABLES,
    Ambient,
    Globals,
    Haze,
    LightKind,
    Mirage,
    PrimitiveKind,
    SceneIR,
    Sky,
    TextureKind,
    Triple,
    View,
    empty_tables,
)

Profile: TypeAlias = Sequence[tuple[float, float]]
"""Pairs of elevation and temperature."""
Owner: TypeAlias = tuple[str, int]
"""What a primitive belongs to: "solid" or "light", and its row."""
Corners: TypeAlias = Sequence[ArrayLike] | Floats
Rows: TypeAlias = Sequence[Sequence[float]] | Sequence[Floats] | Floats

IDENTITY = np.eye(4)
BLACK, WHITE = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)

MERMAN_PROFILE = [
    (0.0, 3.83), (0.1, 3.85), (0.6, 4.03), (0.84, 4.14), (1.1, 4.28), (1.32, 4.42), (1.55, 4.6), (1.75, 4.81),
    (1.9, 5.06), (2.0, 5.27), (2.08, 5.51), (2.15, 5.8), (2.21, 6.15), (2.25, 6.5), (2.29, 6.8), (2.35, 7.17),
    (2.41, 7.46), (2.5, 7.75), (2.64, 8.08), (2.8, 8.35), (3.05, 8.66), (3.35, 8.95), (4.1, 9.5), (5.1, 10.0),
    (6.35, 10.45), (7.6, 10.75), (9.1, 11.0), (10.35, 11.15), (11.6, 11.25), (12.9, 11.32), (14.4, 11.36),
    (16.0, 11.35), (17.9, 11.32), (19.7, 11.3),
]  # fmt: skip


def unit(vector: ArrayLike) -> Floats:
    given = np.asarray(vector, float)
    return given / np.linalg.norm(given)


def from_sun(azimuth: float, zenith: float) -> Triple:
    """Where light shines to that comes from an azimuth and a zenith angle in degrees."""
    a, z = math.radians(azimuth), math.radians(zenith)
    return (-math.sin(z) * math.cos(a), -math.sin(z) * math.sin(a), -math.cos(z))


def view(
    eye: ArrayLike, target: ArrayLike, fov: float, width: int, height: int, aspect: float = 1.0, tilt: float = 0.0
):
    """A VIEW by the formulas of the thesis's section 3.2 and the IR's conventions."""
    eye, target = np.asarray(eye, float), np.asarray(target, float)
    normal = unit(target - eye)
    up = np.array([0.0, 0.0, 1.0])
    if np.allclose(np.abs(normal), [0, 0, 1]):
        up = np.array([math.copysign(1.0, normal[2]), 0.0, 0.0])
    t = math.radians(tilt)
    up = up * math.cos(t) + np.cross(normal, up) * math.sin(t) + normal * (normal @ up) * (1 - math.cos(t))
    right = unit(np.cross(normal, up))
    distance = 1 / math.tan(math.radians(fov) / 2)

    def triple(vector: Floats) -> Triple:
        x, y, z = vector.tolist()
        return (x, y, z)

    return View(
        eye=triple(eye), target=triple(target), fov=fov, tilt=tilt, width=width, height=height, aspect=aspect,
        top=0, left=0, bottom=height - 1, right_edge=width - 1, normal=triple(normal), general_up=triple(up),
        right=triple(right), up=triple(np.cross(right, normal)),
        reference_point=triple(eye + distance * normal), distance=distance,
    )  # fmt: skip


class SceneBuilder:
    """Collects rows; `build` makes the IR. Primitives go to a solid's or a light's row."""

    def __init__(
        self,
        eye: ArrayLike = (10.0, 0.0, 0.0),
        target: ArrayLike = (0.0, 0.0, 0.0),
        fov: float = 45.0,
        width: int = 32,
        height: int = 32,
        **options: float,
    ):
        self.rows: dict[str, list[dict[str, Any]]] = {name: [] for name in TABLES}
        self.scene = Globals(
            shadows=False, log_scale=0.0, depth=2, background=BLACK,
            ambient=Ambient(0.2, (0.5, 0.5, 0.5), 0, 0), haze=Haze(False, 1.0, WHITE, 0.0),
            sky=None, mirage=None, view=view(eye, target, fov, width, height, **options), extent=None,
        )  # fmt: skip

    def set(self, **changes: Any) -> Self:
        """Replaces fields of the scene."""
        self.scene = self.scene._replace(**changes)
        return self

    def add(self, table: str, **columns: Any):
        """Appends a row; columns that are not given are zero. Returns its number."""
        self.rows[table].append(columns)
        return len(self.rows[table]) - 1

    def solid(self, **surface: Any) -> Owner:
        """A solid with this surface; `textures` are (kind, columns) pairs."""
        textures = surface.pop("textures", [])
        surface = {
            "color": WHITE, "ambient": 0.1, "specular": 0.0, "refindex": 1.0, "rough": 0.5, "hard": 0.5,
            "metallic": 0.0, **surface,
        }  # fmt: skip
        r2 = max(surface["rough"] ** 2, 1e-30)
        beckmann = 1 / r2 if r2 <= 0.5 else (2 * r2) ** 2 * math.exp(-(2 * r2 - 1) / r2) / r2
        n = surface["refindex"]
        first = len(self.rows["textures"])
        for kind, columns in textures:
            ranges = columns.pop("ranges", [])
            start = len(self.rows["color_ranges"])
            for u, v, a, b in ranges:
                self.add("color_ranges", start=u, end=v, start_color=a, end_color=b)
            self.add(
                "textures", **{
                    "kind": kind, "color": WHITE, "transform": IDENTITY, "inverse": IDENTITY,
                    "first_color_range": start, "color_range_count": len(ranges), **columns,
                }
            )  # fmt: skip
        self.add(
            "surfaces", **{"diffuse": 1 - surface["specular"], "fresnel": ((n - 1) / (n + 1)) ** 2,
            "beckmann": beckmann, "first_texture": first, "texture_count": len(textures), **surface}
        )  # fmt: skip
        return ("solid", self.add("solids", transform=IDENTITY, inverse=IDENTITY))

    def light(self, **columns: Any) -> Owner:
        """A light; infinite, from above and white unless said otherwise."""
        columns = {
            "kind": LightKind.INFINITE, "color": WHITE, "intensity": 1.0, "angle": 180.0,
            "direction": (0.0, 0.0, -1.0), "shadows": True, "highlights": True,
            "transform": IDENTITY, "inverse": IDENTITY, **columns,
        }  # fmt: skip
        return ("light", self.add("lights", **columns))

    def sky(self, azimuth: float = 0.0, zenith: float = 0.0, **columns: Any):
        """A SKY and its sun."""
        _, sun = self.light(sun=True, direction=from_sun(azimuth, zenith), **columns.pop("sun", {}))
        values: dict[str, Any] = {
            "radius": 1e10, "intensity": 1.0, "zenith_color": (0.0, 0.0, 1.0), "horizon_color": (0.9, 0.9, 1.0),
            "overcast": 0.0, **columns,
        }  # fmt: skip
        return self.set(sky=Sky(sun=sun, **values))

    def mirage(self, profile: Profile, segments: int = 500, distance: float = 25000.0, elevation: float = 500.0):
        """A MIRAGE with a profile of (elevation, temperature) pairs."""
        for z, temperature in profile:
            self.add("profile", elevation=z, temperature=temperature)
        top = max(z for z, _ in profile)
        return self.set(mirage=Mirage(segments, distance, min(elevation, top)))

    def primitive(self, kind: PrimitiveKind, row: int, owner: Owner):
        what, number = owner
        self.add(
            "primitives", kind=kind, row=row, solid=number if what == "solid" else -1,
            light=number if what == "light" else -1, transform=IDENTITY, inverse=IDENTITY,
        )  # fmt: skip

    def sphere(
        self,
        center: ArrayLike,
        radius: float,
        owner: Owner,
        pole: ArrayLike = (0, 0, 1),
        equator: ArrayLike = (1, 0, 0),
    ):
        row = self.add("spheres", center=center, radius=radius, pole=pole, equator=equator)
        self.primitive(PrimitiveKind.SPHERE, row, owner)

    def planar(self, kind: PrimitiveKind, table: str, corners: Corners, owner: Owner):
        first, second, third = (np.asarray(corner, float) for corner in corners)
        u, v = third - second, first - second
        self.primitive(kind, self.add(table, point=second, u=u, v=v, normal=np.cross(u, v)), owner)

    def plane(self, corners: Corners, owner: Owner):
        self.planar(PrimitiveKind.PLANE, "planes", corners, owner)

    def triangle(self, corners: Corners, owner: Owner):
        self.planar(PrimitiveKind.TRIANGLE, "triangles", corners, owner)

    def rectangle(self, corners: Corners, owner: Owner):
        self.planar(PrimitiveKind.RECTANGLE, "rectangles", corners, owner)

    def mesh(self, vertices: Rows, facets: Rows, owner: Owner, normals: Rows | None = None):
        """POLYGONS; with `normals`, one a vertex, they are interpolated."""
        base, rows = len(self.rows["vertices"]), len(self.rows["normals"])
        first = len(self.rows["facets"])
        for vertex in vertices:
            self.add("vertices", position=vertex)
        for normal in () if normals is None else normals:
            self.add("normals", direction=normal)
        for facet in facets:
            names = tuple(rows + i for i in facet) if normals is not None else (-1, -1, -1)
            self.add("facets", vertex=tuple(base + i for i in facet), normal=names)
        mesh = self.add(
            "meshes", phong=normals is not None, first_vertex=base, vertex_count=len(vertices), first_facet=first,
            facet_count=len(facets),
        )  # fmt: skip
        self.primitive(PrimitiveKind.POLYGONS, mesh, owner)

    def build(self) -> SceneIR:
        tables = empty_tables()
        for name, rows in self.rows.items():
            for column, (dtype, shape, *_) in TABLES[name].items():
                values = np.zeros((len(rows), *shape), dtype)
                for i, row in enumerate(rows):
                    if column in row:
                        values[i] = row[column]
                tables[name][column] = values
        return SceneIR(self.scene, tables, "test")


def merman(width: int = 320, height: int = 200):
    """The thesis's first example: spheres and a rectangle 1.4 km away, seen through a strong inversion."""
    scene = SceneBuilder((1, 0, 2.1), (0, 0, 2.1001), 1.5, width, height, aspect=1.2)
    scene.set(log_scale=15.0, depth=3, ambient=Ambient(0.2, WHITE, 0, 0), haze=Haze(True, 0.0, (0.9, 0.9, 0.9), 0.0))
    scene.sky(-30, 20, radius=1e8, intensity=0.9, zenith_color=(0, 0, 0.9), horizon_color=(0.5, 0.7, 0.9))
    scene.mirage(MERMAN_PROFILE, segments=300, elevation=100.0)
    rainbow = scene.solid(
        color=(0.8, 0, 0), rough=0.2, hard=0.21, ambient=0.5, specular=0.3, refindex=1.4,
        textures=[(TextureKind.UBLEND, {"color": (0, 0.7, 0.9)})],
    )  # fmt: skip
    scene.sphere((-1400, 7, 2), 2, rainbow)
    mirror = scene.solid(color=(0.7, 0.7, 0.8), rough=0.2, hard=1, ambient=0.4, metallic=1, specular=1, refindex=1.4)
    scene.sphere((-1405, 4, 6), 2, mirror)
    blue = scene.solid(color=(0, 0, 0.9), rough=0.2, hard=0.2, metallic=0.5, ambient=0.4, specular=0.6, refindex=1.4)
    scene.sphere((-1400, -6, -1), 3, blue)
    magenta = scene.solid(color=(0.8, 0, 0.7), rough=0.3, hard=0.8, ambient=0.2, specular=0.6, refindex=1.1)
    scene.sphere((-1400, -6, 4), 2, magenta)
    to_texture = np.diag([1 / 350, 1 / 6, 1, 1])
    to_texture[3, 2] = -0.1
    ground = scene.solid(
        color=BLACK, rough=1, hard=0, ambient=0.1, refindex=1.1,
        textures=[(TextureKind.CHECKER, {"color": WHITE, "inverse": to_texture})],
    )  # fmt: skip
    scene.plane(((0, 0, 0), (0, 1, 0), (-1, 0, 0)), ground)
    wall = scene.solid(
        color=(0.8, 0.8, 0), rough=1, hard=0, ambient=0.1, refindex=1.1,
        textures=[(TextureKind.VBLEND, {"color": (0, 0, 0.8)})],
    )  # fmt: skip
    scene.rectangle(((-1400, -2, 1), (-1400, -2, 0), (-1400, 2, 0)), wall)
    return scene
