"""What is known of an open document at one version: what every feature answers from."""

from __future__ import annotations

from dataclasses import dataclass

from lsprotocol import types

from m3dc.analysis import Analysis

from .client import Client
from .settings import Settings
from .text import Span, Text


@dataclass(frozen=True)
class Snapshot:
    """A version of a document, analysed. Immutable."""

    uri: str
    version: int
    text: Text
    analysis: Analysis
    settings: Settings
    client: Client

    def offset(self, position: types.Position) -> int:
        """The byte at a position."""
        return self.text.offset(position)

    def range(self, span: Span) -> types.Range:
        """A range of bytes as LSP's."""
        return self.text.range(span)

    def location(self, span: Span) -> types.Location:
        return types.Location(self.uri, self.range(span))
