"""From a variable to where it is declared, assigned to and used."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Sequence

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")

SCENE = """\
VARIABLES { NUMBER size, far; SPHERE ball; }
size = 0.5
size = 2
far = size
ball = { RADIUS size CENTER < far, 0, 0 > }
SOLID { SPHERE ball { RADIUS size } }
size = 3
LIGHT { }
"""


def shown(scene: Scene, locations: Sequence[types.Location | types.LocationLink] | types.Location | None) -> list[str]:
    """Each place as its line, with the range in brackets."""
    lines = scene.text.split("\n")
    found: list[str] = []
    for location in locations or () if not isinstance(locations, types.Location) else [locations]:
        assert isinstance(location, types.Location)
        assert location.uri == scene.uri
        start, end = location.range.start, location.range.end
        line = lines[start.line]
        found.append(f"{line[: start.character]}[{line[start.character : end.character]}]{line[end.character :]}")
    return found


Ask = Callable[[Editor, Scene], Awaitable[list[str]]]


async def definition(editor: Editor, scene: Scene) -> list[str]:
    params = types.DefinitionParams(**scene.at())
    return shown(scene, await editor.client.text_document_definition_async(params))


async def declaration(editor: Editor, scene: Scene) -> list[str]:
    params = types.DeclarationParams(**scene.at())
    return shown(scene, await editor.client.text_document_declaration_async(params))


async def type_definition(editor: Editor, scene: Scene) -> list[str]:
    params = types.TypeDefinitionParams(**scene.at())
    return shown(scene, await editor.client.text_document_type_definition_async(params))


DECLARED = "VARIABLES { NUMBER [size], far; SPHERE ball; }"


@pytest.mark.parametrize(
    ("ask", "place", "expected"),
    [
        (definition, "RADIUS si$0ze }", ["[size] = 2", DECLARED]),
        (definition, "far = size$0\n", ["[size] = 2", DECLARED]),
        (definition, "$0size = 3", [DECLARED]),
        (definition, "NUMBER $0size", [DECLARED]),
        (definition, "RAD$0IUS size }", []),
        (declaration, "RADIUS si$0ze }", [DECLARED]),
        (declaration, "size = $03", []),
        (type_definition, "SPHERE ba$0ll {", ["VARIABLES { NUMBER size, far; [SPHERE] ball; }"]),
        (type_definition, "NUMBER size, $0far", ["VARIABLES { [NUMBER] size, far; SPHERE ball; }"]),
        (type_definition, "LI$0GHT", []),
    ],
)
async def test_going_to_a_place(editor: Editor, ask: Ask, place: str, expected: list[str]) -> None:
    scene = editor.open(SCENE.replace(place.replace("$0", ""), place))
    assert await ask(editor, scene) == expected


@pytest.mark.parametrize("declared", [True, False])
async def test_references(editor: Editor, declared: bool) -> None:
    scene = editor.open(SCENE.replace("size = 3", "si$0ze = 3"))
    params = types.ReferenceParams(context=types.ReferenceContext(include_declaration=declared), **scene.at())
    found = shown(scene, await editor.client.text_document_references_async(params))
    assert found == [DECLARED] * declared + [
        "[size] = 0.5",
        "[size] = 2",
        "far = [size]",
        "ball = { RADIUS [size] CENTER < far, 0, 0 > }",
        "SOLID { SPHERE ball { RADIUS [size] } }",
        "[size] = 3",
    ]


async def test_an_undeclared_name_is_found_where_it_stands(editor: Editor) -> None:
    scene = editor.open("SOLID { SPHERE { RADIUS x$0 CENTER < x, 0, x > } }")
    assert await definition(editor, scene) == []
    params = types.ReferenceParams(context=types.ReferenceContext(include_declaration=True), **scene.at())
    assert len(await editor.client.text_document_references_async(params) or ()) == 3


async def test_highlights_tell_reading_from_writing(editor: Editor) -> None:
    scene = editor.open(SCENE.replace("far = size", "fa$0r = size"))
    found = await editor.client.text_document_document_highlight_async(types.DocumentHighlightParams(**scene.at()))
    assert [(scene.part(mark.range), mark.kind) for mark in found or ()] == [
        ("far", types.DocumentHighlightKind.Write),
        ("far", types.DocumentHighlightKind.Write),
        ("far", types.DocumentHighlightKind.Read),
    ]
    scene = editor.replace(scene, "SO$0LID { }")
    params = types.DocumentHighlightParams(**scene.at())
    assert await editor.client.text_document_document_highlight_async(params) is None
