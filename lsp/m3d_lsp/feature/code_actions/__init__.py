"""Code actions: quick fixes for what the compiler finds, and changes of form that keep a scene as it is.

Every fix the compiler knows, one by one or all in the file; declaring a name that is used, removing one that is not;
putting what is misplaced into its block; adding a light; allowing a warning here or in the file; moving a block or a
value into a variable, and back; sorting a PROFILE; FACETS with computed normals. A module an action, each with a
function that says what it can do at a place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import cast

from lsprotocol import types
from pygls.exceptions import JsonRpcInvalidParams

from ...client import APPLY_EDIT
from ...registry import request
from ...snapshot import Snapshot
from ..diagnostics import lsp_diagnostic
from . import allow, counts, declare, extract, fixes, inline, light, normals, profile, unused, wrap
from .action import Action, Edit, Site

SOURCES: tuple[Callable[[Site], Iterator[Action]], ...] = (
    fixes.find,
    declare.find,
    unused.find,
    counts.find,
    profile.find,
    wrap.find,
    light.find,
    allow.find,
    extract.find,
    inline.find,
    normals.find,
)
KINDS = [
    types.CodeActionKind.QuickFix,
    types.CodeActionKind.RefactorExtract,
    types.CodeActionKind.RefactorInline,
    types.CodeActionKind.RefactorRewrite,
    types.CodeActionKind.SourceFixAll,
]


@request(types.TEXT_DOCUMENT_CODE_ACTION, types.CodeActionOptions(code_action_kinds=KINDS, resolve_provider=True))
def actions(snapshot: Snapshot, params: types.CodeActionParams) -> list[types.CodeAction] | list[types.Command]:
    """What can be done at a place. That of the whole file only where the client asks for it. For clients that know no
    actions, commands that have the edits made; nothing for those that make none."""
    client = snapshot.client
    if not client.action_literals and not client.applies_edits:
        return []
    only = params.context.only
    site = Site(snapshot, snapshot.text.span(params.range))
    found = [action for find in SOURCES for action in find(site) if _is_wanted(action.kind, only)]
    if only is not None and _is_wanted(types.CodeActionKind.SourceFixAll, only):
        found += fixes.find_all(site)
    if client.action_literals:
        return [_code_action(snapshot, params.range, action) for action in found]
    return [
        types.Command(
            action.title,
            APPLY_EDIT,
            arguments=[snapshot.uri, snapshot.version, _workspace_edit(snapshot, _edits(action))],
        )
        for action in found
    ]


@request(types.CODE_ACTION_RESOLVE)
def resolve(snapshot: Snapshot, action: types.CodeAction) -> types.CodeAction:
    """The edits of an action that was chosen, if the text is still as it was. Raises JsonRpcInvalidParams for one that
    was never offered."""
    match action.data:
        case {"version": version, "span": [int() as start, int() as end]}:
            pass
        case _:
            raise JsonRpcInvalidParams("the action is none that the server has offered")
    if version == snapshot.version:
        site = Site(snapshot, (start, end))
        chosen = next((each for find in SOURCES for each in find(site) if each.title == action.title), None)
        if chosen is not None:
            action.edit = _workspace_edit(snapshot, _edits(chosen))
    return action


def _is_wanted(kind: types.CodeActionKind, only: object) -> bool:
    """Whether a kind, or one that it is part of, is asked for."""
    if only is None:
        return True
    names = [str(getattr(each, "value", each)) for each in cast("list[object]", only)]
    return any(kind.value == name or kind.value.startswith(f"{name}.") or not name for name in names)


def _code_action(snapshot: Snapshot, range_: types.Range, action: Action) -> types.CodeAction:
    later = action.later is not None and snapshot.client.resolves_edits
    return types.CodeAction(
        action.title,
        action.kind,
        diagnostics=[lsp_diagnostic(snapshot, diagnostic) for diagnostic in action.mends] or None,
        is_preferred=True if action.preferred and snapshot.client.preferred_actions else None,
        edit=None if later else _workspace_edit(snapshot, _edits(action)),
        data={"uri": snapshot.uri, "version": snapshot.version, "span": snapshot.text.span(range_)} if later else None,
    )


def _edits(action: Action) -> list[Edit]:
    return action.edits if action.later is None else action.later()


def _workspace_edit(snapshot: Snapshot, edits: list[Edit]) -> types.WorkspaceEdit:
    """The edits in the order of the text; those that insert at one place as one."""
    joined: list[Edit] = []
    for span, text in sorted(edits, key=lambda edit: edit[0]):
        if joined and joined[-1][0] == span and span[0] == span[1]:
            text = joined.pop()[1] + text
        joined.append((span, text))
    ranges = snapshot.text.ranges([span for span, _ in joined])
    text_edits = [types.TextEdit(range_, text) for range_, (_, text) in zip(ranges, joined, strict=True)]
    return types.WorkspaceEdit({snapshot.uri: text_edits})
