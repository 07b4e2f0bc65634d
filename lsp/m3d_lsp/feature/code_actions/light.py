"""Adding a light to a scene that has none."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from m3d_language.table import LANGUAGE
from m3dc.diagnostics import catalogue

from .action import Action, Site


def find(site: Site) -> Iterator[Action]:
    """Where the compiler finds a scene without light: the LIGHT that the language table has as an example, at the
    end."""
    for diagnostic in site.found:
        if diagnostic.code == catalogue.NO_LIGHT.code:
            end = len(site.data.rstrip())
            text = f"\n\n{LANGUAGE.blocks['LIGHT'].example}"
            yield Action("Add a LIGHT", types.CodeActionKind.QuickFix, [((end, end), text)], (diagnostic,))
