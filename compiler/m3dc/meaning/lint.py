"""What is right as far as the language goes, but probably not what was meant: looked for in a scene without errors.

One function a finding: in `ITEM_LINTS` where the text of an item tells, in `OBJECT_LINTS` where it asks for a single
object, in `SCENE_LINTS` otherwise. What has no effect is the subject of effects.py, of values that nothing uses
assignments.py, and of numbers in another unit units.py. What can be seen while checking or evaluating is found there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from m3d_language.table import LANGUAGE

from ..diagnostics import Findings, ItemFindings, catalogue
from ..text.span import Base
from . import program
from .assignments import Usage, report_unused_values, usage
from .effects import NEEDS, Weighed, report_idle, report_unused_of_textures, weighed
from .evaluate import World
from .memo import Ledger, Steps
from .primitive import Ball, Primitive, primitive_of
from .transform import IDENTITY, Transform, unit
from .units import Angle, angles, report_kelvin, report_radians
from .values import Record

_T = TypeVar("_T")

NEAR_BOUNDARY = 1e-4  # metres
_MOST_SAMPLED = 2  # the least DEPTH of AMBIENT at which anything is sampled: the first surface's level is 1
_BENT = math.radians(2)  # more than air bends a ray that leaves the eye


class _Facts(NamedTuple):
    """What the text of an item tells the lints of the whole scene."""

    usage: Usage
    angles: tuple[Angle, ...]


class _Shape(NamedTuple):
    """A primitive in the scene: its record, the transformation that takes it there, what is known of its kind, and a
    ball about it."""

    record: Record
    transform: Transform
    kind: Primitive
    ball: Ball

    def reaches_into(self, ball: Ball) -> bool:
        """Whether it may have points within a ball."""
        return self.kind.reaches_into(self.record, self.transform, self.ball, ball)


class _Looked(NamedTuple):
    """What the lints of the whole scene ask of an object."""

    shapes: list[_Shape]
    pieces: list[Weighed]


def lint(world: World, items: Iterable[program.Item], findings: Findings, steps: Steps | None = None) -> None:
    """Report everything suspicious about a scene. With the `steps` of a run before, only items and objects that changed
    are looked at for what is in themselves."""
    nothing: Ledger[object] = Ledger()  # what is looked at by itself asks for nothing else

    def once(of: object, work: Callable[[], _T]) -> _T:
        return work() if steps is None else steps.do(id(of), of, work, findings, nothing)

    facts: list[tuple[Base, _Facts]] = []
    for item in items:
        facts.append((item.base, once(item.content, partial(_lint_item, item, findings))))
    report_unused_values(((base, each.usage) for base, each in facts), findings)
    report_radians(((base, each.angles) for base, each in facts if each.angles), findings)
    shapes: list[_Shape] = []
    pieces: list[Weighed] = []
    for thing in (*world.solids, *world.lights):
        looked = once(thing, partial(_lint_object, thing, findings))
        shapes += looked.shapes
        pieces += looked.pieces
    report_idle(pieces, findings)
    for look in SCENE_LINTS:
        look(world, shapes, findings)


def _lint_item(item: program.Item, findings: Findings) -> _Facts:
    content = item.content
    match content:
        case program.Block():
            body: tuple[program.Member, ...] = (content,)
        case program.Assignment():
            body = content.body or ()
        case _:
            body = ()
    of_item = ItemFindings(findings, item.base)
    for block in program.blocks(body):
        for look in ITEM_LINTS:
            look(block, of_item)
    return _Facts(usage(content), tuple(angles(body)))


def _lint_object(thing: Record, findings: Findings) -> _Looked:
    """Looks at an object by itself."""
    for look in OBJECT_LINTS:
        look(thing, findings)
    shapes = [_shape(part, transform) for part, transform in _primitives(thing)]
    pieces = [*_statements(thing), *_blends(thing), *_normals(thing)]
    return _Looked(shapes, pieces)


def _shape(part: Record, transform: Transform) -> _Shape:
    kind = primitive_of(part)
    return _Shape(part, transform, kind, kind.ball(part, transform))


def _no_light(world: World, _shapes: list[_Shape], findings: Findings) -> None:
    if world.solids and not world.lights:
        findings.add_at(catalogue.NO_LIGHT, world.solids[0].span, "add a LIGHT, or a SKY with its sun")


def _boundary(world: World, _shapes: list[_Shape], findings: Findings) -> None:
    mirage = world.scene.nested.get("MIRAGE")
    if mirage is None:
        return
    view = world.scene.member("VIEW")
    height = view.vector("FROM")[2]
    for elevation in mirage.tables["PROFILE"].rows[:, 0].tolist():
        if abs(elevation - height) < NEAR_BOUNDARY:
            detail = f"the eye is at {height:g}, the PROFILE has a point at {elevation:g}; move either a little"
            findings.add_at(catalogue.EYE_ON_LAYER_BOUNDARY, view.place("FROM"), detail)


def _segments(world: World, _shapes: list[_Shape], findings: Findings) -> None:
    mirage = world.scene.nested.get("MIRAGE")
    if mirage is not None and mirage.integer("SEGMENTS") > LANGUAGE.limits["segments"]:
        findings.add_at(catalogue.TOO_MANY_SEGMENTS, mirage.place("SEGMENTS"), "the rest of it has no effect")


def _textures(thing: Record) -> Sequence[Record]:
    surface = thing.nested.get("SURFACE")
    textures = None if surface is None else surface.nested.get("TEXTURE")
    return () if textures is None else textures.parts


def _texture_stays(thing: Record, findings: Findings) -> None:
    if thing.transform is IDENTITY:
        return
    for texture in _textures(thing):
        if not texture.flag("LOCAL") and NEEDS[texture.block] in ("place", "waves"):
            findings.add_at(catalogue.TEXTURE_STAYS, texture.span, "LOCAL would tie it to the object")


def _no_waves(thing: Record, findings: Findings) -> None:
    for texture in _textures(thing):
        if NEEDS[texture.block] == "waves" and not texture.parts:
            detail = "give it a source: WAVE { CENTER < 0, 0, 0 > FREQ 1 }"
            findings.add_at(catalogue.NO_WAVE, texture.span, detail, fill=texture.block)


def _statements(thing: Record) -> Iterator[Weighed]:
    """Those of the surface or the source."""
    for record in thing.nested.values():
        yield from weighed(record)


def _blends(thing: Record) -> Iterator[Weighed]:
    """UBLEND and VBLEND go by the u and v of primitives."""
    blank = all(primitive_of(part).is_endless for part in thing.parts)
    for texture in _textures(thing):
        if NEEDS[texture.block] == "uv":
            axis = "u" if texture.block == "UBLEND" else "v"
            detail = f"a PLANE is endless and has no {axis}; a RECTANGLE has one"
            yield Weighed(texture.span, (catalogue.BLEND_ON_PLANE, detail, texture.block) if blank else None)


def _normals(thing: Record) -> Iterator[Weighed]:
    """PHONG interpolates normals, which FACETS does not give."""
    for record in _meshes(thing):
        assert record.mesh is not None
        if record.flag("PHONG"):
            detail = "FACETS gives no normals, so that facets stay flat; SFACETS gives one at each corner"
            yield Weighed(
                record.place("PHONG"),
                None if len(record.mesh.normals) else (catalogue.PHONG_WITHOUT_NORMALS, detail, ""),
            )


def _primitives(thing: Record) -> Iterator[tuple[Record, Transform]]:
    """Every primitive of an object with the transformation that takes it into the scene."""
    for part in thing.parts:
        yield part, part.transform.then(thing.transform)


def _stretched_sphere(thing: Record, findings: Findings) -> None:
    for part, transform in _primitives(thing):
        if part.block != "SPHERE":
            continue
        factors = transform.stretches()
        if factors.max() > factors.min() * (1 + 1e-6):
            shown = ", ".join(f"{factor:g}" for factor in factors)
            detail = f"scaled by {shown} its radius becomes {part.number('RADIUS') * factors.max():g}"
            findings.add_at(catalogue.STRETCHED_SPHERE, part.span, detail)


def _meshes(thing: Record) -> Iterator[Record]:
    return (part for part in thing.parts if part.block == "POLYGONS" and part.mesh is not None)


def _unused_vertices(thing: Record, findings: Findings) -> None:
    for record in _meshes(thing):
        assert record.mesh is not None
        used = np.zeros(len(record.mesh.vertices), bool)
        used[record.mesh.facets.ravel()] = True
        unused = np.flatnonzero(~used)
        if unused.size:
            vertices = record.tables["VERTICES"]
            others = f" and {unused.size - 1} more" if unused.size > 1 else ""
            findings.add_at(catalogue.UNUSED_VERTICES, vertices.place(int(unused[0])), f"vertex {unused[0]}{others}")


def _wrong_side(thing: Record, findings: Findings) -> None:
    for record in _meshes(thing):
        mesh = record.mesh
        assert mesh is not None
        if not record.flag("PHONG") or not len(mesh.normals):
            continue
        a, b, c = (mesh.vertices[mesh.facets[:, corner]] for corner in range(3))
        facing = np.cross(b - a, c - a)
        against = (np.einsum("ij,ikj->ik", facing, mesh.normals[mesh.normal_rows]) < 0).any(axis=1)
        wrong = np.flatnonzero(against)
        if wrong.size:
            others = f" and {wrong.size - 1} more" if wrong.size > 1 else ""
            findings.add_at(catalogue.NORMAL_ON_WRONG_SIDE, mesh.place(int(wrong[0])), f"facet {wrong[0]}{others}")


def _light_reaches_nothing(world: World, shapes: list[_Shape], findings: Findings) -> None:
    """A point light reaches something if its cone meets the ball about some primitive. Planes are everywhere."""
    for light in world.lights:
        source = light if light.block == "SUN" else light.member("SOURCE")
        if source.number("INTENSITY") == 0 or not any(source.vector("COLOR")):
            findings.add_at(catalogue.LIGHT_REACHES_NOTHING, source.span, "it has no intensity or is black")
        elif _is_narrow(source) and world.solids and not any(_reaches(light, source, shape) for shape in shapes):
            findings.add_at(catalogue.LIGHT_REACHES_NOTHING, source.span, "it shines past every solid")


def _is_narrow(source: Record) -> bool:
    """Whether a light leaves some directions dark."""
    point = source.block == "SOURCE" and not source.flag("INFINITE")
    return point and (source.number("ANGLE") < 180 or source.number("EXPONENT") > 0)


def _reaches(light: Record, source: Record, shape: _Shape) -> bool:
    """Whether the cone of a point light meets a primitive, or at least the ball about it."""
    if shape.kind.is_endless:
        return True
    half_angle = min(source.number("ANGLE"), 90.0 if source.number("EXPONENT") > 0 else 180.0)
    axis = unit(light.transform.ways(np.array(source.vector("DIRECTION"))))
    return _meets_cone(_position(light), axis, math.radians(half_angle), shape.ball)


def _is_point(light: Record) -> bool:
    return light.block == "LIGHT" and not light.member("SOURCE").flag("INFINITE")


def _position(light: Record) -> NDArray[np.float64]:
    """Where a point light stands in the scene."""
    return light.transform.points(np.array(light.member("SOURCE").vector("FROM")))


def _meets_cone(apex: NDArray[np.float64], axis: NDArray[np.float64], half_angle: float, ball: Ball) -> bool:
    """Whether a cone about a unit vector meets a ball."""
    offset = ball.centre - apex
    distance = float(np.sqrt(offset @ offset))
    if distance <= ball.radius:
        return True
    away = math.acos(max(-1.0, min(1.0, float(offset @ axis) / distance)))
    return away - math.asin(ball.radius / distance) <= half_angle


def _hidden_background(world: World, _shapes: list[_Shape], findings: Findings) -> None:
    """What is seen where a ray meets nothing: a sky, or else the haze, or else the BACKGROUND (thesis 7.5.5.1)."""
    scene = world.scene
    instead = next((keyword for keyword in ("SKY", "HAZE") if keyword in scene.nested), None)
    if instead is not None and any(scene.vector("BACKGROUND")):
        findings.add_at(
            catalogue.BACKGROUND_NEVER_SEEN, scene.place("BACKGROUND"), f"the {instead} is seen in its place"
        )


def _nothing_sampled(world: World, _shapes: list[_Shape], findings: Findings) -> None:
    ambient = world.scene.nested.get("AMBIENT")
    if ambient is None:
        return
    samples, depth = ambient.integer("NSAMPLES"), ambient.integer("DEPTH")
    if samples and depth < _MOST_SAMPLED:
        detail = f"NSAMPLES is {samples} and DEPTH {depth}; with a DEPTH of 2 the surfaces that the eye sees sample"
        findings.add_at(catalogue.AMBIENT_NOT_SAMPLED, ambient.place("NSAMPLES"), detail)
    elif depth and not samples:
        detail = f"DEPTH is {depth} and NSAMPLES 0; 4 to 16 samples are reasonable"
        findings.add_at(catalogue.AMBIENT_NOT_SAMPLED, ambient.place("DEPTH"), detail)


def _no_shadows_at_all(world: World, _shapes: list[_Shape], findings: Findings) -> None:
    if world.scene.flag("SHADOWS"):
        return
    for light in world.lights:
        source = light if light.block == "SUN" else light.member("SOURCE")
        if source.flag("NOSHADOWS"):
            detail = "no light casts shadows unless the SCENE says SHADOWS"
            findings.add_at(catalogue.NOSHADOWS_WITHOUT_SHADOWS, source.place("NOSHADOWS"), detail)


def _no_heights(world: World, shapes: list[_Shape], findings: Findings) -> None:
    """Heights go from the lowest to the highest point of all that is not endless."""
    if not all(shape.kind.is_endless for shape in shapes):
        return
    for thing in world.solids:
        for texture in _textures(thing):
            if NEEDS[texture.block] == "heights":
                detail = "it goes by the heights of the scene, in which a PLANE does not count"
                findings.add_at(catalogue.HEIGHTS_OF_PLANES, texture.span, detail, fill=texture.block)


def _kelvin(world: World, _shapes: list[_Shape], findings: Findings) -> None:
    mirage = world.scene.nested.get("MIRAGE")
    if mirage is not None:
        report_kelvin(mirage.tables["PROFILE"], findings)


def _nothing_before_the_camera(world: World, shapes: list[_Shape], findings: Findings) -> None:
    """Whether the cone about the picture misses the balls about all primitives."""
    record = world.scene.member("VIEW")
    eye = np.array(record.vector("FROM"))
    axis = unit(np.array(record.vector("TO")) - eye)
    taller = max(1.0, record.number("ASPECT") * record.number("HEIGHT") / record.number("WIDTH"))
    half_angle = math.atan(math.tan(math.radians(record.number("FOV") / 2)) * math.hypot(1.0, taller)) + _BENT
    if not shapes or any(shape.kind.is_endless or _meets_cone(eye, axis, half_angle, shape.ball) for shape in shapes):
        return
    place = record.places.get("TO") or record.places.get("FROM") or shapes[0].record.span
    (x, y, z), (tx, ty, tz) = record.vector("FROM"), record.vector("TO")
    detail = f"the eye at {x:g}, {y:g}, {z:g} looks to {tx:g}, {ty:g}, {tz:g}, past every solid"
    findings.add_at(catalogue.NOTHING_IN_VIEW, place, detail)


def _inside(world: World, shapes: list[_Shape], findings: Findings) -> None:
    """Whether the eye is in a sphere that nothing else reaches into, and no light stands in: it hides all that there
    is. A sphere about the whole scene is a sky."""
    view = world.scene.member("VIEW")
    eye = np.array(view.vector("FROM"))
    for number, shape in enumerate(shapes):
        centre, radius = shape.ball
        if shape.record.block != "SPHERE" or not math.dist(centre, eye) < radius:
            continue
        if any(other.reaches_into(shape.ball) for other in (*shapes[:number], *shapes[number + 1 :])):
            continue
        lamps = (_position(light) for light in world.lights if _is_point(light))
        if not any(math.dist(lamp, centre) < radius for lamp in lamps):
            place = view.places.get("FROM", shape.record.span)
            findings.add_at(
                catalogue.EYE_IN_SPHERE, place, f"within {radius:g} of its centre; it hides everything else"
            )
            return


ITEM_LINTS: tuple[Callable[[program.Block, ItemFindings], None], ...] = (report_unused_of_textures,)
SCENE_LINTS: tuple[Callable[[World, list[_Shape], Findings], None], ...] = (
    _no_light,
    _light_reaches_nothing,
    _boundary,
    _segments,
    _hidden_background,
    _nothing_sampled,
    _no_shadows_at_all,
    _no_heights,
    _kelvin,
    _nothing_before_the_camera,
    _inside,
)
OBJECT_LINTS: tuple[Callable[[Record, Findings], None], ...] = (
    _texture_stays,
    _no_waves,
    _stretched_sphere,
    _unused_vertices,
    _wrong_side,
)
