"""Formatting in the editor is that of `m3dfmt`; beside broken items and while typing, as much of it as can be."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from editor import Editor, Scene, apply
from lsprotocol import types

from m3dc.format import format

pytestmark = pytest.mark.asyncio(loop_scope="session")

OPTIONS = types.FormattingOptions(tab_size=2, insert_spaces=True)
UGLY = "SOLID {\n SPHERE{RADIUS 2}\n\n\n   PLANE { }\n}\nx=1 /* \N{MILKY WAY} */   y=2\n"


def made(scene: Scene, edits: Sequence[types.TextEdit] | None) -> str:
    return apply(scene.text, edits or ())


async def document(editor: Editor, scene: Scene) -> str:
    params = types.DocumentFormattingParams(scene.identifier, OPTIONS)
    return made(scene, await editor.client.text_document_formatting_async(params))


async def typed(editor: Editor, marked: str, character: str) -> str:
    scene = editor.open(marked)
    params = types.DocumentOnTypeFormattingParams(scene.identifier, scene.cursor, character, OPTIONS)
    return made(scene, await editor.client.text_document_on_type_formatting_async(params))


async def test_a_document(editor: Editor) -> None:
    scene = editor.open(UGLY)
    out = await document(editor, scene)
    assert out == format(UGLY.encode()).decode()
    assert out != UGLY
    assert await document(editor, editor.open(out)) == out


async def test_beside_a_broken_item(editor: Editor) -> None:
    scene = editor.open("x=1\nSOLID { SPHERE{RADIUS < } }\ny=2\n")
    assert await document(editor, scene) == "x = 1\nSOLID { SPHERE{RADIUS < } }\ny = 2\n"


async def test_a_range(editor: Editor) -> None:
    scene = editor.open("x=1\n$[y=2\n$]z=3\n")
    params = types.DocumentRangeFormattingParams(scene.identifier, scene.range, OPTIONS)
    assert made(scene, await editor.client.text_document_range_formatting_async(params)) == "x=1\ny = 2\nz=3\n"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("SOLID {\n PLANE{}\n}$0\nx=1\n", "SOLID\n{\n    PLANE { }\n}\nx=1\n"),
        ("SOLID\n{\n  SPHERE {RADIUS 2}$0\n  PLANE{}\n}\n", "SOLID\n{\n    SPHERE { RADIUS 2 }\n  PLANE{}\n}\n"),
        ("SOLID { PLANE{} }$0 x=1\n", "SOLID { PLANE { } } x=1\n"),
        ("SOLID { SPHERE{ RADIUS < }$0 }\n", "SOLID { SPHERE{ RADIUS < } }\n"),
        ("/* } $0 */ x=1\n", "/* }  */ x=1\n"),
    ],
)
async def test_a_closing_brace(editor: Editor, before: str, after: str) -> None:
    assert await typed(editor, before, "}") == after


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("x=1\n$0", "x = 1\n"),
        ("x=1\n  $0\ny=2\n", "x = 1\n\ny=2\n"),
        ("SOLID {\n$0\n}\n", "SOLID {\n    \n}\n"),
        ("SOLID\n{\n  SPHERE\n  {\n$0\n", "SOLID\n{\n  SPHERE\n  {\n        \n"),
        ("SOLID /* { */\n$0\n", "SOLID /* { */\n\n"),
        ("/* {\n$0\n */", "/* {\n\n */"),
        ("SCENE { MIRAGE { PROFILE {\n  1 2\n  $0\n", "SCENE { MIRAGE { PROFILE {\n  1 2\n  \n"),
        ("SCENE { MIRAGE { PROFILE {\n$0\n", "SCENE { MIRAGE { PROFILE {\n            \n"),
    ],
)
async def test_a_line_break(editor: Editor, before: str, after: str) -> None:
    assert await typed(editor, before, "\n") == after


async def test_it_can_be_switched_off(editor: Editor) -> None:
    scene = editor.open(UGLY)
    for enabled, expected in ((False, UGLY), (True, format(UGLY.encode()).decode())):
        await editor.configure(scene, {"format": {"enabled": enabled}})
        assert await document(editor, scene) == expected
