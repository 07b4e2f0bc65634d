"""What one learns by pointing at a word, a number or a row."""

from __future__ import annotations

import pytest
from editor import Editor, Scene
from lsprotocol import types
from primitives import ENDLESS, scene

from m3dc.ir import PrimitiveKind

pytestmark = pytest.mark.asyncio(loop_scope="session")

LIGHT = "LIGHT { SOURCE { FROM < 0, 0, 9 > } }\n"


async def hover(editor: Editor, scene: Scene, mark: str = "0") -> types.Hover | None:
    return await editor.client.text_document_hover_async(types.HoverParams(**scene.at(mark)))  # type: ignore[arg-type]


async def check(editor: Editor, marked: str, *said: str) -> str:
    """The cursor is on what `$[` and `$]` enclose; all of `said` is in what is shown of it."""
    scene = editor.open(marked.replace("$[", "$[$0"))
    found = await hover(editor, scene)
    assert found is not None
    assert found.range == scene.range
    assert isinstance(found.contents, types.MarkupContent)
    for part in said:
        assert part in found.contents.value
    return found.contents.value


async def test_a_statement(editor: Editor) -> None:
    await check(
        editor, "SOLID { SPHERE { $[RADIUS$] 2 } }",
        "RADIUS radius", "The radius.", "scene units", "Default: `1`", "more than 0", "SPHERE { CENTER",
        "primitives.md#sphere", "thesis 7.5.5.3",
    )  # fmt: skip


@pytest.mark.parametrize("kind", PrimitiveKind, ids=lambda kind: kind.name)
async def test_every_primitive(editor: Editor, kind: PrimitiveKind) -> None:
    said = await check(editor, scene(kind).replace(kind.name, f"$[{kind.name}$]"), "In the scene:")
    assert ("- extents x" in said) == (kind not in ENDLESS)


async def test_a_keyword_means_what_it_does_in_its_block(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE { } SURFACE { $[AMBIENT$] 0.3 } }", "How much of the scene's constant ambient")
    await check(editor, "SCENE { $[AMBIENT$] { } }", "Indirect light", "`NSAMPLES`")
    await check(editor, "VARIABLES { SURFACE s; } s = { $[AMBIENT$] 0.3 }", "How much of the scene's constant ambient")
    await check(
        editor, "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { $[SLOPE$] 3 } } } }", "`WOOD` makes no use of it"
    )
    await check(editor, "$[VARIABLES$] { NUMBER a; }", "Declares variables")


async def test_a_keyword_in_broken_text(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE { $[RADIUS$] ", "The radius.")


async def test_a_variable_is_what_it_is_there(editor: Editor) -> None:
    text = "VARIABLES { NUMBER r; }\nr = 2\nSOLID { SPHERE { RADIUS $[r$] } }\nr = 3\n"
    shown = await check(editor, text, "NUMBER r = 2", "declared in [line 1]", "[line 2]", "[line 4]", "used once")
    assert "r = 3" not in shown
    await check(editor, "VARIABLES { NUMBER r; }\n$[r$] = 2\n", "r = 2", "used nowhere")
    await check(editor, "VARIABLES { SPHERE $[s$]; }\ns = { RADIUS 3 }\n", "SPHERE s\n", "assigned to in [line 2]")
    await check(editor, "SOLID $[house$]\n", "not declared")


REMARKS = """\
VARIABLES
{
    NUMBER size; /* radius of the ball, in *metres*, say */
    VECTOR sand, /* light
                    brown */
           grass;
    /* How high, and how far. */
    NUMBER high, far;
    NUMBER one, two; /* a pair */ NUMBER /* not its */ three; NUMBER four /* its own */, five;
    NUMBER six; /* m3d: allow M3D0503 */
}
/* From the map. */
high = 2 /* metres */
far = 1
far = 2
SOLID { SPHERE { RADIUS size CENTER < high, far, 0 > } SPHERE { CENTER sand } SPHERE { CENTER grass }
  SPHERE { CENTER < one, two, three > } SPHERE { CENTER < four, five, six > } }
"""


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ("RADIUS $0size", ["radius of the ball, in \\*metres\\*, say"]),
        ("NUMBER $0size", ["radius of the ball, in \\*metres\\*, say"]),
        ("CENTER $0sand", ["light brown"]),
        ("CENTER $0grass", []),
        ("< $0high", ["How high, and how far.", "From the map.", "metres"]),
        ("$0high = 2", ["How high, and how far.", "From the map.", "metres"]),
        ("high, $0far, 0", ["How high, and how far."]),
        ("< $0one", ["a pair"]),
        ("one, $0two, three >", ["a pair"]),
        ("two, $0three >", []),
        ("< $0four", ["its own"]),
        ("four, $0five, six", []),
        ("five, $0six", []),
    ],
)
async def test_what_comments_say_of_a_variable(editor: Editor, place: str, said: list[str]) -> None:
    found = await hover(editor, editor.open(REMARKS.replace(place.replace("$0", ""), place)))
    assert found is not None
    assert isinstance(found.contents, types.MarkupContent)
    parts = found.contents.value.split("\n\n")
    assert [part for part in parts[1:-1] if not part.startswith("Colour")] == said


async def test_a_structure_shows_what_was_said_of_it(editor: Editor) -> None:
    text = "VARIABLES { SURFACE s; }\ns = { COLOR < 1, 0.5, 0 > SPECULAR 0.25 }\nSOLID { SPHERE { } SURFACE $[s$] }\n"
    await check(editor, text, "SURFACE s = { COLOR < 1, 0.5, 0 > SPECULAR 0.25 }", "`#ff8000`")


async def test_a_transformation_is_shown_step_by_step(editor: Editor) -> None:
    text = "SOLID { SPHERE { TRANSFORM { TRANSX 1 $[TRANSX$] 2 TRANSX 4 } } TRANSFORM { TRANSY 8 } }\n"
    shown = await check(editor, text, "3  0  0  1", "3  8  0  1", "The origin goes to `< 3, 8, 0 >`")
    assert "7  0  0  1" not in shown


async def test_a_primitive_is_shown_where_it_is_in_the_scene(editor: Editor) -> None:
    text = "SOLID { $[SPHERE$] { CENTER < 1, 0, 0 > RADIUS 2 } TRANSFORM { SCALE < 2, 1, 1 > TRANSZ 5 } }\n"
    await check(
        editor, text, "In the scene", "centre `< 2, 0, 5 >`, radius `4`", "x `-2` to `6`, y `-4` to `4`, z `1` to `9`"
    )
    text = "SOLID { $[RECTANGLE$] { VERTEX1 < 0, 0, 2 > VERTEX2 < 0, 0, 0 > VERTEX3 < 0, 3, 0 > } }\n"
    await check(editor, text, "corners `< 0, 0, 2 >`, `< 0, 0, 0 >`, `< 0, 3, 0 >`", "normal `< 1, 0, 0 >`")


async def test_a_solid_light_and_view(editor: Editor) -> None:
    await check(editor, "$[SOLID$] { SPHERE { } SPHERE { CENTER < 3, 0, 0 > } }\n", "2 SPHERE", "x `-1` to `4`")
    await check(
        editor, "LIGHT { $[SOURCE$] { ZENITH 30 } }", "shines along `< -0.5, 0, -0.866025 >`", "60 degrees above"
    )
    await check(
        editor, "SCENE { $[VIEW$] { FROM < 9, 0, 0 > TO < 5, 0, 0 > } }", "`< -1, 0, 0 >`", "4 away", "320 x 200"
    )


async def test_numbers_have_names_and_units(editor: Editor) -> None:
    await check(editor, "SCENE { VIEW { REGION 0, 0, $[199$], 319 } }", "`REGION` *bottom*: **199** pixels")
    await check(
        editor, "SCENE { VIEW { FOV $[1.5$] } }", "*field of view*: **1.5** degrees (90 arcminutes)", "0.5 to 175"
    )
    await check(editor, "SOLID { SPHERE { CENTER < 1, $[-2$], 3 > } }", "`CENTER` *y*: **-2** scene units")
    mirage = "SCENE { VIEW { FROM < 0, 0, 1 > } MIRAGE { DISTANCE $[500$] PROFILE { 0 0 1 1 2 2 } } }\n"
    await check(editor, mirage, "**500** metres")


async def test_a_point_is_shown_in_the_scene_and_a_colour_as_it_looks(editor: Editor) -> None:
    text = "SOLID { SPHERE { CENTER $[< 1, 2, 3 >$] } TRANSFORM { TRANSX 5 } }\n"
    await check(editor, text, "In the scene: `< 6, 2, 3 >`")
    text = "VARIABLES { NUMBER half; }\nhalf = 0.5\nSOLID { SPHERE { } SURFACE { COLOR $[< 1, half, 0 >$] } }\n"
    await check(editor, text, "`#ff8000`", "data:image/svg+xml;base64,")


async def test_rows_of_tables(editor: Editor) -> None:
    tables = "VERTICES {{ 3 < 0, 0, 0 > < 1, 0, 0 > {} }} FACETS {{ 1 {} }}"
    mesh = f"SOLID {{{{ POLYGONS {{{{ {tables} TRANSFORM {{{{ TRANSZ 2 }}}} }}}} }}}}"
    await check(editor, mesh.format("< 0, $[1$], 0 >", "0 1 2"), "Vertex **2** of 3", "Moved to `< 0, 1, 2 >`")
    await check(editor, mesh.format("< 0, 1, 0 >", "0 $[1$] 2"), "Facet 1 of 1", "vertex 1: `< 1, 0, 0 >`")
    ranges = "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { COLORS { 0 0.5 < 0, 0, 0 > < $[1$], 1, 1 > } } } } }"
    await check(editor, ranges, "Range 1: from 0", "`#ffffff`")
    hill = "SOLID { TERRAIN { VERTICES { 2 2 < 0, 0, 0 > < 0, 1, 0 > < $[1$], 0, 0 > < 1, 1, 1 > } } }"
    await check(editor, hill, "Row 1, column 0 of the grid")


async def test_a_profile_shows_what_the_air_does_to_light(editor: Editor) -> None:
    text = "SCENE { VIEW { FROM < 0, 0, 1 > } MIRAGE { PROFILE { 0 15 $[100$] 15 200 14 300 44 } } }\n"
    shown = await check(editor, text, "15 °C at 100 m", "dT/dz = +0 K/m", "dT/dz = -0.01 K/m", "Below", "Above")
    # Isothermal air of 15 degrees bends a level ray by 226e-6 · 3.48e-3 p · 0.0341 / T², p and T those at 50 m.
    assert "κ = 3.255e-08 1/m" in shown
    assert "km, bent down" in shown


async def test_plain_text_for_a_client_without_markdown() -> None:
    from m3d_lsp.markdown import markup

    shown = markup(
        "```m3d\nCOLOR < 1, 0, 0 >\n```\n\n![c](data:x) `#ff0000` [line 1](file:///a) **bold**", markdown=False
    )
    assert shown.kind == types.MarkupKind.PlainText
    assert shown.value == "COLOR < 1, 0, 0 >\n\n#ff0000 line 1 bold"


async def test_nothing_to_say(editor: Editor) -> None:
    assert await hover(editor, editor.open("SOLID { /* SPH$0ERE */ SPHERE { } }")) is None
    assert await hover(editor, editor.open("SOLID { SPHERE { } }\n\n$0\n")) is None
