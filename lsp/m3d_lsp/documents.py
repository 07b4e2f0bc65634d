"""All open documents, and what the client is told of them unasked."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import unquote, urlsplit

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.uris import to_fs_path

from .client import Client
from .document import Document
from .settings import Settings
from .snapshot import Snapshot
from .text import Text

# How many documents are analysed at once, at the most.
ANALYSES = 4

WHOLE = types.TextDocumentContentChangeWholeDocument

# What editors take without a word to the person, who was told once.
CONTENT_MODIFIED = types.LSPErrorCodes.ContentModified.value


class Documents:
    """The open documents by URI. Each is analysed in a thread, so that a very large one does not hold up the others."""

    def __init__(self, looked_at: Callable[[Document, Snapshot], None], lost: Callable[[str], None]) -> None:
        """`looked_at` is called with each new snapshot of a document, `lost` once when the text of an open document is
        no longer known."""
        self.encoding = types.PositionEncodingKind.Utf16.value
        self.settings = Settings()
        self.client = Client()
        self._looked_at = looked_at
        self._tell_lost = lost
        self._documents: dict[str, Document] = {}
        self._lost: set[str] = set()
        self._executor = ThreadPoolExecutor(ANALYSES, "analysis")

    def __iter__(self) -> Iterator[Document]:
        return iter(self._documents.values())

    def get(self, uri: str) -> Document | None:
        """An open document. Raises JsonRpcException for one whose text is not known."""
        if uri in self._lost:
            raise JsonRpcException(f"the text of {uri} is not known; it must be opened again", CONTENT_MODIFIED)
        return self._documents.get(uri)

    def open(self, item: types.TextDocumentItem) -> None:
        self.close(item.uri)
        text = Text.of(item.text, file_name(item.uri), self.encoding)
        self._documents[item.uri] = Document(
            item.uri, text, item.version, self.settings, self.client, self._executor, self._looked_at
        )

    def change(self, params: types.DidChangeTextDocumentParams) -> None:
        """Take over an edit. A document whose text is not known is known again from a change on that holds all of
        it."""
        identifier, changes = params.text_document, list(params.content_changes)
        document = self._documents.get(identifier.uri)
        if document is None:
            whole = [place for place, change in enumerate(changes) if isinstance(change, WHOLE)]
            if not whole:
                self.lose(identifier.uri)
                return
            text, changes = changes[whole[-1]].text, changes[whole[-1] + 1 :]
            self.open(types.TextDocumentItem(identifier.uri, "m3d", identifier.version, text))
            document = self._documents[identifier.uri]
        document.change(changes, identifier.version)

    def lose(self, uri: str) -> None:
        """The client has changed a document, and it is not known how."""
        if uri not in self._lost:
            self.close(uri)
            self._lost.add(uri)
            self._tell_lost(uri)

    def close(self, uri: str) -> None:
        self._lost.discard(uri)
        document = self._documents.pop(uri, None)
        if document is not None:
            document.close()

    def set(self, settings: Settings) -> None:
        self.settings = settings
        for document in self:
            document.set(settings)

    def stop(self) -> None:
        """The server ends."""
        for uri in list(self._documents):
            self.close(uri)
        self._executor.shutdown(wait=False, cancel_futures=True)


def file_name(uri: str) -> str:
    """The last part of a URI's path, as people know the file."""
    try:
        path = urlsplit(uri).path
    except ValueError:  # it is no URI
        path = uri
    return unquote(path).rsplit("/", 1)[-1]


def file_path(uri: str) -> str | None:
    """The path of the file that a URI names; None if it names none."""
    try:
        path = to_fs_path(uri)
        return path if path and b"\0" not in os.fsencode(path) else None
    except ValueError:  # it is no URI, or no file can have its name
        return None
