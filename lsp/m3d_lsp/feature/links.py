"""Document links: files and addresses named in comments can be followed. A file is meant as seen from the scene's own
folder, and must exist."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types

from ..comments import comments
from ..documents import file_path
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span

_ADDRESS = rb"https?://[^\s<>\"']*[^\s<>\"'.,:;!?)*]"
_QUOTED = rb"\"([^\"\n]+)\"|'([^'\n]+)'"
_BARE = rb"(?<![\w/.~-])((?:/|\.{1,2}/)*[\w.~+-]+(?:/[\w.~+-]+)*\.\w+)"
_LINK = re.compile(rb"(%s)|%s|%s" % (_ADDRESS, _QUOTED, _BARE))


@request(types.TEXT_DOCUMENT_DOCUMENT_LINK, types.DocumentLinkOptions(resolve_provider=False))
def links(snapshot: Snapshot, params: types.DocumentLinkParams) -> list[types.DocumentLink]:
    """All links. Looks whether files are there."""
    del params
    path = file_path(snapshot.uri)
    folder = Path(path).parent if path else None
    found = [(span, target) for comment in comments(snapshot.analysis).spans
             for span, target in _in(snapshot.text.data, comment, folder)]  # fmt: skip
    ranges = snapshot.text.ranges([span for span, _ in found])
    return [types.DocumentLink(range_, target) for range_, (_, target) in zip(ranges, found, strict=True)]


def _in(data: bytes, comment: Span, folder: Path | None) -> Iterator[tuple[Span, str]]:
    """Where in a comment something is named, and its address."""
    for match in _LINK.finditer(data, *comment):
        group = match.lastindex or 0
        name = match[group].decode("utf-8", "replace")
        if group == 1:
            yield match.span(group), name
        elif folder is not None and _is_file(folder / name):
            yield match.span(group), (folder / name).resolve().as_uri()


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
