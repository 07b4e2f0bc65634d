"""Whatever is typed, the server holds the text that the editor holds, and says of it what it would say had it been
opened so."""

from __future__ import annotations

import random
import re
from typing import Any

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")

START = """\
VARIABLES { NUMBER size; SURFACE red; }
size = 2 /* 🌅 */
red = { COLOR < 1, 0, 0 > }\r
SOLID { SPHERE { RADIUS size } SURFACE red }
LIGHT { SOURCE { FROM < 0, 0, 9 > } }
"""
TYPED = [
    "{", "}", "<", ">", "1", "-", ".5", "e9", ",", ";", "=", " ", "\n", "\r\n", "\r", "\n\n", "/*", "*/", "size", "red",
    "SOLID { SPHERE { } }\n", "VARIABLES { VECTOR up; }\n", "COLOR < 0, 1, 0 >", "RADIUS", "é", "🐚", "/* 𝔐 */", "\t",
    "",    "FACETS { 1 0 1 2 }", "\x00",
]  # fmt: skip
LINE_BREAK = re.compile("\r\n|\r|\n")


def place(text: str, index: int) -> types.Position:
    """Where a character stands, as LSP counts lines."""
    breaks = [found.end() for found in LINE_BREAK.finditer(text) if found.end() <= index]
    return types.Position(len(breaks), index - (breaks[-1] if breaks else 0))


def somewhere(text: str, chance: random.Random) -> int:
    """An index that a position can name: not within a line break."""
    index = chance.randint(0, len(text))
    return index - 1 if text[index - 1 : index + 1] == "\r\n" else index


def edited(text: str, chance: random.Random) -> tuple[str, types.TextDocumentContentChangePartial]:
    """A text with a small change, and the change."""
    start = somewhere(text, chance)
    end = start if chance.random() < 0.5 else min(len(text), start + chance.randint(0, 12))
    if text[end - 1 : end + 1] == "\r\n":
        end += 1
    new = chance.choice(TYPED)
    range_ = types.Range(place(text, start), place(text, end))
    return text[:start] + new + text[end:], types.TextDocumentContentChangePartial(range_, new)


async def known(editor: Editor, scene: Scene) -> tuple[list[types.Diagnostic], Any]:
    """What the server says of a scene: its diagnostics, and its tree, which shows the text."""
    tree = await editor.client.protocol.send_request_async("m3d/syntaxTree", {"textDocument": {"uri": scene.uri}})
    diagnostics = await editor.diagnostics(scene)
    for place in (place for diagnostic in diagnostics for place in diagnostic.related_information or ()):
        place.location.uri = ""  # that of the document itself
    return diagnostics, tree.nodes


@pytest.mark.parametrize("seed", range(12))
async def test_an_edited_document_is_as_one_just_opened(editor: Editor, seed: int) -> None:
    chance = random.Random(seed)
    scene = editor.open(START, "edited")
    text = START
    for _ in range(8):
        for _ in range(chance.randint(1, 8)):
            changes: list[types.TextDocumentContentChangePartial] = []
            for _ in range(chance.choice((1, 1, 1, 3))):
                text, change = edited(text, chance)
                changes.append(change)
            editor.change(scene, *changes)
        fresh = editor.open(text.replace("$", ""), "fresh")
        assert await known(editor, scene) == await known(editor, fresh), repr(text)
