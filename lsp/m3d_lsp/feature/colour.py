"""Colours: a sample beside every colour of a scene, and a picker that writes the chosen one in the scene's own form.

Answers `textDocument/documentColor` and `textDocument/colorPresentation`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsprotocol import types

from ..colours import colours
from ..registry import request
from ..snapshot import Snapshot

_COMPONENT = re.compile(r"[+-]?\.?[0-9][0-9A-Za-z_.+-]*|[A-Za-z][A-Za-z0-9_]*")
_DECIMALS = re.compile(r"\.(\d+)")
# As many as tell apart the 256 steps of a picker.
LEAST_DECIMALS = 3


@request(types.TEXT_DOCUMENT_DOCUMENT_COLOR, nothing=[])
def document_colour(snapshot: Snapshot, params: types.DocumentColorParams) -> list[types.ColorInformation]:
    """Every vector that is a colour. Where a variable stands for one, its assignment has the sample."""
    del params
    written = [colour for colour in colours(snapshot.analysis) if colour.variable is None]
    ranges = snapshot.text.ranges([colour.span for colour in written])
    return [
        types.ColorInformation(range_, types.Color(*(min(max(part, 0.0), 1.0) for part in colour.value), alpha=1.0))
        for colour, range_ in zip(written, ranges, strict=True)
    ]


@request(types.TEXT_DOCUMENT_COLOR_PRESENTATION, nothing=[])
def colour_presentation(snapshot: Snapshot, params: types.ColorPresentationParams) -> list[types.ColorPresentation]:
    """The vector with the chosen colour: its spaces and comments stay, and its numbers have as many decimals as
    before, or as a picker tells apart."""
    before = snapshot.text.part(snapshot.text.span(params.range))
    new = _rewritten(before, (params.color.red, params.color.green, params.color.blue))
    return [types.ColorPresentation(new, types.TextEdit(params.range, new))]


def _rewritten(vector: str, color: tuple[float, float, float]) -> str:
    pieces = re.split(r"(/\*.*?\*/)", vector, flags=re.DOTALL)
    decimals = max([LEAST_DECIMALS, *(len(match[1]) for match in _DECIMALS.finditer(vector))])
    numbers: Iterator[str] = (_number(part, decimals) for part in color)
    components = sum(len(_COMPONENT.findall(piece)) for piece in pieces[::2])
    if components != len(color):
        return f"< {', '.join(numbers)} >"
    pieces[::2] = [_COMPONENT.sub(lambda _: next(numbers), piece) for piece in pieces[::2]]
    return "".join(pieces)


def _number(value: float, decimals: int) -> str:
    """Without the zeros at its end: 0.5, 1."""
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".")
