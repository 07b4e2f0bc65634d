"""A primitive of every kind, of about one scene unit, standing on the ground at x = 20 across the view."""

from __future__ import annotations

from m3dc.ir import PrimitiveKind

PRIMITIVES = {
    PrimitiveKind.SPHERE: "SPHERE { CENTER < 20, 0, 1 > RADIUS 1 }",
    PrimitiveKind.PLANE: "PLANE { }",
    PrimitiveKind.TRIANGLE: "TRIANGLE { VERTEX1 < 20, -1, 0 > VERTEX2 < 20, 1, 0 > VERTEX3 < 20, 0, 2 > }",
    PrimitiveKind.RECTANGLE: "RECTANGLE { VERTEX1 < 20, -1, 0 > VERTEX2 < 20, 1, 0 > VERTEX3 < 20, 1, 2 > }",
    PrimitiveKind.POLYGONS: "POLYGONS { VERTICES { 3 < 20, -1, 0 > < 20, 1, 0 > < 20, 0, 2 > } FACETS { 1 0 1 2 } }",
    PrimitiveKind.TERRAIN: "TERRAIN { VERTICES { 2 2 < 20, -1, 0 > < 20, 1, 0 > < 22, -1, 2 > < 22, 1, 2 > } }",
}

ENDLESS = {PrimitiveKind.PLANE}
"""The kinds that have no extent."""


def scene(kind: PrimitiveKind) -> str:
    """A solid of one primitive, looked at from 1 above the ground."""
    return (
        "SCENE { VIEW { FROM < 0, 0, 1 > TO < 20, 0, 1 > FOV 10 WIDTH 32 HEIGHT 20 } }\n"
        "LIGHT { SOURCE { FROM < 0, 0, 9 > TO < 20, 0, 0 > POINT } }\n"
        f"SOLID {{ {PRIMITIVES[kind]} SURFACE {{ COLOR < 1, 0.5, 0 > }} }}\n"
    )
