"""Code lenses: what can be done with the scene, above its SCENE block, or at the top of a file without one; the dump of
each object; and above VARIABLES how often each variable is used.

Answers `textDocument/codeLens`. The commands are the client's: `m3d.preview`, `m3d.render` and `m3d.dump` with a URI
and a position, `m3d.showReferences` with the places of a variable besides.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from lsprotocol import types

from m3dc import ast
from tree_sitter_m3d.table import LANGUAGE

from ..names import Names, Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span

# What can be asked of the whole scene, and of a single object.
OF_SCENE = (("Preview", "m3d.preview"), ("Render", "m3d.render"), ("Dump", "m3d.dump"))
OF_OBJECT = (("Dump", "m3d.dump"),)


@request(types.TEXT_DOCUMENT_CODE_LENS, types.CodeLensOptions(resolve_provider=False), nothing=[])
def code_lens(snapshot: Snapshot, params: types.CodeLensParams) -> list[types.CodeLens]:
    """All lenses of a document, in the order of the text; none where they are switched off."""
    del params
    return list(_lenses(snapshot)) if snapshot.settings.codeLens.enabled else []


def _lenses(snapshot: Snapshot) -> Iterator[types.CodeLens]:
    known = names(snapshot.analysis)
    blocks = [top.item.keyword.text for top in snapshot.analysis.items if isinstance(top.item, ast.Block)]
    if blocks and "SCENE" not in blocks:
        for title, command in OF_SCENE:
            yield _lens(snapshot, (0, 0), title, command)
    for top in snapshot.analysis.items:
        match top.item:
            case ast.Block(keyword=keyword) if keyword.text in LANGUAGE.top:
                place = top.place(keyword.span)
                for title, command in OF_SCENE if keyword.text == "SCENE" else OF_OBJECT:
                    yield _lens(snapshot, place, title, command)
            case ast.Variables():
                for declaration in top.item.declarations:
                    for name in declaration.names:
                        yield _references(snapshot, known, name.text, top.place(name.span))
            case _:
                pass


def _references(snapshot: Snapshot, known: Names, name: str, place: Span) -> types.CodeLens:
    found = [occurrence for occurrence in known.of(name) if occurrence.role is not Role.DECLARATION]
    uses = sum(occurrence.role is Role.USE for occurrence in found)
    title = f"{name}: used {_times(uses)}"
    if len(found) > uses:
        title += f", set {_times(len(found) - uses)}"
    ranges = snapshot.text.ranges([occurrence.span for occurrence in found])
    locations = [types.Location(snapshot.uri, range_) for range_ in ranges]
    return _lens(snapshot, place, title, "m3d.showReferences", locations)


def _times(count: int) -> str:
    return {0: "never", 1: "once", 2: "twice"}.get(count, f"{count} times")


def _lens(snapshot: Snapshot, place: Span, title: str, command: str, *more: Any) -> types.CodeLens:
    range_ = snapshot.range(place)
    return types.CodeLens(range_, types.Command(title, command, arguments=[snapshot.uri, range_.start, *more]))
