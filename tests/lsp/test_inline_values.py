"""What variables are worth, at the ends of the lines that use them."""

from __future__ import annotations

import pytest
from editor import Editor
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")


async def test_each_variable_once_a_line(editor: Editor) -> None:
    scene = editor.open(
        "VARIABLES { NUMBER size; VECTOR place; SPHERE ball; }\n"
        "$[size = 2 place = < size, size, 1 >\n"
        "ball = { RADIUS size }\n"
        "SOLID { SPHERE ball { CENTER place } }$]\n"
        "size = 7\n"
    )
    context = types.InlineValueContext(0, scene.range)
    params = types.InlineValueParams(scene.identifier, scene.range, context)
    found = await editor.client.text_document_inline_value_async(params)
    texts = [value for value in found or () if isinstance(value, types.InlineValueText)]
    assert len(texts) == len(found or ())
    assert [(value.range.start.line, value.text) for value in texts] == [
        (1, "size = 2"),
        (1, "place = < 2, 2, 1 >"),
        (2, "size = 2"),
        (3, "place = < 2, 2, 1 >"),
    ]
