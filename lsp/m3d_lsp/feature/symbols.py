"""Document symbols: the outline of a scene, its variables and blocks as a tree, each with a name that says what it is.

A block is named by the comment that stands with it, or by the variable that it copies.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types

from m3d_language.table import LANGUAGE

from ..client import Client
from ..outline import Entry, outline
from ..registry import request
from ..snapshot import Snapshot


def kind_of(entry: Entry) -> types.SymbolKind:
    """The kind that an editor shows an entry as."""
    if entry.is_variable:
        return types.SymbolKind.Variable
    block = LANGUAGE.blocks.get(entry.keyword)
    if block is None:
        return types.SymbolKind.Array if entry.keyword in LANGUAGE.parents else types.SymbolKind.Namespace
    if block.adds or (block.variable and entry.keyword in LANGUAGE.top):
        return types.SymbolKind.Object
    return types.SymbolKind.Namespace if entry.keyword in LANGUAGE.top else types.SymbolKind.Property


@request(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, types.DocumentSymbolOptions(label="Mirage3D"))
def symbols(
    snapshot: Snapshot, params: types.DocumentSymbolParams
) -> list[types.DocumentSymbol] | list[types.SymbolInformation]:
    """The outline as a tree; as a list for clients that know no other."""
    del params
    entries = outline(snapshot.analysis)
    ranges = iter(snapshot.text.ranges([span for entry in _all(entries) for span in (entry.span, entry.place)]))
    if snapshot.client.symbol_trees:
        return [_symbol(snapshot.client, entry, ranges) for entry in entries]
    return [symbol for entry in entries for symbol in _flat(snapshot, entry, ranges, None)]


def _all(entries: Iterable[Entry]) -> Iterator[Entry]:
    for entry in entries:
        yield entry
        yield from _all(entry.children)


def _symbol(client: Client, entry: Entry, ranges: Iterator[types.Range]) -> types.DocumentSymbol:
    """The symbol of an entry; takes the ranges of it and of all that is in it."""
    whole, place = next(ranges), next(ranges)
    children = [_symbol(client, child, ranges) for child in entry.children]
    return types.DocumentSymbol(
        entry.name, client.shown(kind_of(entry)), whole, place, entry.detail or None, children=children or None
    )


def _flat(
    snapshot: Snapshot, entry: Entry, ranges: Iterator[types.Range], container: str | None
) -> Iterator[types.SymbolInformation]:
    """The symbol of an entry, and those in it; takes the ranges of all of them.

    A list has no room for details: those of what stands in no other block take the container's place.
    """
    whole, _ = next(ranges), next(ranges)
    location = types.Location(snapshot.uri, whole)
    within = container or entry.detail or None
    yield types.SymbolInformation(location, entry.name, snapshot.client.shown(kind_of(entry)), container_name=within)
    for child in entry.children:
        yield from _flat(snapshot, child, ranges, entry.name)
