"""Go to definition, declaration and type definition: from a variable to where it got its value and where it is
declared, to its declaration alone, and to the type it is declared with."""

from __future__ import annotations

from lsprotocol import types

from ..names import Occurrence, Role, names
from ..registry import request
from ..snapshot import Snapshot


@request(types.TEXT_DOCUMENT_DEFINITION)
def definition(snapshot: Snapshot, params: types.DefinitionParams) -> list[types.Location]:
    """Of a use, the last assignment before it and the declaration; of an assignment, the declaration; of a declaration,
    itself, so that editors show where it is used."""
    known, at = names(snapshot.analysis), _at(snapshot, params.position)
    if at is None:
        return []
    places = [known.last_assignment(at.name, at.span[0])] if at.role is Role.USE else []
    places.append(known.declaration(at.name))
    return [snapshot.location(place.span) for place in places if place is not None]


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
