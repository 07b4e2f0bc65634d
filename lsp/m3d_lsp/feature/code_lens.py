"""Code lenses: what can be done with the scene, above its SCENE block, or at the top of a file without one; the dump of
an object; and above VARIABLES how often each variable is used.

A comb of lenses is worth less than none: objects have one where they are few and each is written on several lines, and
of the variables of a crowded line only those that nothing uses.

Answers `textDocument/codeLens`. The commands are the client's, which says that it has them: `m3d.preview`, `m3d.render`
and `m3d.dump` with a URI and a position, `m3d.showReferences` with the places of a variable besides.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

from lsprotocol import types

from m3d_language.table import LANGUAGE
from m3dc.syntax.parse import ast

from ..names import Names, Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span

# What can be asked of the whole scene, and of a single object.
OF_SCENE = (("Preview", "m3d.preview"), ("Render", "m3d.render"), ("Dump", "m3d.dump"))
OF_OBJECT = (("Dump", "m3d.dump"),)

# More objects than these have no lenses, and on a line with more variables only those never used.
MOST_OBJECTS = 10
MOST_NAMES = 3


@request(types.TEXT_DOCUMENT_CODE_LENS, types.CodeLensOptions(resolve_provider=False), nothing=[])
def code_lens(snapshot: Snapshot, params: types.CodeLensParams) -> list[types.CodeLens]:
    """All lenses of a document, in the order of the text; none where they are switched off, nor such whose commands the
    client does not have."""
    del params
    commands = snapshot.client.commands
    if not commands or not snapshot.settings.codeLens.enabled:
        return []
    return [lens for lens in _lenses(snapshot) if lens.command is not None and lens.command.command in commands]


def _lenses(snapshot: Snapshot) -> Iterator[types.CodeLens]:
    blocks = [top.item.keyword.text for top in snapshot.analysis.items if isinstance(top.item, ast.Block)]
    if blocks and "SCENE" not in blocks:
        for title, command in OF_SCENE:
            yield _lens(snapshot, (0, 0), title, command)
    large = [top for top in snapshot.analysis.items if _is_large_object(snapshot, top)]
    objects = {top.start for top in large} if len(large) <= MOST_OBJECTS else set[int]()
    for top in snapshot.analysis.items:
        match top.item:
            case ast.Block(keyword=keyword) if keyword.text == "SCENE" or top.start in objects:
                for title, command in OF_SCENE if keyword.text == "SCENE" else OF_OBJECT:
                    yield _lens(snapshot, top.place(keyword.span), title, command)
            case ast.Variables():
                yield from _variables(snapshot, top, top.item)
            case _:
                pass


def _is_large_object(snapshot: Snapshot, top: ast.TopLevel) -> bool:
    """Whether an item is a SOLID or LIGHT on several lines."""
    if not isinstance(top.item, ast.Block) or top.item.keyword.text not in LANGUAGE.top:
        return False
    start, end = top.place(top.item.span)
    return top.item.keyword.text != "SCENE" and b"\n" in snapshot.text.data[start:end]


def _variables(snapshot: Snapshot, top: ast.TopLevel, variables: ast.Variables) -> Iterator[types.CodeLens]:
    known = names(snapshot.analysis)
    places = [(n.text, top.place(n.span)) for declaration in variables.declarations for n in declaration.names]
    lines = Counter(snapshot.text.line_of(start) for _, (start, _) in places)
    for name, place in places:
        used = any(occurrence.role is Role.USE for occurrence in known.of(name))
        if not used or lines[snapshot.text.line_of(place[0])] <= MOST_NAMES:
            yield _references(snapshot, known, name, place)


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
