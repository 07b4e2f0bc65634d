"""From a variable to where it is declared, assigned to and used."""

from __future__ import annotations

import re
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
        (definition, "RADIUS si$0ze }", ["[size] = 2"]),
        (definition, "far = size$0\n", ["[size] = 2"]),
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


MESH = """\
VARIABLES { VECTOR top; NUMBER last; POLYGONS house; }
top = < 0, 0, 1 >
last = 3
house = {
  VERTICES { 4
    < 0, 0, 0 >  < 1, 0, 0 >  /* 2 < 9, 9, 9 > */ < 0, 1, 0 >
    top }
  FACETS { 2   0 1 2   /* 1 */ 1 2 last }
}
SOLID { POLYGONS house { NOPHONG SFACETS { 1
  2 < 0, 0, 1 > } } }
"""


@pytest.mark.parametrize(
    ("place", "expected"),
    [
        ("0$0 1 2   /*", ["< 0, 0, 0 >"]),
        ("0 1 $02   /*", ["< 0, 1, 0 >"]),
        ("/* 1 */ $01 2 last", ["< 1, 0, 0 >"]),
        ("< 0, 1$0, 0 >", ["< 0, 1, 0 >"]),
        ("/* $01 */", []),
        ("FACETS { $02 ", []),
        ("VERTICES { 4$0", []),
        ("la$0st }", ["last"]),
        ("$0top }", ["top"]),
    ],
)
async def test_from_a_corner_to_its_vertex(editor: Editor, place: str, expected: list[str]) -> None:
    scene = editor.open(MESH.replace(place.replace("$0", ""), place))
    found = await editor.client.text_document_definition_async(types.DefinitionParams(**scene.at()))
    places = [found] if isinstance(found, types.Location) else found or ()
    assert [scene.part(each.range) for each in places if isinstance(each, types.Location)] == expected


@pytest.mark.parametrize("place", ["< 1, $00, 0 >  /*", "0 $01 2   /*", "/* 1 */ 1$0 2"])
async def test_the_facets_about_a_vertex(editor: Editor, place: str) -> None:
    scene = editor.open(MESH.replace(place.replace("$0", ""), place))
    marks = await editor.client.text_document_document_highlight_async(types.DocumentHighlightParams(**scene.at()))
    assert [(scene.part(mark.range), mark.kind == types.DocumentHighlightKind.Read) for mark in marks or ()] == [
        ("< 1, 0, 0 >", False),
        ("1", True),
        ("1", True),
    ]
    params = types.ReferenceParams(context=types.ReferenceContext(include_declaration=False), **scene.at())
    found = shown(scene, await editor.client.text_document_references_async(params))
    assert found == [
        "  FACETS { 2   0 [1] 2   /* 1 */ 1 2 last }",
        "  FACETS { 2   0 1 2   /* 1 */ [1] 2 last }",
    ]


async def test_a_variable_names_a_corner(editor: Editor) -> None:
    scene = editor.open(MESH.replace("last = 3", "last = 0").replace("{ 4\n    < 0", "{ 4\n    < $00"))
    params = types.ReferenceParams(context=types.ReferenceContext(include_declaration=False), **scene.at())
    assert [scene.part(each.range) for each in await editor.client.text_document_references_async(params) or ()] == [
        "0",
        "last",
    ]


async def test_vertices_of_a_variable_that_is_copied(editor: Editor) -> None:
    scene = editor.open("""\
VARIABLES { POLYGONS house; }
house = { VERTICES { 3 < 0, 0, 0 > < 1, 0, 0 > < 0, 1, 0 > } }
SOLID { POLYGONS house { FACETS { 1 0 1 2$0 } } }
""")
    found = await editor.client.text_document_definition_async(types.DefinitionParams(**scene.at()))
    assert shown(scene, found) == ["house = { VERTICES { 3 < 0, 0, 0 > < 1, 0, 0 > [< 0, 1, 0 >] } }"]


@pytest.mark.parametrize(
    "broken",
    [
        "SOLID { SPHERE { RADIUS a CENTER < a, 2 > } }",
        "SOLID { SPHERE { RADIUS a CENTER < a, 2*a, 3 > } }",
        "SOLID { SPHERE { RADIUS a } ( a",
        "solid { sphere { radius a } }",
        "SOLID { POLYGONS { VERTICES { 3 < a 1, 0 > } FACETS { a; } } }",
        "a = = 1 SOLID { SPHERE { RADIUS a",
    ],
)
async def test_names_in_broken_text_are_found(editor: Editor, broken: str) -> None:
    scene = editor.open(f"VARIABLES {{ NUMBER a$0; }}\na = 1 /* a */\n{broken} /* a */\n")
    params = types.ReferenceParams(context=types.ReferenceContext(include_declaration=True), **scene.at())
    found = await editor.client.text_document_references_async(params) or ()
    assert len(found) == 2 + sum(token == "a" for token in re.findall(r"\w+", broken))
