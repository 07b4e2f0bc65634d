"""The files that a scene is made of, as the compiler sees them: it asks for their text by this, and opens none itself.

Today a scene is one file, MAIN. Every place names its file all the same, and whoever shows a place asks here for the
text around it.
"""

from __future__ import annotations

from typing import Protocol

from .source import Source
from .span import MAIN, FileId


class Files(Protocol):
    """Where the text of a scene comes from: the disk, an editor's documents, memory."""

    def resolve(self, name: str, beside: FileId) -> FileId | None:
        """Which file is meant by a name in another one; the same however it is spelled. None where there is none."""
        ...

    def read(self, file: FileId) -> Source:
        """The text of MAIN, or of a file that was resolved; the same as long as these files are held."""
        ...


class OneText:
    """A scene that is a single text, held in memory: no name leads from it to another file."""

    def __init__(self, source: Source) -> None:
        self._source = source

    def resolve(self, name: str, beside: FileId) -> FileId | None:
        """None, for every name."""
        del name, beside

    def read(self, file: FileId) -> Source:
        """The text, which is MAIN."""
        assert file == MAIN
        return self._source


def files_of(given: str | bytes | Source | Files, name: str = "") -> Files:
    """What is given as files: a text becomes a scene of that text alone, called `name`."""
    match given:
        case str():
            return OneText(Source(given.encode(), name))
        case bytes():
            return OneText(Source(given, name))
        case Source():
            return OneText(given)
        case _:
            return given
