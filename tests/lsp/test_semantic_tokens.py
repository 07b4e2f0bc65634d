"""Semantic tokens: of all of a text, of a part, and as differences that add up."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random

import pytest
from editor import Editor, Scene
from lsprotocol import types

from m3d_lsp.feature.semantic_tokens import LEGEND

pytestmark = pytest.mark.asyncio(loop_scope="session")

SCENE = """\
/* two
   lines \N{MILKY WAY} */
VARIABLES { NUMBER size; SPHERE ball; }
size = 0.5 ball = { RADIUS size }
SCENE { SHADOWS AMBIENT { INTENSITY 1 } MIRAGE { PROFILE { 0 1e1 /* 7 */ 5 11
 20 12 } } }
SOLID { SPHERE ball SURFACE { AMBIENT 0.5 COLOR < 1, size, missing > } }
"""


async def full(editor: Editor, scene: Scene) -> types.SemanticTokens:
    found = await editor.client.text_document_semantic_tokens_full_async(types.SemanticTokensParams(scene.identifier))
    assert found is not None
    return found


def shown(text: str, data: Sequence[int]) -> Iterator[str]:
    """Each token as its text, kind and modifiers."""
    lines = text.split("\n")
    line = character = 0
    for first in range(0, len(data), 5):
        down, right, length, kind, modifiers = data[first : first + 5]
        line, character = line + down, right + (character if down == 0 else 0)
        word = lines[line][character : character + length]
        assert len(word) == length > 0
        marks = [name for bit, name in enumerate(LEGEND.token_modifiers) if modifiers >> bit & 1]
        yield " ".join([word, str(LEGEND.token_types[kind]), *marks])


async def test_every_word_has_its_kind(editor: Editor) -> None:
    scene = editor.open(SCENE)
    found = list(shown(scene.text, (await full(editor, scene)).data))
    assert found[:12] == [
        "/* two comment",
        "lines \N{MILKY WAY} */ comment",
        "VARIABLES keyword",
        "NUMBER type",
        "size variable declaration number",
        "SPHERE type",
        "ball variable declaration sphere",
        "size variable modification number",
        "= operator",
        "0.5 number",
        "ball variable modification sphere",
        "= operator",
    ]
    words = dict(line.split(" ", 1) for line in found)
    assert (words["SHADOWS"], words["RADIUS"], words["missing"]) == ("modifier", "property", "variable")
    assert [line for line in found if line.startswith("AMBIENT")] == ["AMBIENT type", "AMBIENT property"]
    assert found[found.index("PROFILE property") + 1 :][:7] == [
        "0 number",
        "1e1 number",
        "/* 7 */ comment",
        "5 number",
        "11 number",
        "20 number",
        "12 number",
    ]


async def test_half_typed_text(editor: Editor) -> None:
    scene = editor.open("SOLID { SPHERE { RADIUS 1\nLIGHT { SOURCE } /* never closed\n")
    found = list(shown(scene.text, (await full(editor, scene)).data))
    assert found[:3] == ["SOLID type", "SPHERE type", "RADIUS property"]
    assert found[-1] == "/* never closed comment"


async def test_a_part_has_the_tokens_of_the_whole(editor: Editor) -> None:
    scene = editor.open(SCENE)
    lines = types.Range(types.Position(1, 0), types.Position(4, 3))
    params = types.SemanticTokensRangeParams(scene.identifier, lines)
    found = await editor.client.text_document_semantic_tokens_range_async(params)
    assert found is not None
    whole = list(shown(scene.text, (await full(editor, scene)).data))
    start, end = whole.index("lines \N{MILKY WAY} */ comment"), whole.index("20 number")
    assert list(shown(scene.text, found.data)) == whole[start:end]


async def test_a_long_table_is_marked_where_it_is_looked_at(editor: Editor) -> None:
    rows = "\n".join(f"{row} 10" for row in range(4000))
    scene = editor.open(f"SCENE {{ MIRAGE {{ PROFILE {{\n{rows}\n}} }} }}")
    assert len((await full(editor, scene)).data) == 5 * 3
    lines = types.Range(types.Position(3001, 0), types.Position(3002, 9))
    found = await editor.client.text_document_semantic_tokens_range_async(
        types.SemanticTokensRangeParams(scene.identifier, lines)
    )
    assert found is not None
    assert list(shown(scene.text, found.data)) == ["3000 number", "10 number", "3001 number", "10 number"]


async def test_differences_add_up(editor: Editor) -> None:
    random = Random(5)
    scene = editor.open(SCENE)
    known = await full(editor, scene)
    data, name = list(known.data), known.result_id
    for _ in range(20):
        at = random.randrange(len(scene.text))
        gone = random.choice([0, 1, 5])
        text = scene.text[:at] + random.choice(["", " ", "\n", "RADIUS 1 ", "{", "/*"]) + scene.text[at + gone :]
        scene = editor.replace(scene, text)
        assert name is not None
        params = types.SemanticTokensDeltaParams(scene.identifier, name)
        change = await editor.client.text_document_semantic_tokens_full_delta_async(params)
        assert isinstance(change, types.SemanticTokensDelta)
        for edit in change.edits:
            data[edit.start : edit.start + edit.delete_count] = edit.data or []
        name = change.result_id
    assert data == list((await full(editor, scene)).data)


async def test_no_change_is_no_edit_and_what_is_not_known_is_sent_whole(editor: Editor) -> None:
    scene = editor.open(SCENE)
    known = await full(editor, scene)
    assert known.result_id is not None
    same = types.SemanticTokensDeltaParams(scene.identifier, known.result_id)
    change = await editor.client.text_document_semantic_tokens_full_delta_async(same)
    assert isinstance(change, types.SemanticTokensDelta)
    assert not change.edits
    other = types.SemanticTokensDeltaParams(scene.identifier, "long ago")
    whole = await editor.client.text_document_semantic_tokens_full_delta_async(other)
    assert isinstance(whole, types.SemanticTokens)
    assert list(whole.data) == list(known.data)
