"""Colours are found where they are written, and a picked one is written as the scene writes its own."""

from __future__ import annotations

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")


async def colours(editor: Editor, scene: Scene) -> dict[str, tuple[float, float, float]]:
    """The colours of a scene by their text."""
    params = types.DocumentColorParams(scene.identifier)
    found = await editor.client.text_document_document_color_async(params)
    return {scene.part(each.range): (each.color.red, each.color.green, each.color.blue) for each in found}


async def test_colours_of_statements_tables_and_variables(editor: Editor) -> None:
    scene = editor.open(
        "VARIABLES { VECTOR sand, place; NUMBER half; }\n"
        "sand = < 0.8, 0.7, 0.5 > place = < 0.1, 0.2, 0.3 > half = 0.5\n"
        "SCENE { BACKGROUND < 1, half, 0 > VIEW { FROM place } }\n"
        "SOLID { SPHERE { CENTER < 1, 1, 1 > } SURFACE { COLOR sand TEXTURE { UBLEND {\n"
        "  COLORS { 0 0.5 < 1, 0, 0 > <0,1,0> } } } } }\n"
    )
    assert await colours(editor, scene) == {
        "< 0.8, 0.7, 0.5 >": (0.8, 0.7, 0.5),
        "< 1, half, 0 >": (1, 0.5, 0),
        "< 1, 0, 0 >": (1, 0, 0),
        "<0,1,0>": (0, 1, 0),
    }


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("< 0.8, 0.7, 0.5 >", "< 0.251, 0.5, 1 >"),
        ("<0.8,0.7,0.5>", "<0.251,0.5,1>"),
        ("<0.80, 0.70, 0.00>", "<0.25, 0.50, 1.00>"),
        ("< 0.80000, .7, 5e-1 >", "< 0.25098, 0.5, 1 >"),
        ("< 1, half, /* blue 1 */ 0 >", "< 0.251, 0.5, /* blue 1 */ 1 >"),
    ],
)
async def test_a_picked_colour_keeps_the_form(editor: Editor, before: str, after: str) -> None:
    scene = editor.open(f"SCENE {{ BACKGROUND $[{before}$] }}\n")
    color = types.Color(64 / 255, 0.5, 1.0, 1.0)
    params = types.ColorPresentationParams(scene.identifier, color, scene.range)
    (presentation,) = await editor.client.text_document_color_presentation_async(params)
    assert presentation.text_edit is not None
    assert presentation.text_edit.range == scene.range
    assert presentation.text_edit.new_text == presentation.label == after


async def test_a_component_that_stays_is_left_as_it_is(editor: Editor) -> None:
    scene = editor.open("VARIABLES { NUMBER dim; } dim = 0.25\nSCENE { BACKGROUND $[< dim, 5e-1, 0 >$] }\n")
    color = types.Color(64 / 255, 0.5, 1.0, 1.0)
    params = types.ColorPresentationParams(scene.identifier, color, scene.range)
    (presentation,) = await editor.client.text_document_color_presentation_async(params)
    assert presentation.label == "< dim, 5e-1, 1 >"
