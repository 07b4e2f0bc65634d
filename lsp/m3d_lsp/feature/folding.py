"""Folding: blocks, tables, comments, and comments that follow one another on lines of their own.

A block folds onto the line that it begins on, its closing brace too if nothing follows that.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from lsprotocol import types

from m3dc.syntax.parse import ast
from m3dc.text.span import Local

from ..comments import comments
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span, Text


@request(types.TEXT_DOCUMENT_FOLDING_RANGE)
def folding(snapshot: Snapshot, params: types.FoldingRangeParams) -> list[types.FoldingRange]:
    """What can be folded, of whole lines; at most one begins on a line. Where the client takes only so many, they
    are the longest: what stands around another is longer than it."""
    del params
    text = snapshot.text
    found: dict[int, types.FoldingRange] = {}
    for _, end, first, last in _with_lines(text, list(_blocks(snapshot))):
        if last > first and text.data[end : text.line_end(last)].strip():
            last -= 1
        if last > first:
            found.setdefault(first, types.FoldingRange(first, last))
    for _, _, first, last in _with_lines(text, list(_comments(snapshot))):
        if last > first:
            found.setdefault(first, types.FoldingRange(first, last, kind=types.FoldingRangeKind.Comment))
    folds = sorted(found.values(), key=lambda fold: fold.start_line - fold.end_line)[: snapshot.client.most_folds]
    return sorted(folds, key=lambda fold: fold.start_line)


def _with_lines(text: Text, spans: list[Span]) -> Iterator[tuple[int, int, int, int]]:
    """Each range with the lines on which it begins and ends."""
    places = np.array(spans, np.int64).reshape(-1, 2)
    lines = text.positions(places - [0, 1])[0]
    yield from (tuple(row) for row in np.concatenate([places, lines], axis=1).tolist())


def _blocks(snapshot: Snapshot) -> Iterator[Span]:
    """All items with braces, outer ones first."""
    for top in snapshot.analysis.items:
        yield from map(top.place, _braced(top.item))


def _braced(item: ast.Item) -> Iterator[Local]:
    match item:
        case ast.Variables() | ast.Table():
            yield item.span
        case ast.Block() | ast.Assignment() if item.body is not None:
            yield item.span
            for member in item.body.items:
                yield from _braced(member)
        case _:
            pass


def _comments(snapshot: Snapshot) -> Iterator[Span]:
    """Each comment, or several that stand on lines of their own, one below the other."""
    data = snapshot.text.data
    run: Span | None = None
    for start, end in comments(snapshot.analysis).spans:
        line_end = data.find(b"\n", end)
        own_line = not (
            data[data.rfind(b"\n", 0, start) + 1 : start].strip()
            or data[end : line_end if line_end >= 0 else len(data)].strip()
        )
        if run is not None and own_line:
            between = data[run[1] : start]
            if not between.strip() and between.count(b"\n") == 1:
                run = run[0], end
                continue
        if run is not None:
            yield run
        run = (start, end) if own_line else None
        if run is None:
            yield start, end
    if run is not None:
        yield run
