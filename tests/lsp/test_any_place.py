"""What tells of a place answers at any place of any text: scenes with every mistake there is a diagnostic for, and
scenes cut off anywhere."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lsprotocol import types

from m3d_lsp.client import Client
from m3d_lsp.feature import code_lens, colour, completion, hover, inlay_hints, inline_values, signature
from m3d_lsp.settings import Settings
from m3d_lsp.snapshot import Snapshot
from m3d_lsp.text import Text
from m3dc.analysis import Analyser

ROOT = Path(__file__).parents[2]
SCENES = sorted([*(ROOT / "tests/compiler/diagnostics").glob("*.m3d"), *(ROOT / "examples").glob("*.m3d")])
IDENTIFIER = types.TextDocumentIdentifier("file:///scene.m3d")
CLIENT = Client(True, True, True, True, True, True, True)

# So many places of each scene are asked about.
PLACES = 120


def look(text: str) -> Snapshot:
    held = Text.of(text)
    return Snapshot(IDENTIFIER.uri, 1, held, Analyser().analyse(held.source), Settings(), CLIENT)


def ask_about(snapshot: Snapshot, offset: int) -> None:
    place = snapshot.text.position(offset)
    found = hover.hover(snapshot, types.HoverParams(IDENTIFIER, place))
    assert found is None or found.contents.value
    signature.signature(snapshot, types.SignatureHelpParams(IDENTIFIER, place))
    for item in completion.completion(snapshot, types.CompletionParams(IDENTIFIER, place)).items:
        assert item.label
        assert item.text_edit is not None


def ask_about_all(snapshot: Snapshot) -> None:
    whole = snapshot.range((0, len(snapshot.text.data)))
    inlay_hints.inlay_hints(snapshot, types.InlayHintParams(IDENTIFIER, whole))
    context = types.InlineValueContext(0, whole)
    inline_values.inline_values(snapshot, types.InlineValueParams(IDENTIFIER, whole, context))
    code_lens.code_lens(snapshot, types.CodeLensParams(IDENTIFIER))
    for found in colour.document_colour(snapshot, types.DocumentColorParams(IDENTIFIER)):
        assert colour.colour_presentation(snapshot, types.ColorPresentationParams(IDENTIFIER, found.color, found.range))


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_every_mistake(scene: Path) -> None:
    snapshot = look(scene.read_text(encoding="utf-8", errors="surrogateescape"))
    ask_about_all(snapshot)
    for offset in range(0, len(snapshot.text.data) + 1, len(snapshot.text.data) // PLACES + 1):
        ask_about(snapshot, offset)


WORDS = """
    SOLID SPHERE SURFACE COLOR TRANSFORM ROTX POLYGONS VERTICES FACETS VARIABLES NUMBER TEXTURE WOOD COLORS SCENE MIRAGE
    PROFILE { } { } < > , ; = a b 1 2 -3 1e9 /* */ < 1, 0, 0 >
"""


@settings(max_examples=40)
@given(st.lists(st.sampled_from(WORDS.split())))
def test_any_words(words: list[str]) -> None:
    snapshot = look(" ".join(["VARIABLES { NUMBER a; SOLID b; } a = 1", *words]))
    ask_about_all(snapshot)
    for offset in range(0, len(snapshot.text.data) + 1, 7):
        ask_about(snapshot, offset)
