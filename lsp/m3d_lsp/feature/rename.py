"""Rename, with prepare, and linked editing: a variable is called something else everywhere at once.

A new name that the language does not allow, or that is taken, is refused with the reason.
"""

from __future__ import annotations

import re

from lsprotocol import types

from m3d_language.table import LANGUAGE

from ..names import Names, Occurrence, names
from ..registry import RefusalError, request
from ..snapshot import Snapshot

WORD = r"[A-Za-z][A-Za-z0-9_]*"
_IDENTIFIER = re.compile(WORD)


@request(types.TEXT_DOCUMENT_PREPARE_RENAME)
def prepare(snapshot: Snapshot, params: types.PrepareRenameParams) -> types.PrepareRenamePlaceholder:
    """The name at the cursor, which is to be typed anew. Raises RefusalError where there is none to rename."""
    at = _variable(snapshot, params.position)
    return types.PrepareRenamePlaceholder(snapshot.range(at.span), at.name)


@request(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
def rename(snapshot: Snapshot, params: types.RenameParams) -> types.WorkspaceEdit:
    """The new name in all places of the variable. Raises RefusalError where it can not be renamed so."""
    known = names(snapshot.analysis)
    at, new = _variable(snapshot, params.position), params.new_name.strip()
    reason = objection(new, at.name, known)
    if reason is not None:
        raise RefusalError(reason)
    ranges = snapshot.text.ranges([occurrence.span for occurrence in known.of(at.name)])
    return types.WorkspaceEdit({snapshot.uri: [types.TextEdit(range_, new) for range_ in ranges]})


def objection(new: str, old: str, known: Names) -> str | None:
    """Why a variable can not be called so; None if it can."""
    if not new:
        return "A variable needs a name."
    if new in LANGUAGE.keywords:
        return f"{new} is a reserved word of the language. Small letters would do: {new.lower()}."
    if not _IDENTIFIER.fullmatch(new):
        return f"{new!r} is no name: a name starts with a letter and goes on with letters, digits and underscores."
    longest = LANGUAGE.limits["identifier"]
    if len(new) > longest:
        return f"The name has {len(new)} characters; it can have {longest} at most."
    if new != old and known.of(new):
        declared = known.type(new)
        return f"There is a {declared} {new} already." if declared else f"{new} stands in the scene already."
    return None


@request(types.TEXT_DOCUMENT_LINKED_EDITING_RANGE)
def linked(snapshot: Snapshot, params: types.LinkedEditingRangeParams) -> types.LinkedEditingRanges | None:
    """All places of a declared variable, for editors that change them together while one of them is typed."""
    known = names(snapshot.analysis)
    at = known.at(snapshot.offset(params.position))
    if at is None or known.declaration(at.name) is None:
        return None
    return types.LinkedEditingRanges(snapshot.text.ranges([o.span for o in known.of(at.name)]), WORD)


def _variable(snapshot: Snapshot, position: types.Position) -> Occurrence:
    """The variable at a place. Raises RefusalError where there is none."""
    at = names(snapshot.analysis).at(snapshot.offset(position))
    if at is None:
        raise RefusalError("There is no variable here. Only variables can be renamed.")
    if at.name in LANGUAGE.keywords:
        raise RefusalError(f"{at.name} is a reserved word of the language and can not be renamed.")
    return at
