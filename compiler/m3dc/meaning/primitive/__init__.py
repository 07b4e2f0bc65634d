"""The kinds of primitives, and what each is to the compiler.

One module for kinds that are alike: `sphere`, `planar` (planes, triangles and rectangles) and `mesh` (polygons and
terrain). `primitive` says what there is to know of a kind. Who asks it of all kinds alike never names one.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import assert_never

from ..values import Record
from . import mesh, planar, sphere
from .primitive import Ball, Fact, Field, Finish, Listing, Primitive

__all__ = [
    "PRIMITIVES",
    "Ball",
    "Fact",
    "Field",
    "Finish",
    "Listing",
    "Primitive",
    "PrimitiveKind",
    "primitive_of",
]


class PrimitiveKind(IntEnum):
    """What a row of `primitives` is, and so which table its `row` points into."""

    SPHERE = 0
    PLANE = 1
    TRIANGLE = 2
    RECTANGLE = 3
    POLYGONS = 4
    TERRAIN = 5


def _primitive(kind: PrimitiveKind) -> Primitive:
    match kind:
        case PrimitiveKind.SPHERE:
            return sphere.SPHERE
        case PrimitiveKind.PLANE:
            return planar.PLANE
        case PrimitiveKind.TRIANGLE:
            return planar.TRIANGLE
        case PrimitiveKind.RECTANGLE:
            return planar.RECTANGLE
        case PrimitiveKind.POLYGONS:
            return mesh.POLYGONS
        case PrimitiveKind.TERRAIN:
            return mesh.TERRAIN
        case _:
            assert_never(kind)


PRIMITIVES: Mapping[PrimitiveKind, Primitive] = {kind: _primitive(kind) for kind in PrimitiveKind}


def primitive_of(record: Record) -> Primitive:
    """What the record of a primitive is."""
    return PRIMITIVES[PrimitiveKind[record.block]]
