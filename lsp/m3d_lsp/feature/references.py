"""References and document highlight: every place where a variable stands, and whether it is read or written there."""

from __future__ import annotations

from lsprotocol import types

from ..names import Occurrence, Role, names
from ..registry import request
from ..snapshot import Snapshot


@request(types.TEXT_DOCUMENT_REFERENCES)
def references(snapshot: Snapshot, params: types.ReferenceParams) -> list[types.Location]:
    """All places of the variable at the cursor, in the order of the text; its declaration only if that is asked for."""
    found = _all(snapshot, params.position)
    if not params.context.include_declaration:
        found = [occurrence for occurrence in found if occurrence.role is not Role.DECLARATION]
    ranges = snapshot.text.ranges([occurrence.span for occurrence in found])
    return [types.Location(snapshot.uri, range_) for range_ in ranges]


@request(types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
def highlight(snapshot: Snapshot, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight] | None:
    """The same, marked as read or written; None elsewhere, where the editor may mark equal words."""
    found = _all(snapshot, params.position)
    if not found:
        return None
    kinds = [
        types.DocumentHighlightKind.Read if occurrence.role is Role.USE else types.DocumentHighlightKind.Write
        for occurrence in found
    ]
    return list(map(types.DocumentHighlight, snapshot.text.ranges([o.span for o in found]), kinds))


def _all(snapshot: Snapshot, position: types.Position) -> list[Occurrence]:
    known = names(snapshot.analysis)
    at = known.at(snapshot.offset(position))
    return [] if at is None else known.of(at.name)
