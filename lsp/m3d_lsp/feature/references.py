"""References and document highlight: every place where a variable stands, and whether it is read or written there;
of a vertex, its row and the corners of facets that name it."""

from __future__ import annotations

from lsprotocol import types

from ..names import Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span
from ..vertices import vertex_at


@request(types.TEXT_DOCUMENT_REFERENCES)
def references(snapshot: Snapshot, params: types.ReferenceParams) -> list[types.Location]:
    """All places of the variable or vertex at the cursor, in the order of the text; its declaration, and the row of a
    vertex, only if that is asked for."""
    found = _all(snapshot, params.position)
    if not params.context.include_declaration:
        found = [(span, role) for span, role in found if role is not Role.DECLARATION]
    return [types.Location(snapshot.uri, range_) for range_ in snapshot.text.ranges([span for span, _ in found])]


@request(types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
def highlight(snapshot: Snapshot, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight] | None:
    """The same, marked as read or written; None elsewhere, where the editor may mark equal words."""
    found = _all(snapshot, params.position)
    if not found:
        return None
    kinds = [
        types.DocumentHighlightKind.Read if role is Role.USE else types.DocumentHighlightKind.Write for _, role in found
    ]
    return list(map(types.DocumentHighlight, snapshot.text.ranges([span for span, _ in found]), kinds))


def _all(snapshot: Snapshot, position: types.Position) -> list[tuple[Span, Role]]:
    offset = snapshot.offset(position)
    known = names(snapshot.analysis)
    at = known.at(offset)
    if at is not None:
        return [(occurrence.span, occurrence.role) for occurrence in known.of(at.name)]
    vertex = vertex_at(snapshot.analysis, offset)
    if vertex is None:
        return []
    places = [(vertex.row, Role.DECLARATION), *((corner, Role.USE) for corner in vertex.corners)]
    return sorted(places, key=lambda place: place[0])
