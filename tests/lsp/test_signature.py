"""The arguments of what is being typed, and which is next."""

from __future__ import annotations

import pytest
from editor import Editor
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")


async def ask(editor: Editor, marked: str) -> types.SignatureHelp | None:
    scene = editor.open(marked)
    return await editor.client.text_document_signature_help_async(
        types.SignatureHelpParams(scene.identifier, scene.cursor)
    )


async def check(editor: Editor, marked: str, label: str) -> None:
    """The signature at the cursor; the argument that is next stands in brackets."""
    found = await ask(editor, marked)
    assert found is not None
    (signature,) = found.signatures
    assert signature.parameters is not None
    assert found.active_parameter is not None
    label_range = signature.parameters[found.active_parameter].label
    assert not isinstance(label_range, str)
    start, end = label_range
    text = signature.label
    assert f"{text[:start]}[{text[start:end]}]{text[end:]}" == label


async def test_lists_of_numbers(editor: Editor) -> None:
    await check(editor, "SCENE { VIEW { REGION $0", "REGION [top], left, bottom, right")
    await check(editor, "SCENE { VIEW { REGION 0, 1$0", "REGION top, [left], bottom, right")
    await check(editor, "SCENE { VIEW { REGION 0, 1, 2, $0 } }", "REGION top, left, bottom, [right]")


async def test_vectors(editor: Editor) -> None:
    await check(editor, "SCENE { VIEW { FROM $0", "FROM < [x], y, z >")
    await check(editor, "SCENE { VIEW { FROM < 1, $0 > } }", "FROM < x, [y], z >")
    await check(editor, "SOLID { SPHERE { } SURFACE { COLOR < 1, 0, $0", "COLOR < red, green, [blue] >")
    await check(editor, "VARIABLES { VECTOR v; } v = < 1, $0", "v = < x, [y], z >")


async def test_one_argument(editor: Editor) -> None:
    await check(editor, "SCENE { VIEW { FOV 4$0 } }", "FOV [field of view]")


async def test_rows(editor: Editor) -> None:
    facets = "SOLID { POLYGONS { FACETS { "
    await check(editor, facets + "$0", "FACETS { [facets]  first second third  ... }")
    await check(editor, facets + "2 0 1 2 3 $0", "FACETS { facets  first [second] third  ... }")
    colors = "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { COLORS { "
    row = "COLORS {{ {} end < red, green, blue > < red, green, blue >  ... }}"
    await check(editor, colors + "$0", row.format("[start]"))
    await check(editor, colors + "0 1 < 1, 1, 1 > < 0, 0, 0 > $0", row.format("[start]"))
    await check(
        editor,
        colors + "0 1 < 1, 1, 1 > < 0, $0",
        "COLORS { start end < red, green, blue > < red, [green], blue >  ... }",
    )


async def test_a_long_table(editor: Editor) -> None:
    rows = " ".join(f"{n} {n + 1} {n + 2}" for n in range(5000))
    await check(
        editor, f"SOLID {{ POLYGONS {{ FACETS {{ 5001 {rows} 7 $0", "FACETS { facets  first [second] third  ... }"
    )
    rows = " ".join(f"< {n}, 0, 1e-1 >" for n in range(5000))
    await check(
        editor, f"SOLID {{ POLYGONS {{ VERTICES {{ 5001 {rows} < 7, $0", "VERTICES { vertices  < x, [y], z >  ... }"
    )


async def test_the_same_keyword_in_another_block(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE { TRANSFORM { SCALE $0", "SCALE < [x], y, z >")
    await check(editor, "SOLID { SPHERE { } SURFACE { TEXTURE { SPOTTED { SCALE $0", "SCALE [amount]")


async def test_none_where_no_argument_follows(editor: Editor) -> None:
    assert await ask(editor, "SCENE { VIEW { FOV 45 $0 } }") is None
    assert await ask(editor, "SCENE { $0 }") is None
    assert await ask(editor, "SCENE { /* FOV $0 */ }") is None
    assert await ask(editor, "$0") is None
