"""Inline values: what the variables on the lines in view are worth there, at the ends of the lines.

Answers `textDocument/inlineValue`, which editors ask while a program is stopped, and some always.
"""

from __future__ import annotations

from lsprotocol import types

from ..names import Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..summary import value_text


@request(types.TEXT_DOCUMENT_INLINE_VALUE, nothing=[])
def inline_values(snapshot: Snapshot, params: types.InlineValueParams) -> list[types.InlineValueText]:
    """The numbers and vectors that are used in a range; each once a line."""
    start, end = snapshot.text.span(params.range)
    known = names(snapshot.analysis)
    shown: dict[tuple[int, str], types.InlineValueText] = {}
    for occurrence in known.occurrences:
        if occurrence.role is Role.DECLARATION or not start <= occurrence.span[0] <= end:
            continue
        value = snapshot.analysis.variable(occurrence.name, occurrence.span[0])
        if isinstance(value, (float, int, tuple)):
            range_ = snapshot.range(occurrence.span)
            text = types.InlineValueText(range_, f"{occurrence.name} = {value_text(value)}")
            shown.setdefault((range_.start.line, occurrence.name), text)
    return list(shown.values())
