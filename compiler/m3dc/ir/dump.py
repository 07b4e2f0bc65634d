"""The debug dump: a compiled scene as text, in the form of the 1993 program (thesis, Appendix D).

Labels, order and number formats are those of the appendix; what its sample does not show (points lights, facets,
colour ranges, waves) follows its style. Objects come last defined first.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..meaning.primitive import PRIMITIVES, Listing
from ..text.span import Span
from .scene import SceneIR
from .tables import LightKind, PrimitiveKind, TextureKind, Triple

LABEL_WIDTH = 26
INDENT = "  "

_TEXTURE_NAMES = {TextureKind.UBLEND: "uBlend", TextureKind.VBLEND: "vBlend"}


class Line(NamedTuple):
    """A line of the dump, and the place of the source that it tells of."""

    text: str
    span: Span | None = None


def dump(scene: SceneIR, date: str) -> str:
    """The whole dump. `date` stands in its heading."""
    heading = [_field("Input File", scene.source), _field("Date", date), ""]
    return "\n".join([*heading, *(line.text for line in lines(scene))]) + "\n"


def lines(scene: SceneIR, most_rows: int | None = None) -> Iterator[Line]:
    """The lines of the dump after its heading. Of a mesh's vertices and facets no more than `most_rows` each are
    shown."""
    spans = scene.scene.spans
    yield from _section("Scene Definition", _scene(scene), spans.get("SCENE"))
    yield from _section("View Plane", _view(scene), spans.get("VIEW"))
    yield from object_lines(scene, None, most_rows)
    if scene.scene.sky is not None:
        yield from _section("Sky", _sky(scene), spans.get("SKY"))
    if scene.scene.mirage is not None:
        yield from _section("Mirage Definition", _mirage(scene), spans.get("MIRAGE"))


def object_lines(scene: SceneIR, only: Span | None, most_rows: int | None = None) -> Iterator[Line]:
    """The lines about all solids and lights, or only about the one that stands at a place of the source."""
    for title, table, body in (("Solid", "solids", _solid), ("Light", "lights", _light)):
        places = scene[table]["span"].tolist()
        for number, row in enumerate(reversed(range(len(places))), 1):
            start, end = places[row]
            if only is None or only == (start, end):
                heading = f"{title} Object Definition # {number}"
                yield from _section(heading, body(scene, row, most_rows), (start, end))


# --- forms --------------------------------------------------------------------------------------------------------


def _section(title: str, body: Iterable[str | Line], span: Span | None) -> Iterator[Line]:
    yield Line(title, span)
    yield Line("", None)
    for line in body:
        text, own = (line, None) if isinstance(line, str) else line
        yield Line(INDENT + text if text else "", own or span)
    yield Line("", None)


def _field(label: str, value: object) -> str:
    if isinstance(value, float):
        value = f"{value:f}"
    dots = "." * (LABEL_WIDTH - len(label) - 1)
    return f"{label} {dots} : {value}" if dots else f"{label} : {value}"


def _yes(value: object) -> str:
    return "Yes" if value else "No"


def _indented(body: Iterable[str]) -> Iterator[str]:
    return (INDENT + line for line in body)


def _triple(title: str, values: Triple | Any, names: str = "XYZ") -> Iterator[str]:
    yield title
    yield from _components(values, names, INDENT)


def _components(values: Triple | Any, names: str, indent: str = "") -> Iterator[str]:
    for name, value in zip(names, values, strict=True):
        yield f"{indent}{name} : {float(value) + 0.0:f}"


def _transforms(columns: dict[str, Any], row: int) -> Iterator[str]:
    for title, column in (("Transform", "transform"), ("Inverse Transform", "inverse")):
        yield title
        for line in columns[column][row]:
            yield INDENT + "\t".join(f"{float(value) + 0.0:f}" for value in line)


# --- scene --------------------------------------------------------------------------------------------------------


def _scene(ir: SceneIR) -> Iterator[str]:
    scene = ir.scene
    yield _field("Max Specular Ray Depth", scene.depth)
    yield _field("Log Scale", scene.log_scale)
    yield _field("Image Scaling", "No")
    yield _field("Shadows", _yes(scene.shadows))
    yield _field("Wire Frame Display", "No")
    zero = (0.0, 0.0, 0.0)
    yield from _triple("Maximum Extent", scene.extent.maximum if scene.extent else zero)
    yield from _triple("Minimum Extent", scene.extent.minimum if scene.extent else zero)
    yield from _triple("Background Color", scene.background, "RGB")
    yield _field("Haze Intensity", scene.haze.intensity)
    yield _field("Haze Density", scene.haze.density)
    yield from _triple("Haze Color", scene.haze.color, "RGB")
    yield _field("Ambient Intensity", scene.ambient.intensity)
    yield from _triple("Ambient Color", scene.ambient.color, "RGB")
    yield _field("Max Ambient Ray Depth", scene.ambient.depth)
    yield _field("Ambient Ray Samples", scene.ambient.samples)


def _view(ir: SceneIR) -> Iterator[str]:
    view = ir.scene.view
    yield from _triple("View Plane Normal", view.normal)
    yield from _triple("View plane Right", view.right)
    yield from _triple("General UP direction", view.general_up)
    yield from _triple("View Plane Up", view.up)
    yield from _triple("Looking From", view.eye)
    yield from _triple("Looking Towards", view.target)
    yield from _triple("View Reference Point", view.reference_point)
    yield _field("View Distance", view.distance)
    yield _field("Field Of View", view.fov)
    yield _field("Tilt", view.tilt)
    yield _field("Aspect Ratio", view.aspect)
    yield _field("Width", view.width)
    yield _field("Height", view.height)
    yield _field("Top", view.top)
    yield _field("Left", view.left)
    yield _field("Bottom", view.bottom)
    yield _field("Right", view.right_edge)


def _sky(ir: SceneIR) -> Iterator[str]:
    sky = ir.scene.sky
    assert sky is not None
    yield _field("Radius", f"{sky.radius:e}")
    yield _field("Zenith Intensity", sky.intensity)
    yield _field("Overcast", sky.overcast)
    yield from _triple("Zenith Color", sky.zenith_color, "RGB")
    yield from _triple("Horizon Color", sky.horizon_color, "RGB")
    yield "Sun"
    yield from _indented(_source(ir, sky.sun, "Specular Highlights"))


def _mirage(ir: SceneIR) -> Iterator[str | Line]:
    mirage = ir.scene.mirage
    assert mirage is not None
    yield _field("Max Horizontal Distance", f"{mirage.distance:e}")
    yield _field("Max Elevation", f"{mirage.elevation:e}")
    yield _field("Max Ray Segments", mirage.segments)
    yield "Temperature Profile"
    yield INDENT + "\tElevation\tTemperature"
    profile = ir["profile"]
    points = zip(*(profile[column].tolist() for column in ("elevation", "temperature", "span")), strict=True)
    for number, (elevation, temperature, (start, end)) in enumerate(points):
        yield Line(f"{INDENT}{number}\t{elevation:f}\t{temperature:f}", (start, end))


# --- objects ------------------------------------------------------------------------------------------------------


def _solid(ir: SceneIR, row: int, most_rows: int | None) -> Iterator[str | Line]:
    yield from _transforms(ir["solids"], row)
    yield "Attributes"
    yield from _indented(_surface(ir, row))
    yield from _primitives(ir, "solids", row, most_rows)


def _surface(ir: SceneIR, row: int) -> Iterator[str]:
    surface = {name: column[row] for name, column in ir["surfaces"].items()}
    yield from _components(surface["color"], "RGB")
    for label, column in (
        ("Ambient Reflectance", "ambient"),
        ("Diffuse Reflectance", "diffuse"),
        ("Specular Reflectance", "specular"),
        ("Refraction Index", "refindex"),
        ("Roughness", "rough"),
        ("Hardness", "hard"),
        ("Metallic", "metallic"),
        ("Fuzz", "fuzz"),
        ("Fresnel", "fresnel"),
        ("Beckman Normalization", "beckmann"),
    ):
        yield _field(label, float(surface[column]))
    first = int(surface["first_texture"])
    for texture in range(first, first + int(surface["texture_count"])):
        yield "Texture"
        yield from _indented(_texture(ir, texture))


def _texture(ir: SceneIR, row: int) -> Iterator[str]:
    texture = {name: column[row] for name, column in ir["textures"].items()}
    kind = TextureKind(int(texture["kind"]))
    yield _field("Type", _TEXTURE_NAMES.get(kind, kind.name.capitalize()))
    yield _field("Local", _yes(texture["local"]))
    yield _field("Scaling", float(texture["scale"]))
    yield _field("Turbulence/Deviation", float(texture["turbulence"]))
    # One member of the 1993 program's structure served both: SNOW alone uses the elevation.
    shared = "elevation" if kind is TextureKind.SNOW else "squeeze"
    yield _field("Squeeze/Elevation", float(texture[shared]))
    yield _field("Maximum Slope", float(texture["slope"]))
    yield from _components(texture["color"], "RGB")
    ranges, first = ir["color_ranges"], int(texture["first_color_range"])
    for number in range(int(texture["color_range_count"])):
        yield f"Color Range # {number + 1}"
        yield INDENT + _field("Start", float(ranges["start"][first + number]))
        yield INDENT + _field("End", float(ranges["end"][first + number]))
        yield from _indented(_triple("Start Color", ranges["start_color"][first + number], "RGB"))
        yield from _indented(_triple("End Color", ranges["end_color"][first + number], "RGB"))
    waves, first = ir["waves"], int(texture["first_wave"])
    for number in range(int(texture["wave_count"])):
        yield f"Wave # {number + 1}"
        yield from _indented(_triple("Center", waves["center"][first + number]))
        for label, column in (
            ("Amplitude", "amplitude"),
            ("Frequency", "freq"),
            ("Phase", "phase"),
            ("Damping", "damp"),
        ):
            yield INDENT + _field(label, float(waves[column][first + number]))
    if not np.array_equal(texture["transform"], np.eye(4)):
        yield from _transforms(ir["textures"], row)


def _light(ir: SceneIR, row: int, most_rows: int | None) -> Iterator[str | Line]:
    yield from _transforms(ir["lights"], row)
    yield from _source(ir, row, "Specular Hilights")
    yield from _primitives(ir, "lights", row, most_rows)


def _source(ir: SceneIR, row: int, highlights: str) -> Iterator[str]:
    light = {name: column[row] for name, column in ir["lights"].items()}
    point = light["kind"] == LightKind.POINT
    yield "Attributes"
    yield INDENT + _field("Type", "Point" if point else "Infinite")
    yield from _components(light["color"], "RGB", INDENT)
    yield INDENT + _field("Intensity", float(light["intensity"]))
    yield INDENT + _field("Distance Attenuation", float(light["attenuation"]))
    if point:
        yield INDENT + _field("Angle", float(light["angle"]))
        yield INDENT + _field("Exponent", float(light["exponent"]))
        yield from _indented(_triple("Position", light["position"]))
    yield from _indented(_triple("Direction", light["direction"]))
    yield INDENT + _field("Shadows", _yes(light["shadows"]))
    yield INDENT + _field(highlights, _yes(light["highlights"]))


# --- primitives ---------------------------------------------------------------------------------------------------


def _primitives(ir: SceneIR, table: str, owner: int, most_rows: int | None) -> Iterator[str | Line]:
    first, count = int(ir[table]["first_primitive"][owner]), int(ir[table]["primitive_count"][owner])
    primitives = ir["primitives"]
    yield _field("Number primitives", count)
    for row in range(first, first + count):
        kind = PrimitiveKind(int(primitives["kind"][row]))
        start, end = primitives["span"][row].tolist()
        yield Line(kind.name.capitalize(), (start, end))
        for line in _shape(ir, kind, int(primitives["row"][row]), most_rows):
            yield Line(INDENT + line, (start, end))
        for line in _transforms(primitives, row):
            yield Line(INDENT + line, (start, end))


def _shape(ir: SceneIR, kind: PrimitiveKind, row: int, most_rows: int | None) -> Iterator[str]:
    for said in PRIMITIVES[kind].dump(ir.tables, row, most_rows):
        if isinstance(said, Listing):
            yield from _listing(said)
        elif isinstance(said.value, bool):
            yield _field(said.label, _yes(said.value))
        elif isinstance(said.value, float):
            yield _field(said.label, said.value)
        else:
            yield from _triple(said.label, said.value)


def _listing(listing: Listing) -> Iterator[str]:
    yield _field(listing.label, listing.total)
    for number, (values, below) in enumerate(listing.first):
        yield f"{INDENT}{number}\t{_tabbed(values)}"
        for line in below:
            yield f"{INDENT * 2}\t{_tabbed(line)}"
    yield from _more(listing.total - len(listing.first))


def _tabbed(values: Sequence[float]) -> str:
    a, b, c = values
    return f"{a}\t{b}\t{c}" if isinstance(a, int) else f"{a + 0.0:f}\t{b + 0.0:f}\t{c + 0.0:f}"


def _more(rows: int) -> Iterator[str]:
    if rows:
        yield f"{INDENT}... and {rows} more"
