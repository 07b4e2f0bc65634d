"""Call hierarchy and type hierarchy of variables: who uses this variable and what does it use; what is it a copy of,
and what are copies of it.

An item of a hierarchy is a variable, or a block at top level.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from typing import TypeAlias, TypeVar

from lsprotocol import types

from m3dc.syntax.parse import ast
from m3dc.text.span import Local

from ..names import Occurrence, Role, names
from ..outline import Entry, outline
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span
from .symbols import kind_of

Item = TypeVar("Item", types.CallHierarchyItem, types.TypeHierarchyItem)

# Who uses a variable, and where: by the variable that is assigned to, or by where the block begins.
Users: TypeAlias = dict[str | int, tuple[Entry, list[Span]]]


@request(types.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY)
def prepare_calls(snapshot: Snapshot, params: types.CallHierarchyPrepareParams) -> list[types.CallHierarchyItem] | None:
    """The variable at the cursor, or the block of the top level whose keyword it is."""
    entry = _at(snapshot, params.position)
    return None if entry is None else [_item(snapshot, entry, types.CallHierarchyItem)]


@request(types.CALL_HIERARCHY_INCOMING_CALLS)
def incoming(
    snapshot: Snapshot, params: types.CallHierarchyIncomingCallsParams
) -> list[types.CallHierarchyIncomingCall]:
    """Which variables and blocks use a variable, and where."""
    variable = _variable(snapshot, params.item)
    users: Users = {}
    for entry, uses in _uses(snapshot) if variable else ():
        spans = [use.span for use in uses if use.name == variable]
        if spans:
            _user(snapshot, users, entry)[1].extend(spans)
    return [
        types.CallHierarchyIncomingCall(_item(snapshot, entry, types.CallHierarchyItem), snapshot.text.ranges(spans))
        for entry, spans in users.values()
    ]


@request(types.CALL_HIERARCHY_OUTGOING_CALLS)
def outgoing(
    snapshot: Snapshot, params: types.CallHierarchyOutgoingCallsParams
) -> list[types.CallHierarchyOutgoingCall]:
    """Which variables a variable's assignments, or a block, use."""
    variable, place = _variable(snapshot, params.item), snapshot.offset(params.item.selection_range.start)
    used: dict[str, list[Span]] = {}
    for entry, uses in _uses(snapshot):
        if entry.name == variable if variable and entry.is_variable else entry.place[0] == place:
            for use in uses:
                used.setdefault(use.name, []).append(use.span)
    return [
        types.CallHierarchyOutgoingCall(
            _item(snapshot, _entry_of(snapshot, name, spans[0]), types.CallHierarchyItem), snapshot.text.ranges(spans)
        )
        for name, spans in used.items()
    ]


@request(types.TEXT_DOCUMENT_PREPARE_TYPE_HIERARCHY)
def prepare_types(snapshot: Snapshot, params: types.TypeHierarchyPrepareParams) -> list[types.TypeHierarchyItem] | None:
    """As for the call hierarchy."""
    entry = _at(snapshot, params.position)
    return None if entry is None else [_item(snapshot, entry, types.TypeHierarchyItem)]


@request(types.TYPE_HIERARCHY_SUPERTYPES)
def supertypes(snapshot: Snapshot, params: types.TypeHierarchySupertypesParams) -> list[types.TypeHierarchyItem]:
    """What a variable or block is a copy of."""
    variable, place = _variable(snapshot, params.item), snapshot.offset(params.item.selection_range.start)
    found: dict[str, Entry] = {}
    for entry, source in _copies(snapshot):
        if entry.name == variable if variable and entry.is_variable else entry.place[0] == place:
            found.setdefault(source.name, _entry_of(snapshot, source.name, source.span))
    return [_item(snapshot, entry, types.TypeHierarchyItem) for entry in found.values()]


@request(types.TYPE_HIERARCHY_SUBTYPES)
def subtypes(snapshot: Snapshot, params: types.TypeHierarchySubtypesParams) -> list[types.TypeHierarchyItem]:
    """What is a copy of a variable: other variables, and blocks wherever they stand."""
    variable = _variable(snapshot, params.item)
    users: Users = {}
    for entry, source in _copies(snapshot):
        if source.name == variable:
            _user(snapshot, users, entry)
    return [_item(snapshot, entry, types.TypeHierarchyItem) for entry, _ in users.values()]


def _variable(snapshot: Snapshot, item: types.CallHierarchyItem | types.TypeHierarchyItem) -> str | None:
    """The variable that an item stands for; None for a block."""
    is_variable = item.kind == types.SymbolKind.Variable and names(snapshot.analysis).of(item.name)
    return item.name if is_variable else None


def _item(snapshot: Snapshot, entry: Entry, kind: type[Item]) -> Item:
    whole, place = snapshot.text.ranges([entry.span, entry.place])
    detail = ", ".join(part for part in (entry.detail, _around(snapshot, entry)) if part)
    return kind(entry.name, kind_of(entry), snapshot.uri, whole, place, detail=detail or None)


def _around(snapshot: Snapshot, entry: Entry) -> str:
    """What a block inside of another stands in, which tells it from others of its name."""
    entries = outline(snapshot.analysis)
    index = bisect_right(entries, entry.span[0], key=lambda outer: outer.span[0]) - 1
    outer = entries[index] if index >= 0 else None
    if entry.is_variable or outer is None or outer.span == entry.span:
        return ""
    return f"in {outer.name}" + (f" ({outer.detail})" if outer.detail and not outer.is_variable else "")


def _at(snapshot: Snapshot, position: types.Position) -> Entry | None:
    offset = snapshot.offset(position)
    at = names(snapshot.analysis).at(offset)
    if at is not None:
        return _entry_of(snapshot, at.name, at.span)
    entries = outline(snapshot.analysis)
    return next((e for e in entries if e.place[0] <= offset <= e.place[1] and e.keyword != "VARIABLES"), None)


def _entry_of(snapshot: Snapshot, name: str, otherwise: Span) -> Entry:
    """A variable: where it is declared, or, if it is not, somewhere else."""
    declaration = names(snapshot.analysis).declaration(name)
    span = otherwise if declaration is None else declaration.span
    type_ = "" if declaration is None else declaration.type
    return Entry(name, type_, type_, True, span, span, ())


def _user(
    snapshot: Snapshot, users: dict[str | int, tuple[Entry, list[Span]]], entry: Entry
) -> tuple[Entry, list[Span]]:
    """The user that an entry is; all assignments to one variable are one."""
    if entry.is_variable:
        return users.setdefault(entry.name, (_entry_of(snapshot, entry.name, entry.place), []))
    return users.setdefault(entry.span[0], (entry, []))


def _uses(snapshot: Snapshot) -> Iterator[tuple[Entry, list[Occurrence]]]:
    """The assignments and blocks of the top level, each with the uses of variables in it."""
    occurrences = names(snapshot.analysis).occurrences
    at = 0
    for entry in outline(snapshot.analysis):
        uses: list[Occurrence] = []
        while at < len(occurrences) and occurrences[at].span[0] < entry.span[1]:
            if occurrences[at].role is Role.USE:
                uses.append(occurrences[at])
            at += 1
        yield entry, uses


def _copies(snapshot: Snapshot) -> Iterator[tuple[Entry, Occurrence]]:
    """The assignments and blocks that begin as a copy of a variable, with that."""
    known = names(snapshot.analysis)
    entries = {entry.span[0]: entry for entry in _all(outline(snapshot.analysis))}
    for top in snapshot.analysis.items:
        for whole, source in _sources(top.item):
            occurrence = known.at(top.place(source.span)[0])
            entry = entries.get(top.place(whole)[0])
            if occurrence is not None and entry is not None:
                yield entry, occurrence


def _all(entries: tuple[Entry, ...]) -> Iterator[Entry]:
    for entry in entries:
        yield entry
        yield from _all(entry.children)


def _sources(item: ast.Item) -> Iterator[tuple[Local, ast.Name]]:
    """The places of the blocks and the assignment in an item that copy a variable, and its name."""
    match item:
        case ast.Block():
            if item.name is not None:
                yield item.span, item.name
        case ast.Assignment():
            if isinstance(item.value, ast.Name):
                yield item.span, item.value
        case _:
            return
    for member in item.body.items if item.body is not None else ():
        yield from _sources(member)
