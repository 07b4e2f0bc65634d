"""Go to definition, declaration and type definition: from a variable to where it got its value, to its declaration, and
to the type it is declared with; from the corner of a facet to the row of its vertex.

There is always one place to go to, so that no editor has to ask which.
"""

from __future__ import annotations

from lsprotocol import types

from ..names import Occurrence, Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..vertices import vertex_at


@request(types.TEXT_DOCUMENT_DEFINITION)
def definition(snapshot: Snapshot, params: types.DefinitionParams) -> list[types.Location]:
    """Of a use, the last assignment before it, or else the declaration; of an assignment, the declaration; of a
    declaration and of the row of a vertex, itself, so that editors show where it is used."""
    known, at = names(snapshot.analysis), _at(snapshot, params.position)
    if at is None:
        vertex = vertex_at(snapshot.analysis, snapshot.offset(params.position))
        return [] if vertex is None else [snapshot.location(vertex.row)]
    assigned = known.last_assignment(at.name, at.span[0]) if at.role is Role.USE else None
    place = assigned or known.declaration(at.name)
    return [] if place is None else [snapshot.location(place.span)]


@request(types.TEXT_DOCUMENT_DECLARATION)
def declaration(snapshot: Snapshot, params: types.DeclarationParams) -> list[types.Location]:
    """The name in VARIABLES."""
    at = _at(snapshot, params.position)
    place = names(snapshot.analysis).declaration(at.name) if at is not None else None
    return [] if place is None else [snapshot.location(place.span)]


@request(types.TEXT_DOCUMENT_TYPE_DEFINITION)
def type_definition(snapshot: Snapshot, params: types.TypeDefinitionParams) -> list[types.Location]:
    """The type in VARIABLES that the name stands behind."""
    at = _at(snapshot, params.position)
    declared = names(snapshot.analysis).declaration(at.name) if at is not None else None
    if declared is None or declared.type_span is None:
        return []
    return [snapshot.location(declared.type_span)]


def _at(snapshot: Snapshot, position: types.Position) -> Occurrence | None:
    return names(snapshot.analysis).at(snapshot.offset(position))
