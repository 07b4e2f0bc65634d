"""What an editor asks of any place of any text is answered without an exception; laying out twice is once."""

from __future__ import annotations

import warnings

from lsprotocol import types

import m3dc
from m3d_lsp.client import Client
from m3d_lsp.feature import (
    code_lens,
    colour,
    completion,
    definition,
    folding,
    hover,
    inlay_hints,
    inline_values,
    references,
    selection,
    semantic_tokens,
    signature,
)
from m3d_lsp.settings import Settings
from m3d_lsp.snapshot import Snapshot
from m3d_lsp.text import Text
from m3dc.analysis import Analyser
from m3dc.format import FormatError, format, format_range

from . import repeating, text

SUFFIX = ".m3d"
CASES = 40
PLACES = 12

IDENTIFIER = types.TextDocumentIdentifier("file:///scene.m3d")
ALL = Client(
    hover_markdown=True, completion_markdown=True, signature_markdown=True, snippets=True, insert_replace=True,
    label_offsets=True,
)  # fmt: skip

make = text.make


def check(data: bytes) -> str | None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        held = Text.of(data.decode("utf-8", "replace"))
        snapshot = Snapshot(IDENTIFIER.uri, 1, held, Analyser().analyse(held.source), Settings(), ALL)
        _ask_about_all(snapshot)
        for offset in range(0, len(held.data) + 1, len(held.data) // PLACES + 1):
            _ask_about(snapshot, offset)
        return _laid_out(held.data)


def _ask_about(snapshot: Snapshot, offset: int) -> None:
    place = snapshot.text.position(offset)
    hover.hover(snapshot, types.HoverParams(IDENTIFIER, place))
    signature.signature(snapshot, types.SignatureHelpParams(IDENTIFIER, place))
    completion.completion(snapshot, types.CompletionParams(IDENTIFIER, place))
    definition.definition(snapshot, types.DefinitionParams(IDENTIFIER, place))
    definition.type_definition(snapshot, types.TypeDefinitionParams(IDENTIFIER, place))
    references.references(snapshot, types.ReferenceParams(types.ReferenceContext(True), IDENTIFIER, place))
    selection.selection(snapshot, types.SelectionRangeParams(IDENTIFIER, [place]))


def _ask_about_all(snapshot: Snapshot) -> None:
    whole = snapshot.range((0, len(snapshot.text.data)))
    inlay_hints.inlay_hints(snapshot, types.InlayHintParams(IDENTIFIER, whole))
    context = types.InlineValueContext(0, whole)
    inline_values.inline_values(snapshot, types.InlineValueParams(IDENTIFIER, whole, context))
    code_lens.code_lens(snapshot, types.CodeLensParams(IDENTIFIER))
    colour.document_colour(snapshot, types.DocumentColorParams(IDENTIFIER))
    folding.folding(snapshot, types.FoldingRangeParams(IDENTIFIER))
    semantic_tokens.full(snapshot, types.SemanticTokensParams(IDENTIFIER))


def _laid_out(data: bytes) -> str | None:
    try:
        format_range(data, 1, 3)
        once = format(data)
    except FormatError:
        return None
    if format(once) != once:
        return "laid out twice it is not as laid out once"
    codes = [[d.code for d in m3dc.compile(version).diagnostics] for version in (data, once)]
    return None if codes[0] == codes[1] else f"laid out it has {codes[1]}, before {codes[0]}"


run = repeating(make, check)
