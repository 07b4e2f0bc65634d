"""A primitive of every kind: the example that the language table has of it, moved to x = 20 across the view."""

from __future__ import annotations

from m3d_language.table import LANGUAGE
from m3dc.ir import PrimitiveKind
from m3dc.meaning.primitive import PRIMITIVES

ENDLESS = {kind for kind, primitive in PRIMITIVES.items() if primitive.is_endless}
"""The kinds that have no extent."""

LIGHT = "LIGHT { SOURCE { FROM < 0, 0, 9 > TO < 20, 0, 0 > POINT } }"


def solid(kind: PrimitiveKind) -> str:
    """A solid of one primitive."""
    example = LANGUAGE.blocks[kind.name].example
    return f"SOLID {{ {example} SURFACE {{ COLOR < 1, 0.5, 0 > }} TRANSFORM {{ TRANSX 20 }} }}\n"


def scene(kind: PrimitiveKind) -> str:
    """That solid, looked at from above the ground, and a light."""
    view = "SCENE { VIEW { FROM < 0, 0.5, 9 > TO < 20, 0.5, 1 > FOV 40 WIDTH 32 HEIGHT 20 } }"
    return f"{view}\n{LIGHT}\n{solid(kind)}"
