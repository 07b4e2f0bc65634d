"""How far things reach in the world: not farther than a picture of them can be exact.

What a scene says lies within 1e20 of the origin, as the language has it, but transformations can carry it anywhere.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from m3d_language.table import LANGUAGE

from ..diagnostics import Findings, Related, catalogue
from .transform import IDENTITY, Matrix, Transform
from .values import Record

FARTHEST = float(LANGUAGE.limits["reach"])

# Numbers of an object's and a primitive's matrix whose product is less carry nothing too far: what is within 3e20 in
# itself (a rectangle's fourth corner) is carried by the product of two 4x4 matrices to less than 16 times as far.
_HARMLESS = FARTHEST / (16 * 3e20)

_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])


def check_reach(record: Record, findings: Findings) -> None:
    """Report it if transformations carry something of a SOLID or LIGHT too far, once for each."""
    parent = record.transform
    size = _size(parent)
    for part in record.parts:
        if part.transform is IDENTITY and size < _HARMLESS:
            continue
        if "TRANSFORM" in record.broken | part.broken or size * _size(part.transform) < _HARMLESS:
            continue
        transform = part.transform.then(parent)
        related = () if _within(part, record) else (Related(part.span, f"this {part.block}"),)
        place = part.span if _within(part, record) else record.span
        if not transform.is_finite:
            findings.add_at(catalogue.NO_INVERSE, place, _BOTH, related=related)
            return
        reach = _reach(part, transform)
        if not reach <= FARTHEST:
            detail = f"with its transformations the {part.block} would reach to {_shown(reach)}"
            findings.add_at(catalogue.TOO_FAR, place, detail, related=related)
            return
    if record.block == "LIGHT":
        start = float(np.abs(parent.points(np.array(record.member("SOURCE").vector("FROM")))).max())
        if not start <= FARTHEST:
            findings.add_at(catalogue.TOO_FAR, record.span, f"transformed, its FROM would be at {_shown(start)}")


_BOTH = "with that of the primitive its numbers are too large or too small"


def _size(transform: Transform) -> float:
    """The largest number of the matrix or its inverse."""
    return 1.0 if transform is IDENTITY else float(max(np.abs(transform.matrix).max(), np.abs(transform.inverse).max()))


def _within(part: Record, record: Record) -> bool:
    return record.span.start <= part.span.start and part.span.end <= record.span.end


def _reach(part: Record, transform: Transform) -> float:
    """The largest coordinate, without its sign, that a primitive has in the world; NaN or infinite if it has none."""
    if part.block == "SPHERE":
        radius = part.number("RADIUS") * transform.length()
        return float(np.abs(transform.points(np.array(part.vector("CENTER")))).max()) + radius
    return float(np.abs(transform.points(_corners(part))).max(initial=0.0))


def _corners(part: Record) -> Matrix:
    """Points (n, 3) between which a primitive lies, in its own coordinates."""
    if part.block in ("POLYGONS", "TERRAIN"):
        vertices = part.mesh.vertices if part.mesh is not None else np.zeros((0, 3))
        return _box(vertices) if len(vertices) else vertices
    first, second, third = (np.array(part.vector(f"VERTEX{n}")) for n in (1, 2, 3))
    return np.stack([first, second, third, first + third - second])


def _box(points: NDArray[np.float64]) -> Matrix:
    lowest, highest = points.min(axis=0), points.max(axis=0)
    return lowest + _CORNERS * (highest - lowest)


def _shown(reach: float) -> str:
    return f"{reach:g}" if np.isfinite(reach) else "more than 1.8e308"
