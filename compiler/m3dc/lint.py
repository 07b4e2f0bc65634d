"""What is right as far as the language goes, but probably not what was meant: looked for in a scene without errors.

One function a finding, in `SCENE_LINTS`, or in `OBJECT_LINTS` where it asks for a single object. What can be seen from
the text alone is found by check.py and evaluate.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from tree_sitter_m3d.table import LANGUAGE

from .diagnostics import Findings
from .evaluate import World
from .memo import Ledger, Steps
from .transform import IDENTITY, Transform, unit
from .values import Record

NEAR_BOUNDARY = 1e-4  # metres
# Textures that do not depend on where their object stands, or mean the scene's heights and nothing else.
_PLACELESS = {"UBLEND", "VBLEND", "SNOW", "GRADIENT"}


def lint(world: World, findings: Findings, steps: Steps | None = None) -> None:
    """Report everything suspicious about a scene. With the `steps` of a run before, only objects that changed are
    looked at for what is in themselves."""
    for look in SCENE_LINTS:
        look(world, findings)
    nothing: Ledger[object] = Ledger()  # an object's lints ask for nothing but the object
    for thing in (*world.solids, *world.lights):
        if steps is None:
            _lint_object(thing, findings)
        else:
            steps.do(id(thing), thing, partial(_lint_object, thing, findings), findings, nothing)


def _lint_object(thing: Record, findings: Findings) -> None:
    for look in OBJECT_LINTS:
        look(thing, findings)


def _no_light(world: World, findings: Findings) -> None:
    if world.solids and not world.lights:
        findings.add_at("M3D0513", world.solids[0].span, "add a LIGHT, or a SKY with its sun")


def _boundary(world: World, findings: Findings) -> None:
    mirage = world.scene.nested.get("MIRAGE")
    if mirage is None:
        return
    view = world.scene.member("VIEW")
    height = view.vector("FROM")[2]
    for elevation in mirage.tables["PROFILE"].rows[:, 0].tolist():
        if abs(elevation - height) < NEAR_BOUNDARY:
            detail = f"the eye is at {height:g}, the PROFILE has a point at {elevation:g}; move either a little"
            findings.add_at("M3D0506", view.place("FROM"), detail)


def _segments(world: World, findings: Findings) -> None:
    mirage = world.scene.nested.get("MIRAGE")
    if mirage is not None and mirage.integer("SEGMENTS") > LANGUAGE.limits["segments"]:
        findings.add_at("M3D0508", mirage.place("SEGMENTS"), "the rest of it has no effect")


def _texture_stays(thing: Record, findings: Findings) -> None:
    surface = thing.nested.get("SURFACE")
    textures = None if surface is None else surface.nested.get("TEXTURE")
    if textures is None or thing.transform is IDENTITY:
        return
    for texture in textures.parts:
        if not texture.flag("LOCAL") and texture.block not in _PLACELESS:
            findings.add_at("M3D0507", texture.span, "LOCAL would tie it to the object")


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
            findings.add_at("M3D0509", part.span, detail)


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
            findings.add_at("M3D0510", vertices.place(int(unused[0])), f"vertex {unused[0]}{others}")


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
            findings.add_at("M3D0511", mesh.place(int(wrong[0])), f"facet {wrong[0]}{others}")


def _light_reaches_nothing(world: World, findings: Findings) -> None:
    """A point light reaches something if its cone meets the ball about some primitive. Planes are everywhere."""
    for light in world.lights:
        source = light if light.block == "SUN" else light.member("SOURCE")
        if source.number("INTENSITY") == 0 or not any(source.vector("COLOR")):
            findings.add_at("M3D0505", source.span, "it has no intensity or is black")
        elif _is_narrow(source) and world.solids and not any(_reaches(light, source, *p) for p in _everything(world)):
            findings.add_at("M3D0505", source.span, "it shines past every solid")


def _everything(world: World) -> Iterator[tuple[Record, Transform]]:
    """Every primitive of a scene, likewise."""
    for thing in (*world.solids, *world.lights):
        yield from _primitives(thing)


def _is_narrow(source: Record) -> bool:
    """Whether a light leaves some directions dark."""
    point = source.block == "SOURCE" and not source.flag("INFINITE")
    return point and (source.number("ANGLE") < 180 or source.number("EXPONENT") > 0)


def _reaches(light: Record, source: Record, part: Record, transform: Transform) -> bool:
    """Whether the cone of a point light meets a primitive, or at least the ball about it."""
    if part.block == "PLANE":
        return True
    half_angle = min(source.number("ANGLE"), 90.0 if source.number("EXPONENT") > 0 else 180.0)
    position = light.transform.points(np.array(source.vector("FROM")))
    axis = unit(light.transform.ways(np.array(source.vector("DIRECTION"))))
    centre, radius = _ball(part, transform)
    offset = centre - position
    distance = float(np.sqrt(offset @ offset))
    if distance <= radius:
        return True
    away = math.acos(max(-1.0, min(1.0, float(offset @ axis) / distance)))
    return away - math.asin(radius / distance) <= math.radians(half_angle)


def _ball(part: Record, transform: Transform) -> tuple[NDArray[np.float64], float]:
    """Centre and radius of a ball about a finite primitive, in the scene."""
    if part.block == "SPHERE":
        return transform.points(np.array(part.vector("CENTER"))), part.number("RADIUS") * transform.length()
    if part.mesh is not None:
        points = part.mesh.vertices
    else:
        first, second, third = (np.array(part.vector(f"VERTEX{n}")) for n in (1, 2, 3))
        points = np.array([first, second, third, first + third - second])
    points = transform.points(points)
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    return centre, float(np.sqrt(((points - centre) ** 2).sum(axis=1).max()))


SCENE_LINTS: tuple[Callable[[World, Findings], None], ...] = (_no_light, _light_reaches_nothing, _boundary, _segments)
OBJECT_LINTS: tuple[Callable[[Record, Findings], None], ...] = (
    _texture_stays,
    _stretched_sphere,
    _unused_vertices,
    _wrong_side,
)
