"""Adding a light to a scene that has none."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3d_language.table import LANGUAGE

from .action import Action, Site

DARK = "M3D0513"


def find(site: Site) -> Iterator[Action]:
    """Where the compiler finds a scene without light: the LIGHT that the language table has as an example, at the
    end."""
    for diagnostic in site.found:
        if diagnostic.code == DARK:
            end = len(site.data.rstrip())
            text = f"\n\n{LANGUAGE.blocks['LIGHT'].example}"
            yield Action("Add a LIGHT", types.CodeActionKind.QuickFix, [((end, end), text)], (diagnostic,))
