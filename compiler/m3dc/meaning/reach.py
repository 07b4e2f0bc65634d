"""How far things reach in the world: not farther than a picture of them can be exact.

What a scene says lies within 1e20 of the origin, as the language has it, but transformations can carry it anywhere.
"""

from __future__ import annotations

import numpy as np

from ..columns.column import FARTHEST
from ..diagnostics import Findings, Related, catalogue
from .primitive import primitive_of
from .transform import IDENTITY, Transform
from .values import Record

# Numbers of an object's and a primitive's matrix whose product is less carry nothing too far: what is within 3e20 in
# itself (a rectangle's fourth corner) is carried by the product of two 4x4 matrices to less than 16 times as far.
_HARMLESS = FARTHEST / (16 * 3e20)


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
        reach = primitive_of(part).reach(part, transform)
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


def _shown(reach: float) -> str:
    return f"{reach:g}" if np.isfinite(reach) else "more than 1.8e308"
