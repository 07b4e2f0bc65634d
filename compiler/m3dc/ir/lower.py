"""Lowers an evaluated scene to the flat IR: world-space geometry, and every constant a renderer would work out anew."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import ir
from ..columns.rows import Rows
from ..meaning.evaluate import World
from ..meaning.primitive import PRIMITIVES, PrimitiveKind
from ..meaning.transform import Transform, clean, cosine_and_sine, unit
from ..meaning.values import Record
from ..text.places import Places
from ..text.span import Placed, Span
from .tables import LightKind, TextureKind


def _ends(placed: Placed) -> tuple[int, int]:
    """Both ends of a place, as a row holds them until all are made bytes at once."""
    return placed.start, placed.end


@np.errstate(all="ignore")  # of faulty records; what is not finite has been found before
def lower(world: World, source: str, places: Places) -> ir.SceneIR:
    """The IR of a scene. Records that were found faulty may be in it; it is complete only where there is no error."""
    rows = Rows(ir.TABLES, places)
    for solid in world.solids:
        _solid(rows, solid)
    sun = -1
    for light in world.lights:
        row = _light(rows, light)
        if light.block == "SUN":
            sun = row
    mirage = world.scene.nested.get("MIRAGE")
    profile = mirage.tables.get("PROFILE") if mirage is not None else None
    if profile is not None and len(profile.rows):
        starts = profile.offsets.astype(np.int64) + profile.span.start
        rows.extend(
            "profile",
            elevation=profile.rows[:, 0],
            temperature=profile.rows[:, 1],
            span=np.stack([starts, np.append(starts[1:], profile.span.end)], axis=1),
        )
    tables = rows.tables()
    spans = {keyword: places.absolute(record.span).bytes for keyword, record in _once(world.scene)}
    return ir.SceneIR(_globals(world.scene, sun, _extent(tables), tables["profile"], spans), tables, source)


class Shapes(NamedTuple):
    """Some primitives as rows of the IR's tables, and the box that holds those that end somewhere."""

    tables: dict[str, ir.Columns]
    extent: ir.Extent | None


@np.errstate(all="ignore")
def shapes(parts: Iterable[Record], transform: Transform, places: Places) -> Shapes:
    """Primitives alone, moved by the matrix of what they are parts of. They may be faulty."""
    rows = Rows(ir.TABLES, places)
    for part in parts:
        _primitive(rows, part, transform)
    tables = rows.tables()
    return Shapes(tables, _extent(tables))


def _once(scene: Record) -> Iterator[tuple[str, Record]]:
    """The scene and its blocks, by keyword."""
    yield "SCENE", scene
    yield from scene.nested.items()


# --- objects ------------------------------------------------------------------------------------------------------


def _solid(rows: Rows, record: Record) -> None:
    first = rows.count("primitives")
    number = rows.count("solids")
    for part in record.parts:
        _primitive(rows, part, record.transform, solid=number)
    rows.add(
        "solids",
        transform=record.transform.matrix,
        inverse=clean(record.transform.inverse),
        first_primitive=first,
        primitive_count=rows.count("primitives") - first,
        span=_ends(record.span),
    )
    _surface(rows, record.member("SURFACE"))


def _light(rows: Rows, record: Record) -> int:
    """A LIGHT, or the SUN of a sky."""
    first = rows.count("primitives")
    number = rows.count("lights")
    for part in record.parts:
        _primitive(rows, part, record.transform, light=number)
    source = record if record.block == "SUN" else record.member("SOURCE")
    point = record.block == "LIGHT" and not source.flag("INFINITE")
    return rows.add(
        "lights",
        kind=LightKind.POINT if point else LightKind.INFINITE,
        sun=record.block == "SUN",
        color=source.vector("COLOR"),
        intensity=source.number("INTENSITY"),
        attenuation=source.values.get("ATTENUATION", 0.0),
        exponent=source.values.get("EXPONENT", 0.0),
        angle=source.values.get("ANGLE", 180.0),
        position=record.transform.points(np.array(source.vector("FROM"))),
        direction=unit(record.transform.ways(np.array(source.vector("DIRECTION")))),
        shadows=not source.flag("NOSHADOWS"),
        highlights=not source.flag("NOSPECULAR"),
        transform=record.transform.matrix,
        inverse=clean(record.transform.inverse),
        first_primitive=first,
        primitive_count=rows.count("primitives") - first,
        span=_ends(record.span),
    )


def _surface(rows: Rows, record: Record) -> None:
    first = rows.count("textures")
    textures = record.nested.get("TEXTURE")
    for texture in textures.parts if textures else ():
        _texture(rows, texture)
    index, rough = record.number("REFINDEX"), record.number("ROUGH")
    rows.add(
        "surfaces",
        color=record.vector("COLOR"),
        ambient=record.number("AMBIENT"),
        diffuse=1.0 - record.number("SPECULAR"),
        specular=record.number("SPECULAR"),
        refindex=index,
        rough=rough,
        hard=record.number("HARD"),
        metallic=record.number("METALLIC"),
        fuzz=record.number("FUZZ"),
        fresnel=fresnel(index),
        beckmann=beckmann_maximum(rough),
        first_texture=first,
        texture_count=rows.count("textures") - first,
    )


def fresnel(index: float) -> float:
    """Reflectance at normal incidence, ((n - 1) / (n + 1))^2, of a refractive index of 1 or more (thesis 3.4)."""
    return ((index - 1.0) / (index + 1.0)) ** 2


def beckmann_maximum(rough: float) -> float:
    """The largest value over the angle b of exp(-tan^2 b / r^2) / (r^2 cos^4 b), for a roughness r of 0..1.

    By differentiation: at b = 0 while r^2 <= 1/2, else where cos^2 b = 1 / (2 r^2). Infinite for r = 0.
    """
    square = rough * rough
    if square == 0.0:
        return math.inf
    if square <= 0.5:
        return 1.0 / square
    return (2.0 * square) ** 2 * math.exp(-(2.0 * square - 1.0) / square) / square


def _texture(rows: Rows, record: Record) -> None:
    first_range, first_wave = rows.count("color_ranges"), rows.count("waves")
    colors = record.tables.get("COLORS")
    if colors is not None:
        for row, (start, end, *pair) in enumerate(colors.rows.tolist()):
            rows.add(
                "color_ranges",
                start=start,
                end=end,
                start_color=pair[:3],
                end_color=pair[3:],
                span=_ends(Placed(colors.place(row).start, colors.span.end)),
            )
    for wave in record.parts:
        rows.add(
            "waves",
            center=wave.vector("CENTER"),
            amplitude=wave.number("AMPLITUDE"),
            freq=wave.number("FREQ"),
            phase=wave.number("PHASE"),
            damp=wave.number("DAMP"),
            span=_ends(wave.span),
        )
    rows.add(
        "textures",
        kind=TextureKind[record.block],
        local=record.flag("LOCAL"),
        color=record.vector("COLOR"),
        turbulence=record.number("TURBULENCE"),
        squeeze=record.number("SQUEEZE"),
        scale=record.number("SCALE"),
        slope=record.number("SLOPE"),
        elevation=record.number("ELEVATION"),
        transform=record.transform.matrix,
        inverse=clean(record.transform.inverse),
        first_color_range=first_range,
        color_range_count=rows.count("color_ranges") - first_range,
        first_wave=first_wave,
        wave_count=rows.count("waves") - first_wave,
        span=_ends(record.span),
    )


# --- primitives ---------------------------------------------------------------------------------------------------


def _primitive(rows: Rows, record: Record, parent: Transform, *, solid: int = -1, light: int = -1) -> None:
    kind = PrimitiveKind[record.block]
    rows.add(
        "primitives",
        kind=kind,
        row=PRIMITIVES[kind].lower(rows, record, record.transform.then(parent)),
        solid=solid,
        light=light,
        transform=record.transform.matrix,
        inverse=clean(record.transform.inverse),
        span=_ends(record.span),
    )


def _extent(tables: dict[str, ir.Columns]) -> ir.Extent | None:
    points = [some for primitive in PRIMITIVES.values() for some in primitive.extent(tables) if len(some)]
    if not points:
        return None
    lowest = [min(float(some[:, axis].min()) for some in points) for axis in range(3)]
    highest = [max(float(some[:, axis].max()) for some in points) for axis in range(3)]
    return ir.Extent(_triple(np.array(lowest)), _triple(np.array(highest)))


# --- scene --------------------------------------------------------------------------------------------------------


def _globals(
    record: Record, sun: int, extent: ir.Extent | None, profile: ir.Columns, spans: dict[str, Span]
) -> ir.Globals:
    nested = record.nested
    ambient, haze = record.member("AMBIENT"), record.member("HAZE")
    sky, mirage = nested.get("SKY"), nested.get("MIRAGE")
    return ir.Globals(
        shadows=record.flag("SHADOWS"),
        log_scale=record.number("LOGSCALE"),
        depth=record.integer("DEPTH"),
        background=record.vector("BACKGROUND"),
        ambient=ir.Ambient(
            ambient.number("INTENSITY"),
            ambient.vector("COLOR"),
            ambient.integer("NSAMPLES"),
            ambient.integer("DEPTH"),
        ),
        haze=ir.Haze("HAZE" in nested, haze.number("INTENSITY"), haze.vector("COLOR"), haze.number("DENSITY")),
        sky=None if sky is None else _sky(sky, sun),
        mirage=None if mirage is None or not len(profile["elevation"]) else _mirage(mirage, profile),
        view=view(record.member("VIEW")),
        extent=extent,
        spans=spans,
    )


def _sky(record: Record, sun: int) -> ir.Sky:
    return ir.Sky(
        radius=record.number("RADIUS"),
        intensity=record.number("INTENSITY"),
        zenith_color=record.vector("ZENITHCOLOR"),
        horizon_color=record.vector("HORIZONCOLOR"),
        overcast=record.number("OVERCAST"),
        sun=sun,
    )


def _mirage(record: Record, profile: ir.Columns) -> ir.Mirage:
    return ir.Mirage(
        segments=record.integer("SEGMENTS"),
        distance=record.number("DISTANCE"),
        elevation=min(record.number("ELEVATION"), float(profile["elevation"][-1])),
    )


def view(record: Record) -> ir.View:
    """The camera's frame (thesis 3.2): VPN towards the target, VR = VPN x UP, VUP = VR x VPN; V_d = cot(FOV / 2)."""
    eye, target = np.array(record.vector("FROM")), np.array(record.vector("TO"))
    normal = unit(target - eye)
    vertical = normal[0] == normal[1] == 0.0
    up = np.array([float(np.sign(normal[2])), 0.0, 0.0]) if vertical else np.array([0.0, 0.0, 1.0])
    # Clockwise as the observer sees it: up leans towards the right. Rodrigues' formula about VPN.
    cos_tilt, sin_tilt = cosine_and_sine(record.number("TILT"))
    up = up * cos_tilt + np.cross(normal, up) * sin_tilt + normal * (normal @ up) * (1.0 - cos_tilt)
    right = unit(np.cross(normal, up))
    distance = 1.0 / math.tan(math.radians(record.number("FOV") / 2.0))
    width, height = record.integer("WIDTH"), record.integer("HEIGHT")
    region = record.values["REGION"]
    assert isinstance(region, tuple)
    top, left, bottom, right_edge = (int(edge) for edge in region)
    return ir.View(
        eye=_triple(eye),
        target=_triple(target),
        fov=record.number("FOV"),
        tilt=record.number("TILT"),
        width=width,
        height=height,
        aspect=record.number("ASPECT"),
        top=min(top, height - 1),
        left=min(left, width - 1),
        bottom=min(bottom, height - 1),
        right_edge=min(right_edge, width - 1),
        normal=_triple(normal),
        general_up=_triple(up),
        right=_triple(right),
        up=_triple(np.cross(right, normal)),
        reference_point=_triple(eye + normal * distance),
        distance=distance,
    )


def _triple(vector: NDArray[np.float64]) -> ir.Triple:
    x, y, z = (float(component) + 0.0 for component in vector)
    return x, y, z
