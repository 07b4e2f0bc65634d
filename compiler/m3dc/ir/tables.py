"""The scene IR: flat tables of plain numbers that a renderer can read without knowing the language.

A scene is `Scene` (what is said once: view, sky, mirage, ...) and `TABLES` (what is said many times: solids,
primitives, facets, ...). A table is a dictionary of columns, each a NumPy array with one entry a row. All geometry
is in world space; the object and primitive matrices that made it stand beside it. Matrices are 4x4 and act on row
vectors, P' = P M (thesis 3.6). Rows are in the order of the scene file, and their `span` is the half-open range
of bytes of the source text that they came from.

Rows of one table that belong to a row of another are consecutive, named by a `first_...` and a `..._count` column.
"""

import math
from collections.abc import Mapping
from enum import IntEnum
from typing import Annotated, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from m3d_language.table import LANGUAGE

from ..text.span import Span

Triple: TypeAlias = tuple[float, float, float]
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


class Within(NamedTuple):
    """The values that a number may have; `infinite` is whether it may be infinite, too."""

    least: float = -math.inf
    most: float = math.inf
    infinite: bool = False


_ANY = Within()
_SHARE = Within(0.0, 1.0)
_NOT_NEGATIVE = Within(0.0)
_FARTHEST = float(LANGUAGE.limits["reach"])
_PLACE = Within(-_FARTHEST, _FARTHEST)
_UNIT = Within(-1.0 - 1e-9, 1.0 + 1e-9)


class Column(NamedTuple):
    """One column of a table: `dtype`, the shape of one entry, what it means, and what values it may have.

    It may hold numbers of rows of another table, `row_of`; or -1 for none where that is `optional`.
    """

    dtype: str
    shape: tuple[int, ...]
    says: str
    within: Within = _ANY
    row_of: str = ""
    optional: bool = False


def _rows(noun: str, table: str, order: str = "") -> dict[str, Column]:
    """The columns that name consecutive rows of another table."""
    return {
        f"first_{noun}": Column("i4", (), f"its first row in {table}{order}", _NOT_NEGATIVE),
        f"{noun}_count": Column("i4", (), f"how many rows of {table} it has", _NOT_NEGATIVE, table),
    }


def _matrices(of: str) -> dict[str, Column]:
    return {
        "transform": Column("f8", (4, 4), f"matrix of the {of}"),
        "inverse": Column("f8", (4, 4), "its inverse"),
    }


def _planar(what: str) -> dict[str, Column]:
    return {
        "point": Column("f8", (3,), "P, the reference point: VERTEX2", _PLACE),
        "u": Column("f8", (3,), "U, from VERTEX2 to VERTEX3"),
        "v": Column("f8", (3,), "V, from VERTEX2 to VERTEX1"),
        "normal": Column("f8", (3,), f"U x V, the normal of the {what}, not normalised"),
    }


_SPAN = {"span": Column("i8", (2,), "first byte and end byte in the source", _NOT_NEGATIVE)}

TABLES: Mapping[str, Mapping[str, Column]] = {
    "solids": {
        **_matrices("object"),
        **_rows("primitive", "primitives"),
        **_SPAN,
    },
    "surfaces": {  # one row a solid, same row number
        "color": Column("f8", (3,), "diffuse colour O_d, RGB, 0..1", _SHARE),
        "ambient": Column("f8", (), "ambient reflectance k_a, 0..1", _SHARE),
        "diffuse": Column("f8", (), "diffuse reflectance k_d = 1 - SPECULAR", _SHARE),
        "specular": Column("f8", (), "specular reflectance k_s, 0..1", _SHARE),
        "refindex": Column("f8", (), "refractive index, 1 or more", Within(1.0)),
        "rough": Column("f8", (), "Beckmann roughness r, 0..1", _SHARE),
        "hard": Column("f8", (), "hardness k_h, 0..1", _SHARE),
        "metallic": Column("f8", (), "metallic m, 0..1", _SHARE),
        "fuzz": Column("f8", (), "random deviation of the normal, 0..1", _SHARE),
        "fresnel": Column("f8", (), "reflectance at normal incidence, ((n-1)/(n+1))^2", _SHARE),
        "beckmann": Column(
            "f8", (), "largest value of the Beckmann term, by which it is divided", Within(0.0, infinite=True)
        ),
        **_rows("texture", "textures", ", in the order they apply"),
    },
    "textures": {
        "kind": Column("i4", (), "TextureKind", Within(0, max(TextureKind))),
        "local": Column("?", (), "tracks its object: applied in object coordinates"),
        "color": Column("f8", (3,), "texture colour, RGB, 0..1", _SHARE),
        "turbulence": Column("f8", (), "TURBULENCE"),
        "squeeze": Column("f8", (), "SQUEEZE"),
        "scale": Column("f8", (), "SCALE"),
        "slope": Column("f8", (), "SLOPE, degrees"),
        "elevation": Column("f8", (), "ELEVATION"),
        **_matrices("texture"),
        **_rows("color_range", "color_ranges"),
        **_rows("wave", "waves"),
        **_SPAN,
    },
    "color_ranges": {
        "start": Column("f8", (), "u, 0..1", _SHARE),
        "end": Column("f8", (), "v, u < v <= 1", _SHARE),
        "start_color": Column("f8", (3,), "colour at u, RGB, 0..1", _SHARE),
        "end_color": Column("f8", (3,), "colour at v, RGB, 0..1", _SHARE),
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
        "kind": Column("i4", (), "LightKind", Within(0, max(LightKind))),
        "sun": Column("?", (), "the light that SKY makes"),
        "color": Column("f8", (3,), "RGB, 0..1", _SHARE),
        "intensity": Column("f8", (), "factor of the colour"),
        "attenuation": Column("f8", (), "exponent of the loss with distance", _NOT_NEGATIVE),
        "exponent": Column("f8", (), "exponent of the cosine about the axis", _NOT_NEGATIVE),
        "angle": Column(
            "f8", (), "half-angle of the cone it shines into, degrees, 0 < angle <= 180", Within(0.0, 180.0)
        ),
        "position": Column("f8", (3,), "where a point light stands", _PLACE),
        "direction": Column("f8", (3,), "where it shines to, unit vector", _UNIT),
        "shadows": Column("?", (), "whether it casts shadows"),
        "highlights": Column("?", (), "whether it makes specular highlights"),
        **_matrices("object"),
        **_rows("primitive", "primitives"),
        **_SPAN,
    },
    "primitives": {
        "kind": Column("i4", (), "PrimitiveKind", Within(0, max(PrimitiveKind))),
        "row": Column("i4", (), "its row in the table of its kind", _NOT_NEGATIVE),
        "solid": Column("i4", (), "the row of the solid it belongs to, or -1", row_of="solids", optional=True),
        "light": Column("i4", (), "the row of the visible light it belongs to, or -1", row_of="lights", optional=True),
        **_matrices("primitive"),
        **_SPAN,
    },
    "spheres": {
        "center": Column("f8", (3,), "centre", _PLACE),
        "radius": Column("f8", (), "radius", Within(0.0, _FARTHEST)),
        "pole": Column("f8", (3,), "unit vector to the north pole, where u is 0", _UNIT),
        "equator": Column("f8", (3,), "unit vector to where v is 0, at right angles to the pole", _UNIT),
    },
    "planes": _planar("plane"),
    "triangles": _planar("triangle"),
    "rectangles": _planar("rectangle"),
    "meshes": {
        "phong": Column("?", (), "normals are interpolated"),
        **_rows("vertex", "vertices"),
        **_rows("facet", "facets"),
    },
    "vertices": {
        "position": Column("f8", (3,), "world position", _PLACE),
    },
    "facets": {
        "vertex": Column("i4", (3,), "rows of its three corners in vertices", row_of="vertices"),
        "normal": Column(
            "i4", (3,), "rows of its three corners' normals in normals, or -1", row_of="normals", optional=True
        ),
        "offset": Column("u4", (), "byte of the source where it is written"),
    },
    "normals": {
        "direction": Column("f8", (3,), "unit vector", _UNIT),
    },
    "profile": {
        "elevation": Column("f8", (), "height, m, increasing"),
        "temperature": Column("f8", (), "degrees Celsius"),
        **_SPAN,
    },
}


Amount: TypeAlias = Annotated[float, _NOT_NEGATIVE]
Share: TypeAlias = Annotated[float, _SHARE]
Color: TypeAlias = Annotated[Triple, _SHARE]
Place: TypeAlias = Annotated[Triple, _PLACE]
Direction: TypeAlias = Annotated[Triple, _UNIT]
Count: TypeAlias = Annotated[int, Within(0, 2**31 - 1)]
Some: TypeAlias = Annotated[int, Within(1, 2**31 - 1)]
Pixels: TypeAlias = Annotated[int, Within(1, 65535)]
Pixel: TypeAlias = Annotated[int, Within(0, 65534)]


class Extent(NamedTuple):
    """Corners of the box about all finite primitives of solids and lights, in world space; None without any."""

    minimum: Place
    maximum: Place


class Ambient(NamedTuple):
    """Indirect light (thesis 7.5.5.1, AMBIENT)."""

    intensity: float
    color: Color
    samples: Count
    depth: Count


class Haze(NamedTuple):
    """Attenuation with distance (HAZE). `defined` is whether the scene has a HAZE block: it then is the background."""

    defined: bool
    intensity: float
    color: Color
    density: Amount


class Sky(NamedTuple):
    """The CIE sky (SKY). `sun` is the row of its sun in lights."""

    radius: Amount
    intensity: float
    zenith_color: Color
    horizon_color: Color
    overcast: Share
    sun: Count


class Mirage(NamedTuple):
    """Where curved rays end (MIRAGE). `elevation` is never above the profile's top. The profile is a table."""

    segments: Some
    distance: Amount
    elevation: float


class View(NamedTuple):
    """The pin-hole camera (VIEW; thesis 3.2). `normal`, `right` and `up` are unit vectors.

    Pixel (x, y), from the top left, looks along
    distance normal + (2u - 1) right + (1 - 2v) (height / width) aspect up, u = x/(width-1), v = y/(height-1).
    The reference point is eye + distance normal; far from the origin rounding takes its digits.
    """

    eye: Place
    target: Place
    fov: Annotated[float, Within(0.0, 180.0)]
    tilt: float
    width: Pixels
    height: Pixels
    aspect: Amount
    top: Pixel
    left: Pixel
    bottom: Pixel
    right_edge: Pixel
    normal: Direction
    general_up: Direction
    right: Direction
    up: Direction
    reference_point: Place
    distance: Amount


class Scene(NamedTuple):
    """What a scene says once. `log_scale` 0 means none. `refract_reflections` is whether the air bends mirror rays
    too. `spans` are where its blocks stand, by keyword."""

    shadows: bool
    log_scale: Amount
    depth: Some
    background: Color
    ambient: Ambient
    haze: Haze
    sky: Sky | None
    mirage: Mirage | None
    view: View
    extent: Extent | None
    refract_reflections: bool = False
    spans: Mapping[str, Span] = {}


def empty_tables() -> dict[str, Table]:
    """Every table of TABLES without a row."""
    return {
        name: {c: np.zeros((0, *column.shape), column.dtype) for c, column in columns.items()}
        for name, columns in TABLES.items()
    }
