"""The scene IR: flat tables of plain numbers that a renderer can read without knowing the language.

A scene is `Globals` (what is said once: view, sky, mirage, ...) and `TABLES` (what is said many times: solids,
primitives, facets, ...). A table is a dictionary of columns, each a NumPy array with one entry a row. All geometry
is in world space; the object and primitive matrices that made it stand beside it. Matrices are 4x4 and act on row
vectors, P' = P M (thesis 3.6). Rows are in the order of the scene file, and their `span` is the half-open range
of bytes of the source text that they came from.

Rows of one table that belong to a row of another are consecutive, named by a `first_...` and a `..._count` column.
"""

from collections.abc import Mapping
from enum import IntEnum
from typing import Annotated, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..columns.column import NOT_NEGATIVE, POSITION, SHARE, UNIT, Column, Within, consecutive, matrices
from ..meaning.primitive import PRIMITIVES, PrimitiveKind
from ..text.span import Span

Triple: TypeAlias = tuple[float, float, float]
Columns: TypeAlias = dict[str, NDArray[Any]]


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


PRIMITIVE_TABLE = {kind: primitive.table for kind, primitive in PRIMITIVES.items()}
"""The table that the `row` of a row of `primitives` points into, by its kind."""


_SPAN = {"span": Column("i8", (2,), "first byte and end byte in the source", NOT_NEGATIVE)}

TABLES: Mapping[str, Mapping[str, Column]] = {
    "solids": {
        **matrices("object"),
        **consecutive("primitive", "primitives"),
        **_SPAN,
    },
    "surfaces": {  # one row a solid, same row number
        "color": Column("f8", (3,), "diffuse colour O_d, RGB, 0..1", SHARE),
        "ambient": Column("f8", (), "ambient reflectance k_a, 0..1", SHARE),
        "diffuse": Column("f8", (), "diffuse reflectance k_d = 1 - SPECULAR", SHARE),
        "specular": Column("f8", (), "specular reflectance k_s, 0..1", SHARE),
        "refindex": Column("f8", (), "refractive index, 1 or more", Within(1.0)),
        "rough": Column("f8", (), "Beckmann roughness r, 0..1", SHARE),
        "hard": Column("f8", (), "hardness k_h, 0..1", SHARE),
        "metallic": Column("f8", (), "metallic m, 0..1", SHARE),
        "fuzz": Column("f8", (), "random deviation of the normal, 0..1", SHARE),
        "fresnel": Column("f8", (), "reflectance at normal incidence, ((n-1)/(n+1))^2", SHARE),
        "beckmann": Column(
            "f8", (), "largest value of the Beckmann term, by which it is divided", Within(0.0, infinite=True)
        ),
        **consecutive("texture", "textures", ", in the order they apply"),
    },
    "textures": {
        "kind": Column("i4", (), "TextureKind", Within(0, max(TextureKind))),
        "local": Column("?", (), "tracks its object: applied in object coordinates"),
        "color": Column("f8", (3,), "texture colour, RGB, 0..1", SHARE),
        "turbulence": Column("f8", (), "TURBULENCE"),
        "squeeze": Column("f8", (), "SQUEEZE"),
        "scale": Column("f8", (), "SCALE"),
        "slope": Column("f8", (), "SLOPE, degrees"),
        "elevation": Column("f8", (), "ELEVATION"),
        **matrices("texture"),
        **consecutive("color_range", "color_ranges"),
        **consecutive("wave", "waves"),
        **_SPAN,
    },
    "color_ranges": {
        "start": Column("f8", (), "u, 0..1", SHARE),
        "end": Column("f8", (), "v, u < v <= 1", SHARE),
        "start_color": Column("f8", (3,), "colour at u, RGB, 0..1", SHARE),
        "end_color": Column("f8", (3,), "colour at v, RGB, 0..1", SHARE),
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
        "color": Column("f8", (3,), "RGB, 0..1", SHARE),
        "intensity": Column("f8", (), "factor of the colour"),
        "attenuation": Column("f8", (), "exponent of the loss with distance", NOT_NEGATIVE),
        "exponent": Column("f8", (), "exponent of the cosine about the axis", NOT_NEGATIVE),
        "angle": Column(
            "f8", (), "half-angle of the cone it shines into, degrees, 0 < angle <= 180", Within(0.0, 180.0)
        ),
        "position": Column("f8", (3,), "where a point light stands", POSITION),
        "direction": Column("f8", (3,), "where it shines to, unit vector", UNIT),
        "shadows": Column("?", (), "whether it casts shadows"),
        "highlights": Column("?", (), "whether it makes specular highlights"),
        **matrices("object"),
        **consecutive("primitive", "primitives"),
        **_SPAN,
    },
    "primitives": {
        "kind": Column("i4", (), "PrimitiveKind", Within(0, max(PrimitiveKind))),
        "row": Column("i4", (), "its row in the table of its kind", NOT_NEGATIVE),
        "solid": Column("i4", (), "the row of the solid it belongs to, or -1", row_of="solids", optional=True),
        "light": Column("i4", (), "the row of the visible light it belongs to, or -1", row_of="lights", optional=True),
        **matrices("primitive"),
        **_SPAN,
    },
    **{table: columns for primitive in PRIMITIVES.values() for table, columns in primitive.tables.items()},
    "profile": {
        "elevation": Column("f8", (), "height, m, increasing"),
        "temperature": Column("f8", (), "degrees Celsius"),
        **_SPAN,
    },
}


Amount: TypeAlias = Annotated[float, NOT_NEGATIVE]
Share: TypeAlias = Annotated[float, SHARE]
Color: TypeAlias = Annotated[Triple, SHARE]
Position: TypeAlias = Annotated[Triple, POSITION]
Direction: TypeAlias = Annotated[Triple, UNIT]
Count: TypeAlias = Annotated[int, Within(0, 2**31 - 1)]
Some: TypeAlias = Annotated[int, Within(1, 2**31 - 1)]
Pixels: TypeAlias = Annotated[int, Within(1, 65535)]
Pixel: TypeAlias = Annotated[int, Within(0, 65534)]


class Extent(NamedTuple):
    """Corners of the box about all finite primitives of solids and lights, in world space; None without any."""

    minimum: Position
    maximum: Position


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

    eye: Position
    target: Position
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
    reference_point: Position
    distance: Amount


class Globals(NamedTuple):
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


def empty_tables() -> dict[str, Columns]:
    """Every table of TABLES without a row."""
    return {
        name: {c: np.zeros((0, *column.shape), column.dtype) for c, column in columns.items()}
        for name, columns in TABLES.items()
    }
