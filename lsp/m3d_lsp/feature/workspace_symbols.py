"""Workspace symbols: variables and blocks by name, in the open documents and in all `.m3d` files of all workspace
folders."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, NamedTuple

from lsprotocol import types

from m3d_language.table import LANGUAGE
from m3dc import Source
from m3dc.diagnostics import Findings
from m3dc.syntax.parse import parse

from ..comments import Comments
from ..documents import file_path
from ..outline import Entry, outline, outline_of
from ..registry import server_request
from ..snapshot import Snapshot
from ..text import Text
from .symbols import kind_of

if TYPE_CHECKING:
    from ..server import Server

MOST = 1000  # symbols in one answer: nobody looks at more


class _File(NamedTuple):
    """A file as it was when it was last read."""

    modified: int
    size: int
    encoding: str
    symbols: list[types.WorkspaceSymbol]


@server_request(types.WORKSPACE_SYMBOL)
async def find(server: Server, params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
    """The symbols whose names hold the letters of the query, in their order; those of open documents first."""
    found: list[types.WorkspaceSymbol] = []
    opened: set[str] = set()
    for document in list(server.documents):
        snapshot = await document.snapshot()
        opened.add(_file_of(document.uri) or document.uri)
        found += await asyncio.to_thread(_of_document, snapshot)
    workspace = server.protocol.workspace
    folders = list(workspace.folders) or ([workspace.root_uri] if workspace.root_uri else [])
    stop = Event()
    try:
        found += await asyncio.to_thread(_in_folders, folders, opened, server.documents.encoding, stop)
    finally:
        stop.set()
    shown = [symbol for symbol in found if _matches(params.query, symbol.name)][:MOST]
    client = server.documents.client
    return [
        types.WorkspaceSymbol(each.location, each.name, client.shown(each.kind), container_name=each.container_name)
        for each in shown
    ]


def _of_document(snapshot: Snapshot) -> list[types.WorkspaceSymbol]:
    return _symbols(snapshot.uri, snapshot.text, outline(snapshot.analysis))


def _matches(query: str, name: str) -> bool:
    """Whether the letters of the query stand in the name in this order, whatever their case."""
    letters = iter(name.casefold())
    return all(letter in letters for letter in query.casefold() if not letter.isspace())


def _symbols(uri: str, text: Text, entries: Iterable[Entry]) -> list[types.WorkspaceSymbol]:
    named = list(_named(entries))
    ranges = text.ranges([entry.place for entry in named])
    return [
        types.WorkspaceSymbol(types.Location(uri, range_), entry.name, kind_of(entry), container_name=entry.detail)
        for entry, range_ in zip(named, ranges, strict=True)
    ]


def _named(entries: Iterable[Entry], depth: int = 0) -> Iterator[Entry]:
    """Variables where they are declared, blocks of the top level, and other blocks that a comment names."""
    for entry in entries:
        is_block = entry.keyword in LANGUAGE.blocks and not entry.is_variable
        if (entry.is_variable or not entry.name.startswith(entry.keyword)) if depth else is_block:
            yield entry
        yield from _named(entry.children, depth + 1)


_FILES: dict[Path, _File] = {}


def _in_folders(folders: list[str], opened: set[str], encoding: str, stop: Event) -> list[types.WorkspaceSymbol]:
    """The symbols of all files but the opened ones. A file is read again only if it has changed."""
    found: list[types.WorkspaceSymbol] = []
    for path in dict.fromkeys(path for folder in folders for path in _scenes(_file_of(folder))):
        if stop.is_set():
            break
        if str(path) not in opened:
            found += _of_file(path, encoding)
    return found


def _file_of(uri: str) -> str | None:
    """The file of a URI in one spelling."""
    path = file_path(uri)
    return os.path.realpath(path) if path else None


def _scenes(folder: str | None) -> Iterator[Path]:
    """The scenes in a folder and below it, in order, but for hidden folders."""
    for parent, folders, files in os.walk(folder) if folder else ():
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name != "node_modules")
        for name in sorted(files):
            if name.endswith(".m3d"):
                yield Path(parent, name)


def _of_file(path: Path, encoding: str) -> list[types.WorkspaceSymbol]:
    try:
        status = path.stat()
        known = _FILES.get(path)
        if known is not None and known[:3] == (status.st_mtime_ns, status.st_size, encoding):
            return known.symbols
        data = path.read_bytes()
    except OSError:
        _FILES.pop(path, None)
        return []
    source = Source(data, path.name)
    text = Text(data, path.name, encoding)
    entries = outline_of(source.data, parse(source, Findings()).items, Comments(source.data))
    symbols = _symbols(path.as_uri(), text, entries)
    _FILES[path] = _File(status.st_mtime_ns, status.st_size, encoding, symbols)
    return symbols
