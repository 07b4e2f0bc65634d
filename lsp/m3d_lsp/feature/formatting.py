"""Formatting of a document, of a range, and while typing, as `m3dfmt` does it. Only white space changes.

In a scene with syntax errors the items that are sound are laid out. Typing `}` lays out the block that it closes; a
line break lays out the line before it and indents the line it begins.
"""

from __future__ import annotations

import re

from lsprotocol import types

from m3d_language.table import LANGUAGE
from m3dc.format import FormatError, format_range
from m3dc.format.layout import INDENT

from ..comments import comments
from ..registry import request
from ..snapshot import Snapshot
from ..tree import leaf_at

Edits = list[types.TextEdit] | None


@request(types.TEXT_DOCUMENT_FORMATTING)
def document(snapshot: Snapshot, params: types.DocumentFormattingParams) -> Edits:
    """The whole text in its canonical layout."""
    del params
    return _made(snapshot, 0, snapshot.text.line_count - 1)


@request(types.TEXT_DOCUMENT_RANGE_FORMATTING)
def part(snapshot: Snapshot, params: types.DocumentRangeFormattingParams) -> Edits:
    """The lines of a range."""
    first, last = params.range.start.line, params.range.end.line
    if params.range.end.character == 0 and last > first:
        last -= 1
    return _made(snapshot, first, last)


@request(
    types.TEXT_DOCUMENT_ON_TYPE_FORMATTING,
    types.DocumentOnTypeFormattingOptions(first_trigger_character="}", more_trigger_character=["\n"]),
)
def on_type(snapshot: Snapshot, params: types.DocumentOnTypeFormattingParams) -> Edits:
    """What has just been completed, and nothing after the cursor."""
    line = params.position.line
    if params.ch == "}":
        brace = leaf_at(snapshot.analysis.tree, snapshot.offset(params.position) - 1)
        if brace is None or brace.type != "}" or brace.parent is None:
            return None
        block = brace.parent.parent if brace.parent.type == "body" else brace.parent
        start = (block or brace).start_byte
        return _made(snapshot, snapshot.text.line_of(start), line, snapshot.offset(params.position))
    if params.ch != "\n" or line == 0 or not snapshot.settings.format.enabled:
        return None
    edits = _made(snapshot, line - 1, line - 1, snapshot.text.line_end(line - 1)) or []
    return edits + _indented(snapshot, line)


def _made(snapshot: Snapshot, first: int, last: int, limit: int | None = None) -> Edits:
    """The edits on some lines, and none that reaches beyond a limit."""
    if not snapshot.settings.format.enabled:
        return None
    text = snapshot.text
    try:
        edits = format_range(text.data, *(_number(snapshot, line) for line in (first, last)))
    except FormatError:
        return None
    if limit is not None:
        edits = [edit for edit in edits if edit.span[1] <= limit]
    ranges = text.ranges([edit.span for edit in edits])
    return [types.TextEdit(range_, edit.text) for range_, edit in zip(ranges, edits, strict=True)]


def _number(snapshot: Snapshot, line: int) -> int:
    """A line's number as the formatter counts: from 1, and only what line feeds end."""
    return snapshot.text.data.count(b"\n", 0, snapshot.text.line_start(line)) + 1


def _indented(snapshot: Snapshot, line: int) -> list[types.TextEdit]:
    """Indents an empty line for what will stand there; not in a comment, nor among the rows of a table."""
    text = snapshot.text
    span = text.line_start(line), text.line_end(line)
    if text.part(span).strip() or comments(snapshot.analysis).at(span[0]) is not None:
        return []
    opened = _open_braces(snapshot, span[0])
    if opened and _is_table(text.data, opened[-1]) and text.data[opened[-1] + 1 : span[0]].strip():
        return []
    indent = " " * (INDENT * len(opened))
    return [] if text.part(span) == indent else [types.TextEdit(text.range(span), indent)]


_BRACE = re.compile(rb"[{}]")
_LAST_WORD = re.compile(rb"\b([A-Z]+)\s*$")
_FAR = 200  # bytes between a keyword and its brace


def _open_braces(snapshot: Snapshot, offset: int) -> list[int]:
    """Where the braces stand that are open at a byte, outermost first."""
    items = [top.start for top in snapshot.analysis.items if top.start < offset]
    start = items[-1] if items else 0
    opened: list[int] = []
    for comment in [*comments(snapshot.analysis).within((start, offset)), (offset, offset)]:
        for match in _BRACE.finditer(snapshot.text.data, start, comment[0]):
            if match[0] == b"{":
                opened.append(match.start())
            elif opened:
                opened.pop()
        start = comment[1]
    return opened


def _is_table(data: bytes, brace: int) -> bool:
    """Whether a brace is that of a table, by the word before it."""
    match = _LAST_WORD.search(data[max(brace - _FAR, 0) : brace])
    return match is not None and any(match[1].decode() in block.tables for block in LANGUAGE.blocks.values())
