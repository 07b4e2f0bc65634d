"""Colours: a sample beside every colour of a scene, and a picker that writes the chosen one in the scene's own form.

Answers `textDocument/documentColor` and `textDocument/colorPresentation`.
"""

from __future__ import annotations

from lsprotocol import types

from m3dc.meaning.values import Vector
from m3dc.syntax import numerals

from ..colours import colours
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span

# As many as tell apart the 256 steps of a picker.
LEAST_DECIMALS = 3
SAME = 0.5 / 255


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
    """The vector with the chosen colour. Its spaces and comments stay, and every component that, to the eye, is what it
    was; numbers have as many decimals as before, or as a picker tells apart."""
    span = snapshot.text.span(params.range)
    old = next((colour.value for colour in colours(snapshot.analysis) if colour.span == span), None)
    new = _rewritten(snapshot.text.data, span, old, (params.color.red, params.color.green, params.color.blue))
    return [types.ColorPresentation(new, types.TextEdit(params.range, new))]


def _rewritten(data: bytes, span: Span, old: Vector | None, new: Vector) -> str:
    places = list(numerals.scalars(data, *span))
    written = [data[start:end].decode("utf-8", "replace") for start, end in places]
    if len(written) != len(new):
        return f"< {', '.join(_number(part, LEAST_DECIMALS) for part in new)} >"
    decimals = {len(component.partition(".")[2]) for component in written}
    # All with as many decimals, as in a column: so they stay.
    fixed = len(decimals) == 1 and max(decimals) >= 2 and all(numerals.decimals(each) is not None for each in written)
    most = max(decimals) if fixed else max(LEAST_DECIMALS, *decimals)
    parts: list[str] = []
    done = span[0]
    for number, (start, end) in enumerate(places):
        kept = old is not None and abs(new[number] - old[number]) < SAME
        component = written[number] if kept else _number(new[number], most, fixed=fixed)
        parts += [data[done:start].decode("utf-8", "replace"), component]
        done = end
    return "".join([*parts, data[done : span[1]].decode("utf-8", "replace")])


def _number(value: float, decimals: int, *, fixed: bool = False) -> str:
    """Without the zeros at its end, unless all have as many decimals: 0.5, 1."""
    text = f"{value:.{decimals}f}"
    return text if fixed else text.rstrip("0").rstrip(".")
