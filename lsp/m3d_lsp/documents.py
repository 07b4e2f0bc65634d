"""All open documents, and what the client is told of them unasked."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import unquote, urlsplit

from lsprotocol import types

from .client import Client
from .document import Document
from .settings import Settings
from .snapshot import Snapshot
from .text import Text


class Documents:
    """The open documents by URI. They are analysed one at a time, in one thread."""

    def __init__(self, looked_at: Callable[[Document, Snapshot], None]) -> None:
        self.encoding = types.PositionEncodingKind.Utf16.value
        self.settings = Settings()
        self.client = Client()
        self._looked_at = looked_at
        self._documents: dict[str, Document] = {}
        self._executor = ThreadPoolExecutor(1, "analysis")

    def __iter__(self) -> Iterator[Document]:
        return iter(self._documents.values())

    def get(self, uri: str) -> Document | None:
        return self._documents.get(uri)

    def open(self, item: types.TextDocumentItem) -> None:
        self.close(item.uri)
        text = Text.of(item.text, file_name(item.uri), self.encoding)
        self._documents[item.uri] = Document(
            item.uri, text, item.version, self.settings, self.client, self._executor, self._looked_at
        )

    def change(self, params: types.DidChangeTextDocumentParams) -> None:
        document = self._documents.get(params.text_document.uri)
        if document is not None:
            document.change(list(params.content_changes), params.text_document.version)

    def close(self, uri: str) -> None:
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
    return unquote(urlsplit(uri).path).rsplit("/", 1)[-1]
