"""Code actions: what they make of a scene, and that they never make it worse."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from editor import Editor, Scene, apply
from lsprotocol import types
from marks import without_marks
from mutations import mutations

import m3dc
from m3dc.diagnostics.catalogue import CATALOGUE

pytestmark = pytest.mark.asyncio(loop_scope="session")

LIGHT = "LIGHT { SOURCE { FROM < 0, 0, 9 > } }\n"
DIAGNOSTICS = Path(__file__).parent.parent / "compiler/diagnostics"
BEGINNING = types.Range(types.Position(0, 0), types.Position(0, 0))
MOST_ROUNDS = 10
"""A fix may show what was hidden behind it, and that another fix."""


async def actions(
    editor: Editor, scene: Scene, range_: types.Range | None = None, only: str | None = None
) -> list[types.CodeAction]:
    if range_ is None:
        range_ = scene.range if "[" in scene.places else types.Range(scene.cursor, scene.cursor)
    context = types.CodeActionContext([], [only] if only else None)  # pyright: ignore[reportArgumentType]
    params = types.CodeActionParams(scene.identifier, range_, context)
    found = await editor.client.text_document_code_action_async(params) or ()
    return [action for action in found if isinstance(action, types.CodeAction)]


async def made(editor: Editor, scene: Scene, action: types.CodeAction) -> str:
    """The text after an action."""
    if action.edit is None:
        action = await editor.client.code_action_resolve_async(action)
    assert action.edit is not None
    assert action.edit.changes is not None
    assert list(action.edit.changes) == [scene.uri]
    return apply(scene.text, action.edit.changes[scene.uri])


async def check(editor: Editor, before: str, title: str, after: str) -> None:
    """What the action with a title makes of a scene, where the cursor is or what is selected."""
    scene = editor.open(before)
    found = {action.title: action for action in await actions(editor, scene)}
    assert title in found, list(found)
    assert await made(editor, scene, found[title]) == after


async def titles(editor: Editor, before: str) -> list[str]:
    return [action.title for action in await actions(editor, editor.open(before))]


async def test_the_fix_of_a_diagnostic(editor: Editor) -> None:
    before = "SOLID { SPHERE { RAD$0UIS 2 } }\n" + LIGHT
    scene = editor.open(before)
    (action,) = await actions(editor, scene)
    assert (action.title, action.kind, action.is_preferred) == (
        "Replace with RADIUS",
        types.CodeActionKind.QuickFix,
        True,
    )
    assert [diagnostic.code for diagnostic in action.diagnostics or ()] == ["M3D0106"]
    assert "RADIUS 2" in await made(editor, scene, action)
    assert await actions(editor, scene, only="refactor") == []
    assert len(await actions(editor, scene, only="quickfix")) == 1


async def test_all_fixes_of_a_file(editor: Editor) -> None:
    scene = editor.open("SCENE { SHADOWS 1 LOGSCALE 6 LOGSCALE  6 AMBIENT { INTENSITY .5 } }\nLIGHT { SOURSE { } }\n$0")
    assert await actions(editor, scene) == []
    (action,) = await actions(editor, scene, only="source.fixAll")
    expected = "SCENE { SHADOWS LOGSCALE  6 AMBIENT { INTENSITY 0.5 } }\nLIGHT { SOURCE { } }\n"
    assert await made(editor, scene, action) == expected
    scene = editor.replace(scene, expected)
    assert await actions(editor, scene, BEGINNING, only="source.fixAll") == []


@pytest.mark.parametrize(
    ("before", "title", "after"),
    [
        (
            "/* A ball. */\n\n/* It. */\nSOLID { SPHERE { RADIUS si$0ze } }\n",
            "Declare the NUMBER size, 1",
            "/* A ball. */\n\nVARIABLES { NUMBER size; }\n\nsize = 1\n/* It. */\nSOLID { SPHERE { RADIUS size } }\n",
        ),
        (
            "VARIABLES { NUMBER a; }\na = 1\nSOLID { SPHERE { RADIUS a CENTER pl$0ace } }\n",
            "Declare the VECTOR place, < 0, 0, 0 >",
            "VARIABLES { NUMBER a; VECTOR place; }\na = 1\nplace = < 0, 0, 0 >\n"
            "SOLID { SPHERE { RADIUS a CENTER place } }\n",
        ),
        (
            "VARIABLES\n{\n  SPHERE a;\n}\na = { CENTER < x$0, 0, 0 > }\n",
            "Declare the NUMBER x, 0",
            "VARIABLES\n{\n  SPHERE a;\n  NUMBER x;\n}\nx = 0\na = { CENTER < x, 0, 0 > }\n",
        ),
        (
            "VARIABLES { SPHERE a; }\nSOLID { SPHERE b$0all }\n",
            "Declare the SPHERE ball",
            "VARIABLES { SPHERE a, ball; }\nSOLID { SPHERE ball }\n",
        ),
        (
            "skin$0 = { COLOR < 1, 0, 0 > ROUGH 1 }\n",
            "Declare the SURFACE skin",
            "VARIABLES { SURFACE skin; }\n\nskin = { COLOR < 1, 0, 0 > ROUGH 1 }\n",
        ),
        (
            "VARIABLES { }\nSCENE { MIRAGE { PROFILE { 0 t$0 5 1 9 2 } } }\n",
            "Declare the NUMBER t, 0",
            "VARIABLES { NUMBER t; }\nt = 0\nSCENE { MIRAGE { PROFILE { 0 t 5 1 9 2 } } }\n",
        ),
    ],
)
async def test_declaring_a_variable(editor: Editor, before: str, title: str, after: str) -> None:
    await check(editor, before, title, after)


async def test_what_is_declared_too_late_is_not_declared_twice(editor: Editor) -> None:
    assert await titles(editor, "SOLID { SPHERE { RADIUS a$0 } }\nVARIABLES { NUMBER a; }\n") == []


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("VARIABLES { NUMBER $0a; }\na = 5\n", ""),
        ("VARIABLES { NUMBER $0a, b; }\na = 5\nb = 1\n", "VARIABLES { NUMBER b; }\nb = 1\n"),
        ("VARIABLES { NUMBER b, $0a; }\n", "VARIABLES { NUMBER b; }\n"),
        ("VARIABLES\n{\n  NUMBER $0a;\n  VECTOR b;\n}\n", "VARIABLES\n{\n  VECTOR b;\n}\n"),
    ],
)
async def test_removing_an_unused_variable(editor: Editor, before: str, after: str) -> None:
    solid = "SOLID { PLANE { } }\n" + LIGHT
    await check(editor, before + solid, "Remove the unused variable a", after + solid)


TRIANGLE = "VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> }"


async def test_counts(editor: Editor) -> None:
    mesh = "SOLID {{ POLYGONS {{ VERTICES {{ {} <0,0,0> <1,0,0> <0,1,0> $0<1,1,1> }} FACETS {{ 1 0 1 2 }} }} }}\n"
    await check(editor, mesh.format(3), "Write that there are 4 VERTICES", mesh.format(4).replace("$0", ""))
    for place in ("VERTICES { $03", "VER$0TICES { 3"):
        before = mesh.format(3).replace("$0", "").replace(place.replace("$0", ""), place)
        await check(editor, before, "Write that there are 4 VERTICES", mesh.format(4).replace("$0", ""))
    # The rows that were not read name a vertex that is not there.
    scene = f"SOLID {{ POLYGONS {{ {TRIANGLE} FACETS {{ 1 0 1 2 $07 8 9 7 8 9 }} }} }}\n"
    assert await titles(editor, scene) == []


@pytest.mark.parametrize(
    ("before", "title", "after"),
    [
        ("SPH$0ERE { RADIUS 2 }\n", "Put this into a SOLID", "SOLID { SPHERE { RADIUS 2 } }\n"),
        (
            "SCENE { SKY { } } SPHERE { RADIUS 2 } SUR$0FACE { COLOR < 1, 0, 0 > }\n",
            "Put these 2 into a SOLID",
            "SCENE { SKY { } } SOLID { SPHERE { RADIUS 2 } SURFACE { COLOR < 1, 0, 0 > } }\n",
        ),
        (
            "$0SPHERE\n{\n    RADIUS 2\n\n}\nPLANE { }\nLIGHT { }\n",
            "Put these 2 into a SOLID",
            "SOLID\n{\n    SPHERE\n    {\n        RADIUS 2\n\n    }\n    PLANE { }\n}\nLIGHT { }\n",
        ),
        ("SO$0URCE { FROM < 0, 0, 9 > }\n", "Put this into a LIGHT", "LIGHT { SOURCE { FROM < 0, 0, 9 > } }\n"),
        ("VI$0EW { FOV 5 }\nLIGHT { }\n", "Put this into a SCENE", "SCENE { VIEW { FOV 5 } }\nLIGHT { }\n"),
        (
            "$0SOLID { SPHERE { } }\n",
            "Add a LIGHT",
            "SOLID { SPHERE { } }\n\nLIGHT { SOURCE { INFINITE AZIMUTH 70 ZENITH 50 } }\n",
        ),
        ("SCENE { SKY { SUN { AZIMUTH $0270 } } }\n", "Write -90", "SCENE { SKY { SUN { AZIMUTH -90 } } }\n"),
        (
            "LIGHT { SOURCE { AZIMUTH -190.1$0 } }\n",
            "Write 169.9",
            "LIGHT { SOURCE { AZIMUTH 169.9 } }\n",
        ),
    ],
)
async def test_what_is_missing_or_misplaced(editor: Editor, before: str, title: str, after: str) -> None:
    await check(editor, before, title, after)
    errors = [d for d in m3dc.compile(after).diagnostics if d.severity == "error"]
    assert not errors
    assert title not in await titles(editor, after[:1] + "$0" + after[1:])


async def test_a_second_scene_is_not_made(editor: Editor) -> None:
    assert await titles(editor, "SCENE { }\nVI$0EW { FOV 5 }\n") == []


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("9 1 2 3 $05 2", "2 3 5 2 9 1"),
        ("$0\n 0 1 /* low */\n\n 9 3\n 5 2 /* middle */\n", "\n 0 1 /* low */\n\n 5 2 /* middle */\n 9 3\n"),
    ],
)
async def test_sorting_a_profile(editor: Editor, before: str, after: str) -> None:
    scene = "SCENE {{ MIRAGE {{ PROFILE {{ {} }} }} }}\n"
    await check(editor, scene.format(before), "Sort the points from low to high", scene.format(after))


async def test_a_sorted_profile_stays(editor: Editor) -> None:
    assert await titles(editor, "SCENE { SKY { } MIRAGE { PROFILE { 0 1 5 $02 9 3 } } }\n") == []


@pytest.mark.parametrize(
    ("before", "title", "after"),
    [
        ("SOLID { $0SPHERE { } }\n", "Allow M3D0513 here", "SOLID { SPHERE { } } /* m3d: allow M3D0513 */\n"),
        ("SOLID { $0SPHERE { } }\n", "Allow M3D0513 in this file", "/* m3d: allow M3D0513 */\nSOLID { SPHERE { } }\n"),
        (
            "/* m3d: allow M3D0503 */\nSOLID { $0SPHERE { } }\n",
            "Allow M3D0513 in this file",
            "/* m3d: allow M3D0503, M3D0513 */\nSOLID { SPHERE { } }\n",
        ),
        (
            "SCENE { }\nSOLID { $0SPHERE { RADIUS 1 RADIUS 2 } } /* m3d: allow M3D0512 */\n",
            "Allow M3D0513 here",
            "SCENE { }\nSOLID { SPHERE { RADIUS 1 RADIUS 2 } } /* m3d: allow M3D0512, M3D0513 */\n",
        ),
        (
            "SCENE { }\n  SOLID { $0SPHERE { } } /* of\n two lines */\n",
            "Allow M3D0513 here",
            "SCENE { }\n/* m3d: allow M3D0513 */\n  SOLID { SPHERE { } } /* of\n two lines */\n",
        ),
    ],
)
async def test_allowing_a_warning(editor: Editor, before: str, title: str, after: str) -> None:
    await check(editor, before, title, after)
    assert m3dc.compile(after).diagnostics == ()


BALL = "VARIABLES { SPHERE ball; }\nball = { RADIUS 2 }\n"


@pytest.mark.parametrize(
    ("before", "title", "after"),
    [
        (
            "/* Red. */\nSOLID { PLANE { } }\n\n/* A ball. */\nSOLID\n{\n    SPHERE { }\n    SUR$0FACE\n    {\n"
            "        COLOR < 1, 0, 0 >\n    }\n}\n",
            "Extract to the SURFACE surface",
            "/* Red. */\nVARIABLES { SURFACE surface; }\n\nSOLID { PLANE { } }\n\n"
            "surface =\n{\n    COLOR < 1, 0, 0 >\n}\n/* A ball. */\nSOLID\n{\n    SPHERE { }\n    SURFACE surface\n}\n",
        ),
        (
            BALL + "SOLID { $[SPHERE ball { CENTER < 1, 2, 3 > }$] }\n",
            "Extract to the SPHERE sphere",
            "VARIABLES { SPHERE ball, sphere; }\nball = { RADIUS 2 }\nsphere = ball { CENTER < 1, 2, 3 > }\n"
            "SOLID { SPHERE sphere }\n",
        ),
        (
            "SO$0LID { PLANE { } }\n",
            "Extract to the SOLID solid",
            "VARIABLES { SOLID solid; }\n\nsolid = { PLANE { } }\nSOLID solid\n",
        ),
        (
            "VARIABLES { NUMBER radius; }\nSOLID { SPHERE { RADIUS $02.5 } }\n",
            "Extract to the NUMBER radius_2",
            "VARIABLES { NUMBER radius, radius_2; }\nradius_2 = 2.5\nSOLID { SPHERE { RADIUS radius_2 } }\n",
        ),
        (
            "SOLID { SPHERE { CENTER $0< 1, 2, 3 > } }\n",
            "Extract to the VECTOR center",
            "VARIABLES { VECTOR center; }\n\ncenter = < 1, 2, 3 >\nSOLID { SPHERE { CENTER center } }\n",
        ),
    ],
)
async def test_extracting(editor: Editor, before: str, title: str, after: str) -> None:
    await check(editor, before, title, after)


@pytest.mark.parametrize(
    "before",
    [
        "SOLID { SPHERE { } SURFACE { ROUGH 1 } SURF$0ACE { COLOR < 1, 0, 0 > } }\n",  # changes the surface before it
        "VARIABLES { SOLID a; }\na = { SURFACE { ROUGH 1 } }\nSOLID a { SURF$0ACE { HARD 1 } }\n",
        "VARIABLES { SOLID a; }\na = { SPHERE { } }\na = { SURF$0ACE { HARD 1 } }\n",
        "SOLID { SPHERE { TRANSFORM { TRANSX 1 } TRAN$0SFORM { ROTX 1 } } }\n",
        "SCE$0NE { SHADOWS }\n",
    ],
)
async def test_what_would_not_be_the_same_is_not_extracted(editor: Editor, before: str) -> None:
    assert not any(title.startswith("Extract") for title in await titles(editor, before))


@pytest.mark.parametrize(
    ("before", "title", "after"),
    [
        (
            "VARIABLES { NUMBER a; }\na = -1.5\na = 2\nSOLID { SPHERE { RADIUS $0a } }\n",
            "Inline a here",
            "VARIABLES { NUMBER a; }\na = -1.5\na = 2\nSOLID { SPHERE { RADIUS 2 } }\n",
        ),
        (
            BALL + "SOLID { SPHERE ba$0ll { CENTER < 1, 2, 3 > } }\n",
            "Inline ball here",
            BALL + "SOLID { SPHERE { RADIUS 2 CENTER < 1, 2, 3 > } }\n",
        ),
        (
            "VARIABLES { NUMBER $0a, b; }\na = 2\nb = a\nSOLID { SPHERE { RADIUS a CENTER < a, b, 0 > } }\n",
            "Inline a everywhere",
            "VARIABLES { NUMBER b; }\nb = 2\nSOLID { SPHERE { RADIUS 2 CENTER < 2, b, 0 > } }\n",
        ),
        (
            "VARIABLES { SPHERE ball, big; }\nball = { RADIUS 2 }\nbig = ball { CENTER < 1, 0, 0 > }\n"
            "SOLID { SPHERE ba$0ll SPHERE big }\n",
            "Inline ball everywhere",
            "VARIABLES { SPHERE big; }\nbig = { RADIUS 2 CENTER < 1, 0, 0 > }\n"
            "SOLID { SPHERE { RADIUS 2 } SPHERE big }\n",
        ),
    ],
)
async def test_inlining(editor: Editor, before: str, title: str, after: str) -> None:
    await check(editor, before, title, after)


@pytest.mark.parametrize(
    "before",
    [
        "VARIABLES { NUMBER a, b; }\na = 1\nb = a\na = 2\nSOLID { SPHERE { RADIUS $0b } }\n",  # a is another there
        "VARIABLES { SPHERE a; }\na = { RADIUS 2 }\na = { CENTER < 1, 1, 1 > }\nSOLID { SPHERE a$0 }\n",  # it is both
        "VARIABLES { SURFACE a; }\na = { ROUGH 1 }\nSOLID { SPHERE { } SURFACE { HARD 1 } SURFACE $0a }\n",
        "VARIABLES { NUMBER a; }\nSOLID { SPHERE { RADIUS $0a } }\n",
    ],
)
async def test_what_would_not_be_the_same_is_not_inlined(editor: Editor, before: str) -> None:
    assert not any(title.startswith("Inline") for title in await titles(editor, before))


ROOF = """\
SOLID
{
    POLYGONS
    {
        VERTICES { 4 < 0, 0, 0 > < 2, 0, 0 > < 0, 3, 0 > < 2, 3, 0.5 > }
        FAC$0ETS { 2 0 1 2 /* left */ 1 3 2 }
    }
}
"""


async def test_normals_are_computed_for_a_phong_without_effect(editor: Editor) -> None:
    scene = editor.open(f"{LIGHT}SOLID {{ POLYGONS {{ PH$0ONG {TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}\n")
    (action,) = [each for each in await actions(editor, scene) if "normals" in each.title]
    corners = "< 0, 0, 1 > < 0, 0, 1 > < 0, 0, 1 >"
    assert f"PHONG {TRIANGLE} SFACETS {{ 1 0 1 2 {corners} }}" in await made(editor, scene, action)


async def test_normals_are_computed(editor: Editor) -> None:
    scene = editor.open(ROOF)
    (action,) = [each for each in await actions(editor, scene) if "normals" in each.title]
    text = await made(editor, scene, action)
    # The facets' cross products are (0, 0, 6) and (-1.5, -1, 6); in the middle counts their sum.
    left, middle, right = "< 0, 0, 1 >", "< -0.1236, -0.0824, 0.9889 >", "< -0.2394, -0.1596, 0.9577 >"
    assert text == ROOF.replace(
        "FAC$0ETS { 2 0 1 2 /* left */ 1 3 2 }",
        f"PHONG\n        SFACETS {{ 2 0 1 2 {left} {middle} {middle} /* left */ 1 3 2 {middle} {right} {middle} }}",
    )
    assert m3dc.compile(text + LIGHT).diagnostics == ()


async def test_sharp_edges_stay_sharp_and_rows_get_a_line_each(editor: Editor) -> None:
    scene = editor.open(
        f"SOLID {{ POLYGONS {{ PHONG\n  VERTICES {{ 4 <0,0,0> <1,0,0> <0,1,0> <0,0,1> }}\n"
        f"  FACETS$0 {{ 2 0 1 2 0 3 1 }} }} }}\n{LIGHT}"
    )
    (action,) = [each for each in await actions(editor, scene) if "normals" in each.title]
    text = await made(editor, scene, action)
    up, aside = "< 0, 0, 1 >", "< 0, 1, 0 >"
    assert (
        f"PHONG\n  VERTICES {{ 4 <0,0,0> <1,0,0> <0,1,0> <0,0,1> }}\n"
        f"  SFACETS {{ 2 0 1 2 {up} {up} {up}\n      0 3 1 {aside} {aside} {aside} }} }} }}\n"
    ) in text
    assert m3dc.compile(text).diagnostics == ()


async def test_an_action_chosen_after_an_edit_changes_nothing(editor: Editor) -> None:
    scene = editor.open(ROOF)
    (action,) = [each for each in await actions(editor, scene) if "normals" in each.title]
    editor.change(scene, types.TextDocumentContentChangeWholeDocument("\n" + scene.text))
    assert (await editor.client.code_action_resolve_async(action)).edit is None


def errors(text: str) -> int:
    return sum(diagnostic.severity == "error" for diagnostic in m3dc.compile(text).diagnostics)


SCENES = {path.stem: path.read_text(encoding="utf-8") for path in sorted(DIAGNOSTICS.glob("*.m3d"))}


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
async def test_no_action_adds_an_error(editor: Editor, name: str) -> None:
    """Every action at every diagnostic of the scenes that show them, and all fixes at once."""
    scene = editor.open(without_marks(SCENES[name]))
    before = errors(scene.text)
    places = [diagnostic.range for diagnostic in await editor.diagnostics(scene)]
    found = await actions(editor, scene, places[0], only="source.fixAll")
    for place in places:
        found += await actions(editor, scene, place)
    tried: set[str] = set()
    for action in found:
        text = await made(editor, scene, action)
        assert errors(text) <= before, (action.title, text)
        if action.kind == types.CodeActionKind.QuickFix and text not in tried:
            gone = {diagnostic.message for diagnostic in action.diagnostics or ()}
            left = [d.message for d in m3dc.compile(text).diagnostics]
            was = [d.message for d in m3dc.compile(scene.text).diagnostics]
            assert any(left.count(message) < was.count(message) for message in gone), (action.title, text)
        tried.add(text)


@pytest.mark.parametrize("code", [code for code in CATALOGUE if len(CATALOGUE[code].wrong) < 2000])
async def test_no_action_adds_an_error_to_the_example_of_a_diagnostic(editor: Editor, code: str) -> None:
    scene = editor.open(CATALOGUE[code].wrong)
    before = errors(scene.text)
    for diagnostic in await editor.diagnostics(scene):
        for action in await actions(editor, scene, diagnostic.range):
            text = await made(editor, scene, action)
            assert errors(text) <= before, (action.title, text)


UNCERTAIN = (
    "SCENE { DEPTH 0 SKY { OVERCAST$0 2 } }\n",  # the limit is what is used, not what was meant
    "SOLID { SPHERE { } SURFACE { COLOR$0 < 128, 64, 32 > } }\n",
    "SOLID { SPHERE { RADIUS$0 2 RADIUS 3 } }\n",
    "SOLID { SPHERE { } translate$0 <1,0,0> }\n",
    "SOLID { SPHERE { CENTER < 1, eye+$02, 3 > } }\n",
    "SCENE { SHADOWS 0$0 }\n",
    "VARIABLES { NUMBER size; }\nsize = 2\nSOLID { SPHERE { RADIUS sizes$0 } }\n",
    "VARIABLES { NUMBER unused$0; }\nSCENE { }\n",
    "SCENE { MIRAGE { PROFILE$0 { 15 0 14 5 13 20 } } }\n",  # perhaps the columns are swapped
    "SOLID { SPHERE { RADIUS 1 }$0",
    "SOLID { SPHERE { } } }$0\n",
)


@pytest.mark.parametrize("before", UNCERTAIN)
async def test_what_is_not_certain_is_offered_and_never_done_unasked(editor: Editor, before: str) -> None:
    scene = editor.open(before)
    assert not any(action.is_preferred for action in await actions(editor, scene))
    assert await actions(editor, scene, only="source.fixAll") == []


@pytest.mark.parametrize("name", ["wheel", "two-balls", "cylinder-and-cone"])
async def test_fix_all_adds_no_error_and_comes_to_an_end(editor: Editor, name: str, examples: Path) -> None:
    """In examples of which one token was deleted, doubled or swapped."""
    text = (examples / f"{name}.m3d").read_text(encoding="utf-8")
    scene = editor.open("")
    for mutation in mutations(text, random.Random(name), 40):
        scene = editor.replace(scene, mutation.text)
        for _ in range(MOST_ROUNDS):
            found = await actions(editor, scene, BEGINNING, only="source.fixAll")
            if not found:
                break
            after = await made(editor, scene, found[0])
            assert errors(after) <= errors(scene.text), (mutation.what, after)
            if not errors(scene.text):
                assert spread(m3dc.compile(after).ir) == spread(m3dc.compile(scene.text).ir), mutation.what
            scene = editor.replace(scene, after)
        else:
            pytest.fail(f"no end: {mutation.what}")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["wheel", "two-balls", "terrain", "cylinder-and-cone"])
async def test_a_change_of_form_leaves_the_scene_as_it_is(editor: Editor, name: str, examples: Path) -> None:
    """Every refactoring at the beginning of every word of an example."""
    text = (examples / f"{name}.m3d").read_text(encoding="utf-8")
    scene = editor.open(text)
    meaning = m3dc.compile(text).ir
    lines = text.split("\n")
    tried: set[tuple[str, str]] = set()
    for number, line in enumerate(lines):
        starts = [i for i, c in enumerate(line) if c.isalnum() and (i == 0 or line[i - 1] in " <")]
        for start in starts:
            place = types.Position(number, start)
            for action in await actions(editor, scene, types.Range(place, place), only="refactor"):
                out = await made(editor, scene, action)
                if (action.title, out) in tried or "normals" in action.title:
                    continue
                tried.add((action.title, out))
                again = m3dc.compile(out)
                assert again.ok, (action.title, again.diagnostics)
                assert spread(again.ir) == spread(meaning), (action.title, out)
    assert tried


def spread(ir: m3dc.SceneIR) -> list[tuple[str, str, str]]:
    """All values in an IR, but for where they were written."""
    return [
        (table, column, repr(values.tolist()))
        for table, columns in ir.tables.items()
        for column, values in columns.items()
        if column not in ("span", "offset")
    ]
