"""Lenses above a scene's blocks and variables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")

SCENE = """\
VARIABLES { NUMBER size, spare; }
size = 2 size = 3
SCENE { }
SOLID { SPHERE { RADIUS size } }
SOLID
{
    PLANE { }
}
"""


async def lenses(editor: Editor, scene: Scene) -> list[types.CodeLens]:
    found = await editor.client.text_document_code_lens_async(types.CodeLensParams(scene.identifier))
    assert found is not None
    return list(found)


async def test_what_can_be_done_and_what_is_used(editor: Editor) -> None:
    scene = editor.open(SCENE)
    found = await lenses(editor, scene)
    assert [(lens.range.start.line, lens.command.title, lens.command.command) for lens in found if lens.command] == [
        (0, "size: used once, set twice", "m3d.showReferences"),
        (0, "spare: used never", "m3d.showReferences"),
        (2, "Preview", "m3d.preview"),
        (2, "Render", "m3d.render"),
        (2, "Dump", "m3d.dump"),
        (4, "Dump", "m3d.dump"),
    ]
    assert found[0].command is not None
    given: Sequence[Any] | None = found[0].command.arguments
    assert given is not None
    uri, position, locations = given
    assert uri == scene.uri
    assert (position["line"], position["character"]) == (0, 19)
    assert [place["range"]["start"]["line"] for place in locations] == [1, 1, 3]


async def test_a_file_without_a_scene_block(editor: Editor) -> None:
    found = await lenses(editor, editor.open("\nSOLID {\n SPHERE { } }\n"))
    titles = [(lens.range.start.line, lens.command.title) for lens in found if lens.command]
    assert titles == [(0, "Preview"), (0, "Render"), (0, "Dump"), (1, "Dump")]


async def test_there_is_no_comb_of_lenses(editor: Editor) -> None:
    few = "SCENE { }\n" + "SOLID\n{\n    PLANE { }\n}\n" * 10
    assert len(await lenses(editor, editor.open(few))) == 13
    assert len(await lenses(editor, editor.open(few + "LIGHT\n{\n}\n"))) == 3
    crowded = "VARIABLES { NUMBER a, b, c, d;\n NUMBER e; }\na = b e = d a = e\n"
    titles = [lens.command.title for lens in await lenses(editor, editor.open(crowded)) if lens.command]
    assert titles == ["a: used never, set twice", "c: used never", "e: used once, set once"]


async def test_they_can_be_switched_off(editor: Editor) -> None:
    scene = editor.open(SCENE)
    await editor.configure(scene, {"codeLens": {"enabled": False}})
    assert await lenses(editor, scene) == []
    await editor.configure(scene, {})
    assert await lenses(editor, scene)
