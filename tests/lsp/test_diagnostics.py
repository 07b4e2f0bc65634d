"""Diagnostics in the editor are those of `m3dc`, and those of the text as it stands."""

from __future__ import annotations

import pytest
from editor import Editor, position
from lsprotocol import types

import m3dc

pytestmark = pytest.mark.asyncio(loop_scope="session")

LIGHT = "LIGHT { SOURCE { FROM < 0, 0, 9 > } }\n"


async def test_a_mistake_is_shown_where_it_is(editor: Editor) -> None:
    scene = editor.open("SOLID { SPHERE { RADIUS $[-5$] } }\n" + LIGHT)
    (shown,) = await editor.diagnostics(scene)
    assert shown.range == scene.range
    assert shown.severity == types.DiagnosticSeverity.Error
    assert shown.code == "M3D0401"
    assert shown.message == m3dc.compile(scene.text).diagnostics[0].message
    assert shown.code_description is not None
    assert shown.code_description.href.endswith("diagnostics.md#m3d0401")


@pytest.mark.parametrize("text", ["", "\n\n", "/* to be written */\n"])
async def test_a_file_that_is_still_empty_is_no_mistake(editor: Editor, text: str) -> None:
    (shown,) = await editor.diagnostics(editor.open(text))
    assert shown.severity == types.DiagnosticSeverity.Information
    assert shown.message.startswith("Empty data file")


async def test_it_goes_when_it_is_mended(editor: Editor) -> None:
    scene = editor.open("SOLID { SPHERE { RADIUS $[-$]5 } }\n" + LIGHT)
    assert await editor.diagnostics(scene)
    editor.change(scene, types.TextDocumentContentChangePartial(scene.range, ""))
    assert await editor.diagnostics(scene) == []


async def test_what_nothing_uses_is_faded_and_related_places_are_named(editor: Editor) -> None:
    scene = editor.open("VARIABLES { NUMBER $[spare$], same, same; }\nSOLID { SPHERE { RADIUS same } }\n" + LIGHT)
    shown = {diagnostic.code: diagnostic for diagnostic in await editor.diagnostics(scene)}
    assert shown["M3D0201"].related_information is not None
    assert shown["M3D0201"].related_information[0].message == "first declared here"
    scene = editor.replace(scene, "VARIABLES { NUMBER $[spare$]; }\nSOLID { SPHERE { } }\n" + LIGHT)
    (unused,) = await editor.diagnostics(scene)
    assert unused.range == scene.range
    assert list(unused.tags or ()) == [types.DiagnosticTag.Unnecessary]


async def test_a_closed_document_has_no_diagnostics(editor: Editor) -> None:
    scene = editor.open("SOLID { SPHERE }")
    assert await editor.diagnostics(scene)
    editor.close()
    await editor.client.wait_until(lambda: not editor.client.published[scene.uri].diagnostics or None)


async def test_several_edits_in_one_message(editor: Editor) -> None:
    text = "SOLID { SPHERE { RADIUS 1 } }\n" + LIGHT
    scene = editor.open(text)
    at = position(text, text.index("1"))
    first = types.TextDocumentContentChangePartial(types.Range(at, at), "-")
    line = types.TextDocumentContentChangePartial(types.Range(types.Position(0, 0), types.Position(0, 0)), "\n\n")
    editor.change(scene, first, line)
    (shown,) = await editor.diagnostics(scene)
    assert shown.range.start == types.Position(at.line + 2, at.character)
