"""The last version of a document without an error: what views and previews show while the text is half-typed."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from lsprotocol import types
from pygls.exceptions import JsonRpcInvalidParams

from .snapshot import Snapshot
from .text import Span, Text

if TYPE_CHECKING:
    from .server import Server


class Good:
    """A snapshot to show, and the text that the client has: `stale` is whether the document has errors.

    Ranges that go to the client and positions that come from it are of the text that the client has.
    """

    def __init__(self, snapshot: Snapshot, stale: bool, text: Text) -> None:
        self.snapshot = snapshot
        self.stale = stale
        self._text = text
        self._differences = text.since(snapshot.text)

    def place(self, position: types.Position) -> Span:
        """Where a position of the client's was in the snapshot's text: see Differences.back."""
        return self._differences.back(self._text.offset(position))

    def range(self, span: Span) -> dict[str, Any]:
        """LSP's range of the client's text, as JSON, of bytes of the snapshot's."""
        return plain(self._text.range(self._differences.span(span)))


def plain(range_: types.Range) -> dict[str, Any]:
    """A range as JSON, which is faster to send by the thousand."""
    start, end = range_.start, range_.end
    return {
        "start": {"line": start.line, "character": start.character},
        "end": {"line": end.line, "character": end.character},
    }


async def newest(server: Server, uri: str) -> Snapshot:
    """The newest version of an open document. Raises JsonRpcInvalidParams if it is not open."""
    document = server.documents.get(uri)
    if document is None:
        raise JsonRpcInvalidParams(f"{uri} is not open")
    return await document.snapshot()


async def last_good(server: Server, uri: str) -> Good:
    """The last version without an error; the newest, as far as it goes, where there was none. Its IR is there."""
    snapshot = await newest(server, uri)
    document = server.documents.get(uri)
    good = None if document is None else document.good
    stale = not snapshot.analysis.ok
    shown = good if stale and good is not None else snapshot

    def prepare() -> Good:
        _ = shown.analysis.ir
        return Good(shown, stale, snapshot.text)

    # Lowering a large scene takes a while, and so does comparing two long texts.
    return await asyncio.to_thread(prepare)
