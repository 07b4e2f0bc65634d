"""How large a scene is: how many rows its IR has, which a few words can make many (`SOLID forest` is a copy of it)."""

from __future__ import annotations

from typing import NamedTuple

from m3d_language.table import LANGUAGE

from .values import Record


class Size(NamedTuple):
    """How many parts (solids, lights, primitives, textures, waves, colour ranges) and how many vertices and facets."""

    parts: int = 0
    facets: int = 0

    def plus(self, record: Record) -> Size:
        """With a SOLID or LIGHT more."""
        parts, facets = self.parts + 1 + len(record.parts), self.facets
        for part in record.parts:
            if part.mesh is not None:
                facets += len(part.mesh.facets) + len(part.mesh.vertices)
        surface = record.nested.get("SURFACE")
        textures = None if surface is None else surface.nested.get("TEXTURE")
        for texture in () if textures is None else textures.parts:
            colors = texture.tables.get("COLORS")
            parts += 1 + len(texture.parts) + (0 if colors is None else len(colors.rows))
        return Size(parts, facets)

    @property
    def excess(self) -> tuple[str, str] | None:
        """What there is too much of, and a sentence about it; None where a scene may be so large."""
        if self.parts > LANGUAGE.limits["parts"]:
            what = "solids, primitives and textures"
            return what, f"with this there are {self.parts:,}, at most {LANGUAGE.limits['parts']:,}"
        if self.facets > LANGUAGE.limits["facets"]:
            what = "vertices and facets"
            return what, f"with this there are {self.facets:,}, at most {LANGUAGE.limits['facets']:,}"
        return None
