"""The scene IR: flat tables of plain numbers that a renderer can read without knowing the language.

A scene is `Scene` (what is said once: view, sky, mirage, ...) and `TABLES` (what is said many times: solids,
primitives, facets, ...). A table is a dictionary of columns, each a NumPy array with one entry a row. All geometry
is in world space; the object and primitive matrices that made it stand beside it. Matrices are 4x4 and act on row
vectors, P' = P M (thesis 3.6). Rows are in the order of the scene file, and their `span` is the half-open range
of bytes of the source text that they came from.

Rows of one table that belong to a row of another are consecutive, named by a `first_...` and a `..._count` column.
"""

from collections.abc import Mapping
from enum import IntEnum
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Triple: TypeAlias = tuple[float, float, float]
Span: TypeAlias = tuple[int, int]
Table: TypeAlias = dict[str, NDArray[Any]]


class PrimitiveKind(IntEnum):
    """What a row of `primitives` is, and so which table its `row` points into."""

    SPHERE = 0
    PLANE = 1
    TRIANGLE = 2
    RECTANGLE = 3
    POLYGONS = 4
    TERRAIN = 5


class TextureKind(IntEnum):
    """What a row of `textures` is."""

    CHECKER = 0
    WOOD = 1
    MARBLE = 2
    SPOTTED = 3
    GRANITE = 4
    CLOUDS = 5
    SNOW = 6
    GRADIENT = 7
    BUMPS = 8
    WAVES = 9
    RIPPLES = 10
    UBLEND = 11
    VBLEND = 12


class LightKind(IntEnum):
    """Where a light shines from: a direction, or a point of the scene."""

    INFINITE = 0
    POINT = 1


PRIMITIVE_TABLE = {
    PrimitiveKind.SPHERE: "spheres",
    PrimitiveKind.PLANE: "planes",
    PrimitiveKind.TRIANGLE: "triangles",
    PrimitiveKind.RECTANGLE: "rectangles",
    PrimitiveKind.POLYGONS: "meshes",
    PrimitiveKind.TERRAIN: "meshes",
}


class Column(NamedTuple):
    """One column of a table: `dtype`, the shape of one entry, and what it means."""

    dtype: str
    shape: tuple[int, ...]
    says: str


def _matrices(of: str) -> dict[str, Column]:
    return {
        "transform": Column("f8", (4, 4), f"matrix of the {of}"),
        "inverse": Column("f8", (4, 4), "its inverse"),
    }


def _planar(what: str) -> dict[str, Column]:
    return {
        "point": Column("f8", (3,), "P, the reference point: VERTEX2"),
        "u": Column("f8", (3,), "U, from VERTEX2 to VERTEX3"),
        "v": Column("f8", (3,), "V, from VERTEX2 to VERTEX1"),
        "normal": Column("f8", (3,), f"U x V, the normal of the {what}, not normalised"),
    }


_SPAN = {"span": Column("i8", (2,), "first byte and end byte in the source")}

TABLES: Mapping[str, Mapping[str, Column]] = {
    "solids": {
        **_matrices("object"),
        "first_primitive": Column("i4", (), "its first row in primitives"),
        "primitive_count": Column("i4", (), "how many rows of primitives it has"),
        **_SPAN,
    },
    "surfaces": {  # one row a solid, same row number
        "color": Column("f8", (3,), "diffuse colour O_d, RGB, 0..1"),
        "ambient": Column("f8", (), "ambient reflectance k_a, 0..1"),
        "diffuse": Column("f8", (), "diffuse reflectance k_d = 1 - SPECULAR"),
        "specular": Column("f8", (), "specular reflectance k_s, 0..1"),
        "refindex": Column("f8", (), "refractive index, 1 or more"),
        "rough": Column("f8", (), "Beckmann roughness r, 0..1"),
        "hard": Column("f8", (), "hardness k_h, 0..1"),
        "metallic": Column("f8", (), "metallic m, 0..1"),
        "fuzz": Column("f8", (), "random deviation of the normal, 0..1"),
        "fresnel": Column("f8", (), "reflectance at normal incidence, ((n-1)/(n+1))^2"),
        "beckmann": Column("f8", (), "largest value of the Beckmann term, by which it is divided"),
        "first_texture": Column("i4", (), "its first row in textures, in the order they apply"),
        "texture_count": Column("i4", (), "how many rows of textures it has"),
    },
    "textures": {
        "kind": Column("i4", (), "TextureKind"),
        "local": Column("?", (), "tracks its object: applied in object coordinates"),
        "color": Column("f8", (3,), "texture colour, RGB, 0..1"),
        "turbulence": Column("f8", (), "TURBULENCE"),
        "squeeze": Column("f8", (), "SQUEEZE"),
        "scale": Column("f8", (), "SCALE"),
        "slope": Column("f8", (), "SLOPE, degrees"),
        "elevation": Column("f8", (), "ELEVATION"),
        **_matrices("texture"),
        "first_color_range": Column("i4", (), "its first row in color_ranges"),
        "color_range_count": Column("i4", (), "how many rows of color_ranges it has"),
        "first_wave": Column("i4", (), "its first row in waves"),
        "wave_count": Column("i4", (), "how many rows of waves it has"),
        **_SPAN,
    },
    "color_ranges": {
        "start": Column("f8", (), "u, 0..1"),
        "end": Column("f8", (), "v, u < v <= 1"),
        "start_color": Column("f8", (3,), "colour at u, RGB, 0..1"),
        "end_color": Column("f8", (3,), "colour at v, RGB, 0..1"),
        **_SPAN,
    },
    "waves": {
        "center": Column("f8", (3,), "where the wave starts"),
        "amplitude": Column("f8", (), "height"),
        "freq": Column("f8", (), "frequency"),
        "phase": Column("f8", (), "phase shift"),
        "damp": Column("f8", (), "attenuation with distance"),
        **_SPAN,
    },
    "lights": {
        "kind": Column("i4", (), "LightKind"),
        "sun": Column("?", (), "the light that SKY makes"),
        "color": Column("f8", (3,), "RGB, 0..1"),
        "intensity": Column("f8", (), "factor of the colour"),
        "attenuation": Column("f8", (), "exponent of the loss with distance"),
        "exponent": Column("f8", (), "exponent of the cosine about the axis"),
        "angle": Column("f8", (), "half-angle of the cone it shines into, degrees, 0 < angle <= 180"),
        "position": Column("f8", (3,), "where a point light stands"),
        "direction": Column("f8", (3,), "where it shines to, unit vector"),
        "shadows": Column("?", (), "whether it casts shadows"),
        "highlights": Column("?", (), "whether it makes specular highlights"),
        **_matrices("object"),
        "first_primitive": Column("i4", (), "its first row in primitives"),
        "primitive_count": Column("i4", (), "how many rows of primitives it has"),
        **_SPAN,
    },
    "primitives": {
        "kind": Column("i4", (), "PrimitiveKind"),
        "row": Column("i4", (), "its row in the table of its kind"),
        "solid": Column("i4", (), "the row of the solid it belongs to, or -1"),
        "light": Column("i4", (), "the row of the visible light it belongs to, or -1"),
        **_matrices("primitive"),
        **_SPAN,
    },
    "spheres": {
        "center": Column("f8", (3,), "centre"),
        "radius": Column("f8", (), "radius"),
        "pole": Column("f8", (3,), "unit vector to the north pole, where u is 0"),
        "equator": Column("f8", (3,), "unit vector to where v is 0, at right angles to the pole"),
    },
    "planes": _planar("plane"),
    "triangles": _planar("triangle"),
    "rectangles": _planar("rectangle"),
    "meshes": {
        "phong": Column("?", (), "normals are interpolated"),
        "first_vertex": Column("i4", (), "its first row in vertices"),
        "vertex_count": Column("i4", (), "how many rows of vertices it has"),
        "first_facet": Column("i4", (), "its first row in facets"),
        "facet_count": Column("i4", (), "how many rows of facets it has"),
    },
    "vertices": {
        "position": Column("f8", (3,), "world position"),
    },
    "facets": {
        "vertex": Column("i4", (3,), "rows of its three corners in vertices"),
        "normal": Column("i4", (3,), "rows of its three corners' normals in normals, or -1"),
        "offset": Column("u4", (), "byte of the source where it is written"),
    },
    "normals": {
        "direction": Column("f8", (3,), "unit vector"),
    },
    "profile": {
        "elevation": Column("f8", (), "height, m, increasing"),
        "temperature": Column("f8", (), "degrees Celsius"),
        **_SPAN,
    },
}


class Extent(NamedTuple):
    """Corners of the box about all finite primitives of solids and lights, in world space; None without any."""

    minimum: Triple
    maximum: Triple


class Ambient(NamedTuple):
    """Indirect light (thesis 7.5.5.1, AMBIENT)."""

    intensity: float
    color: Triple
    samples: int
    depth: int


class Haze(NamedTuple):
    """Attenuation with distance (HAZE). `defined` is whether the scene has a HAZE block: it then is the background."""

    defined: bool
    intensity: float
    color: Triple
    density: float


class Sky(NamedTuple):
    """The CIE sky (SKY). `sun` is the row of its sun in lights."""

    radius: float
    intensity: float
    zenith_color: Triple
    horizon_color: Triple
    overcast: float
    sun: int


class Mirage(NamedTuple):
    """Where curved rays end (MIRAGE). `elevation` is never above the profile's top. The profile is a table."""

    segments: int
    distance: float
    elevation: float


class View(NamedTuple):
    """The pin-hole camera (VIEW; thesis 3.2). `normal`, `right` and `up` are unit vectors.

    Pixel (x, y), from the top left, looks through
    reference_point + (2u - 1) right + (1 - 2v) (height / width) aspect up, u = x/(width-1), v = y/(height-1).
    """

    eye: Triple
    target: Triple
    fov: float
    tilt: float
    width: int
    height: int
    aspect: float
    top: int
    left: int
    bottom: int
    right_edge: int
    normal: Triple
    general_up: Triple
    right: Triple
    up: Triple
    reference_point: Triple
    distance: float


class Scene(NamedTuple):
    """What a scene says once. `log_scale` 0 means none. `refract_reflections` is whether the air bends mirror rays
    too. `spans` are where its blocks stand, by keyword."""

    shadows: bool
    log_scale: float
    depth: int
    background: Triple
    ambient: Ambient
    haze: Haze
    sky: Sky | None
    mirage: Mirage | None
    view: View
    extent: Extent | None
    refract_reflections: bool = False
    spans: Mapping[str, Span] = {}


class SceneIR:
    """A compiled scene. `tables` has every table and column of TABLES; `source` is the scene file's name."""

    __slots__ = ("scene", "source", "tables")

    def __init__(self, scene: Scene, tables: Mapping[str, Table], source: str = "") -> None:
        self.scene = scene
        self.tables = tables
        self.source = source

    def __getitem__(self, table: str) -> Table:
        return self.tables[table]

    def _repr_html_(self) -> str:
        from .notebook import scene_html  # here, because only notebooks ask

        return scene_html(self)


def empty_tables() -> dict[str, Table]:
    """Every table of TABLES without a row."""
    return {
        name: {c: np.zeros((0, *column.shape), column.dtype) for c, column in columns.items()}
        for name, columns in TABLES.items()
    }
