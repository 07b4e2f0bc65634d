"""What a block comes to in the scene, in Markdown: matrices, places, extents, directions."""

from __future__ import annotations

import math

import numpy as np

from m3dc.analysis import Analysis, Enclosing
from m3dc.ir import Extent, PrimitiveKind
from m3dc.ir.lower import shapes, view
from m3dc.meaning.primitive import Fact, primitive_of
from m3dc.meaning.transform import IDENTITY, Transform, unit
from m3dc.meaning.values import Record

from .markdown import matrix
from .summary import number, vector

# What is asked about may be wrong: its numbers, too, and they are shown as they are.
_HOWEVER_LARGE = np.errstate(all="ignore")
_KINDS = {kind.name for kind in PrimitiveKind}


@_HOWEVER_LARGE
def facts(analysis: Analysis, here: Enclosing, keyword: str) -> str:
    """What the block that begins with a keyword, the innermost around a place, comes to; '' if nothing is known."""
    record = here.innermost
    if keyword == "TRANSFORM":
        return transformation(here)
    if keyword in _KINDS and record.block == keyword:
        return _primitive(analysis, here, record)
    if keyword in ("SOLID", "LIGHT") and record.block == keyword:
        return _object(analysis, record)
    if keyword in ("SUN", "SOURCE") and record.block == keyword:
        return _light(here, record)
    if keyword == "VIEW" and record.block == keyword:
        return _view(record)
    return ""


@_HOWEVER_LARGE
def transformation(here: Enclosing) -> str:
    """The matrix that the statements up to a place make, and that of the innermost record in the scene."""
    scene = in_scene(here)
    parts = ["Up to here, points (as rows) are multiplied by", matrix(here.transform.matrix.tolist())]
    if not np.array_equal(scene.matrix, here.transform.matrix):
        parts += [f"and with all of the {here.whole.block} by", matrix(scene.matrix.tolist())]
    parts.append(f"The origin goes to `{vector(scene.points(np.zeros(3)))}`.")
    return "\n\n".join(parts)


def in_scene(here: Enclosing) -> Transform:
    """What takes the innermost record's own coordinates to those of the scene, or of the variable assigned to."""
    outer = here.whole.transform if len(here.records) > 1 and here.whole.block in ("SOLID", "LIGHT") else IDENTITY
    return here.transform.then(outer)


def of_transform(transform: Transform) -> str:
    """A matrix, and where it takes the origin."""
    return f"{matrix(transform.matrix.tolist())}\n\nThe origin goes to `{vector(transform.points(np.zeros(3)))}`."


@_HOWEVER_LARGE
def point(here: Enclosing, value: tuple[float, float, float]) -> str:
    """Where a point of a primitive is in the scene; '' if it is not moved."""
    transform = in_scene(here)
    if here.innermost.block not in _KINDS or transform is IDENTITY:
        return ""
    return f"{_where(here)} `{vector(transform.points(np.array(value)))}`"


def _where(here: Enclosing) -> str:
    return "In the scene:" if here.whole.block in ("SOLID", "LIGHT") and not here.is_variable else "Moved to:"


def _primitive(analysis: Analysis, here: Enclosing, record: Record) -> str:
    transform = here.whole.transform if len(here.records) > 1 else IDENTITY
    shape = shapes((record,), transform, analysis.places)
    lines = [", ".join(map(_fact, line)) for line in primitive_of(record).facts(shape.tables, 0)]
    lines += _extent(shape.extent)
    where = "With its transform" if here.is_variable else "In the scene"
    return f"{where}:\n\n" + _list(lines) + _matrix(in_scene(here))


def _fact(fact: Fact) -> str:
    """Such as "radius `2`", or "8 vertices"."""
    shown: list[str] = []
    for value in fact.values:
        if isinstance(value, int):
            return f"{value} {fact.what}"
        shown.append(f"`{number(value) if isinstance(value, float) else vector(value)}`")
    return f"{fact.what} {', '.join(shown)}"


def _object(analysis: Analysis, record: Record) -> str:
    counts: dict[str, int] = {}
    for part in record.parts:
        counts[part.block] = counts.get(part.block, 0) + 1
    lines = [", ".join(f"{count} {keyword}" for keyword, count in counts.items())] if counts else []
    lines += _extent(shapes(record.parts, record.transform, analysis.places).extent)
    return f"In the scene:\n\n{_list(lines)}{_matrix(record.transform)}" if lines else ""


def _light(here: Enclosing, record: Record) -> str:
    direction = unit(np.array(record.vector("DIRECTION")))
    if here.whole.block == "LIGHT":
        direction = unit(here.whole.transform.ways(direction))
    lines = [f"shines along `{vector(direction)}`"]
    down: float = direction.tolist()[2]
    elevation = math.degrees(math.asin(max(-1.0, min(1.0, -down))))
    lines.append(f"its light comes from {number(elevation)} degrees above the horizon")
    if record.block == "SOURCE" and not record.flag("INFINITE"):
        lines[1] = f"stands at `{vector(here.whole.transform.points(np.array(record.vector('FROM'))))}`"
    return _list(lines)


def _view(record: Record) -> str:
    camera = view(record)
    height = 2 * math.degrees(
        math.atan(math.tan(math.radians(camera.fov / 2)) * camera.height / camera.width * camera.aspect)
    )
    distance = math.dist(camera.eye, camera.target)
    return _list([
        f"looks along `{vector(camera.normal)}`; the point looked at is {number(distance)} away",
        f"field of view {number(camera.fov)} x {number(height)} degrees",
        f"{camera.width} x {camera.height} pixels, each {camera.fov * 60 / camera.width:.3g} arcminutes wide",
    ])  # fmt: skip


def _extent(extent: Extent | None) -> list[str]:
    if extent is None:
        return []
    sides = zip("xyz", extent.minimum, extent.maximum, strict=True)
    return ["extents " + ", ".join(f"{name} `{number(low)}` to `{number(high)}`" for name, low, high in sides)]


def _matrix(transform: Transform) -> str:
    return "" if transform is IDENTITY else "\n\n" + matrix(transform.matrix.tolist())


def _list(lines: list[str]) -> str:
    return "\n".join(f"- {line}" for line in lines)
