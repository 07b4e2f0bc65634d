"""Semantic tokens, full, of a range, and as the difference to those before: what each word is, for editors to colour.

Keywords are told apart as the highlight query of the grammar does; a variable is marked where it is declared and where
it is assigned to, and has its type as a modifier. The numbers of a long table are marked only where they are looked at.

Editors move the tokens that they get by what was typed since they asked: tokens of a later text would be moved twice,
and end behind the ends of their lines. Where there is a later text they are refused, and asked for again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from itertools import count
from threading import Lock
from typing import NamedTuple

import numpy as np
from lsprotocol import types
from numpy.typing import NDArray
from tree_sitter import Language, Query, QueryCursor

import m3d_language
from m3d_language.table import LANGUAGE
from m3dc.analysis import Analysis
from m3dc.syntax import numerals

from ..comments import comments
from ..names import Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..text import Span, Text

Numbers = NDArray[np.int64]

# The captures of the highlight query, as LSP names them. Punctuation has no name there.
KINDS = {
    "comment": types.SemanticTokenTypes.Comment,
    "type": types.SemanticTokenTypes.Type,
    "property": types.SemanticTokenTypes.Property,
    "attribute": types.SemanticTokenTypes.Modifier,
    "keyword": types.SemanticTokenTypes.Keyword,
    "number": types.SemanticTokenTypes.Number,
    "variable": types.SemanticTokenTypes.Variable,
    "operator": types.SemanticTokenTypes.Operator,
}
ROLES = {
    Role.DECLARATION: types.SemanticTokenModifiers.Declaration,
    Role.ASSIGNMENT: types.SemanticTokenModifiers.Modification,
}
MODIFIERS = [*(modifier.value for modifier in ROLES.values()), *(type_.lower() for type_ in LANGUAGE.types)]
LEGEND = types.SemanticTokensLegend([kind.value for kind in KINDS.values()], MODIFIERS)

LONG = 20_000  # bytes of a table of which not each number is marked

_QUERY = Query(Language(m3d_language.language()), m3d_language.HIGHLIGHTS_QUERY)
_KIND = {capture: number for number, capture in enumerate(KINDS)}
_BIT = {name: 1 << number for number, name in enumerate(MODIFIERS)}
_LINE = re.compile(rb"\S(?:[^\r\n]*\S)?")


class Tokens(NamedTuple):
    """Tokens in the order of the text, each within one line: where each begins and ends, its kind and modifiers."""

    starts: Numbers
    ends: Numbers
    kinds: Numbers
    modifiers: Numbers


@request(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, LEGEND, exact=True)
def full(snapshot: Snapshot, params: types.SemanticTokensParams) -> types.SemanticTokens:
    """The tokens of the whole text."""
    del params
    data = _encoded(snapshot.text, _tokens(snapshot.analysis))
    return types.SemanticTokens(data.reshape(-1).tolist(), _remember(snapshot.uri, data))


@request(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, LEGEND, exact=True)
def part(snapshot: Snapshot, params: types.SemanticTokensRangeParams) -> types.SemanticTokens:
    """The tokens on the lines of a range."""
    text = snapshot.text
    first, last = params.range.start.line, params.range.end.line
    tokens = _tokens_of(snapshot.analysis, (text.line_start(first), text.line_start(last + 1)))
    return types.SemanticTokens(_encoded(text, tokens).reshape(-1).tolist())


@request(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL_DELTA, LEGEND, exact=True)
def delta(
    snapshot: Snapshot, params: types.SemanticTokensDeltaParams
) -> types.SemanticTokensDelta | types.SemanticTokens:
    """What is to be changed in the tokens that the client has; all of them, if these are no longer known."""
    data = _encoded(snapshot.text, _tokens(snapshot.analysis))
    before = _REMEMBERED.get(snapshot.uri)
    known = _remember(snapshot.uri, data)
    if before is None or before[0] != params.previous_result_id:
        return types.SemanticTokens(data.reshape(-1).tolist(), known)
    old = before[1]
    shorter = min(len(old), len(data))
    same = _alike(old[:shorter], data[:shorter])
    rest = shorter - same
    tail = _alike(old[len(old) - rest :][::-1], data[len(data) - rest :][::-1])
    gone, come = len(old) - tail - same, data[same : len(data) - tail]
    changed = gone or len(come)
    edit = types.SemanticTokensEdit(5 * same, 5 * gone, come.reshape(-1).tolist())
    return types.SemanticTokensDelta([edit] if changed else [], known)


# The tokens that the client has of each document, and by what it knows them.
_REMEMBERED: dict[str, tuple[str, NDArray[np.uint32]]] = {}
_REMEMBERING = Lock()
_NUMBERS = count(1)
_MOST = 64  # documents


def _remember(uri: str, data: NDArray[np.uint32]) -> str:
    known = str(next(_NUMBERS))
    with _REMEMBERING:
        _REMEMBERED.pop(uri, None)
        while len(_REMEMBERED) >= _MOST:
            del _REMEMBERED[next(iter(_REMEMBERED))]
        _REMEMBERED[uri] = known, data
    return known


def _alike(one: NDArray[np.uint32], other: NDArray[np.uint32]) -> int:
    """How many rows two tables of one length have in common at the beginning."""
    differ = np.flatnonzero((one != other).any(axis=1))
    return int(differ[0]) if differ.size else len(one)


def _encoded(text: Text, tokens: Tokens) -> NDArray[np.uint32]:
    """LSP's five numbers a token: lines and characters after the one before, length, kind, modifiers."""
    lines, characters = text.positions(tokens.starts)
    _, ends = text.positions(tokens.ends)
    down = np.diff(lines, prepend=0)
    right = np.where(down == 0, np.diff(characters, prepend=0), characters)
    return np.stack([down, right, ends - characters, tokens.kinds, tokens.modifiers], axis=1).astype(np.uint32)


@lru_cache(maxsize=8)
def _tokens(analysis: Analysis) -> Tokens:
    return _tokens_of(analysis, None)


def _tokens_of(analysis: Analysis, within: Span | None) -> Tokens:
    """The tokens of a text, or those that begin in a range of it."""
    data = analysis.source.data
    low, high = within or (0, len(data))
    longest = LONG if within is None else len(data)
    starts: list[int] = []
    ends: list[int] = []
    kinds: list[int] = []
    cursor = QueryCursor(_QUERY)
    if within is not None:
        cursor.set_byte_range(low, high)
    for capture, nodes in cursor.captures(analysis.tree.root_node).items():
        if capture not in _KIND or capture == "comment":
            continue
        spans = [(node.start_byte, node.end_byte) for node in nodes if not node.is_missing]
        if capture == "number":
            spans = list(_numerals(data, spans, (low, high), longest))
        starts += [start for start, _ in spans]
        ends += [end for _, end in spans]
        kinds += [_KIND[capture]] * len(spans)
    remarks = np.array(comments(analysis).spans, np.int64).reshape(-1, 2)
    outside = ~_in_any(remarks, np.array(starts, np.int64))
    lines = [
        match.span()
        for start, end in remarks[(remarks[:, 0] < high) & (remarks[:, 1] > low)].tolist()
        for match in _LINE.finditer(data, max(start, low), min(end, high))
    ]
    spans_ = np.concatenate([
        np.array([starts, ends], np.int64).T.reshape(-1, 2)[outside],
        np.array(lines, np.int64).reshape(-1, 2),
    ])  # fmt: skip
    all_kinds = np.concatenate([np.array(kinds, np.int64)[outside], np.full(len(lines), _KIND["comment"], np.int64)])
    order = np.argsort(spans_[:, 0], kind="stable")
    order = order[(spans_[order, 0] >= low) & (spans_[order, 0] < high)]
    begin, end = spans_[order].T
    return Tokens(begin, end, all_kinds[order], _modifiers(analysis, begin))


def _numerals(data: bytes, spans: list[Span], within: Span, longest: int) -> Iterator[Span]:
    """The numbers one by one, of tables too."""
    for start, end in spans:
        if end - start <= longest:
            start, end = max(start, within[0]), min(end, within[1])
            yield from numerals.scalars(data, start, end)


def _in_any(spans: Numbers, places: Numbers) -> NDArray[np.bool_]:
    """Which places are in one of some ranges, which are in order and apart."""
    index = np.searchsorted(spans[:, 0], places, side="right") - 1
    return (index >= 0) & (places < np.append(spans[:, 1], 0)[index])


def _modifiers(analysis: Analysis, starts: Numbers) -> Numbers:
    """What is known of the variables among the tokens that start at some places."""
    known = names(analysis)
    types_ = {name: _BIT.get(declaration.type.lower(), 0) for name, declaration in known.declared().items()}
    found = np.zeros(len(starts), np.int64)
    places = np.array([occurrence.span[0] for occurrence in known.occurrences], np.int64)
    bits = np.array(
        [
            types_.get(occurrence.name, 0) | (_BIT[ROLES[occurrence.role].value] if occurrence.role in ROLES else 0)
            for occurrence in known.occurrences
        ],
        np.int64,
    )
    if len(starts) and len(places):
        index = np.minimum(np.searchsorted(starts, places), len(starts) - 1)
        at = starts[index] == places
        found[index[at]] = bits[at]
    return found
