"""What is proposed at the cursor: what may stand there, and no more."""

from __future__ import annotations

import re

import pytest
from conftest import REPOSITORY
from editor import Editor, Scene
from lsprotocol import types

import m3dc
from m3d_language import blank_comments
from m3d_language.formal import first_error
from m3d_language.table import LANGUAGE
from m3d_lsp import snippets

pytestmark = pytest.mark.asyncio(loop_scope="session")

HEAD = """\
VARIABLES { NUMBER little, big; VECTOR sand; SPHERE ball; SURFACE shiny; }
little = 0.5
sand = < 0.8, 0.7, 0.5 >
"""


SPHERE = LANGUAGE.blocks["SPHERE"]
RADIUS = SPHERE.statements["RADIUS"]


async def complete(editor: Editor, scene: Scene, typed: str | None = None) -> list[types.CompletionItem]:
    context = None
    if typed is not None:
        context = types.CompletionContext(types.CompletionTriggerKind.TriggerCharacter, typed)
    params = types.CompletionParams(scene.identifier, scene.cursor, context=context)
    answer = await editor.client.text_document_completion_async(params)
    assert isinstance(answer, types.CompletionList)
    return list(answer.items)


async def check(editor: Editor, marked: str, *labels: str) -> None:
    """Just these are proposed at the cursor, after HEAD."""
    items = await complete(editor, editor.open(HEAD + marked))
    assert sorted(item.label for item in items) == sorted(labels)


def filled_in(item: types.CompletionItem, scene: Scene) -> str:
    """The text of a scene with a proposal taken, the values in it as they are proposed."""
    edit = item.text_edit
    assert isinstance(edit, types.InsertReplaceEdit)
    lines = scene.text.splitlines(keepends=True)
    start, end = (sum(map(len, lines[: p.line])) + p.character for p in (edit.replace.start, edit.replace.end))
    return scene.text[:start] + default(edit.new_text) + scene.text[end:]


def default(snippet: str) -> str:
    """What a snippet is when its values are left as they are."""
    return re.sub(r"\$\{\d+[:|]([^},]*)[^}]*\}|\$\d", r"\1", snippet)


async def test_members_of_a_block(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE { $0 } }", "CENTER", "RADIUS", "TRANSFORM")
    await check(editor, "SOLID { SPHERE { RADIUS 1 $0 } }", "CENTER", "RADIUS", "TRANSFORM")
    await check(editor, "SCENE { SKY { SUN { } $0 } }", *LANGUAGE.blocks["SKY"].members())
    await check(editor, "SOLID { SPHERE { } SURFACE { TEXTURE { $0 } } }", *LANGUAGE.blocks["TEXTURE"].holds)


async def test_what_is_assigned_depends_on_the_type(editor: Editor) -> None:
    await check(editor, "ball = { $0 }", "CENTER", "RADIUS", "TRANSFORM")
    await check(editor, "ball = $0", "{ ... }")
    await check(editor, "sand = $0", "< x, y, z >")
    await check(editor, "big = $0", "little")


async def test_top_level(editor: Editor) -> None:
    await check(editor, "$0", "SCENE", "SOLID", "LIGHT", "little", "big", "sand", "ball", "shiny")
    await check(
        editor, "SOLID { SPHERE { } }\nSCENE { }\n$0", "SOLID", "LIGHT", "little", "big", "sand", "ball", "shiny"
    )


async def test_declarations(editor: Editor) -> None:
    items = await complete(editor, editor.open("VARIABLES { $0 }"))
    assert {item.label for item in items} == set(LANGUAGE.types)
    assert await complete(editor, editor.open("VARIABLES { NUMBER $0 }")) == []


async def test_variables_of_the_type_that_is_wanted(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE $0", "ball", "{ ... }")
    await check(editor, "SOLID { SPHERE { CENTER < 1, $0", "little", "big")
    await check(editor, "SOLID { SPHERE { RADIUS $0", "little", "big", "1")
    await check(editor, "SOLID { POLYGONS { VERTICES { 3 $0", "sand", "< x, y, z >")
    await check(editor, "SCENE { VIEW { REGION 0, $0", "little", "big")


async def test_values_that_are_often_wanted(editor: Editor) -> None:
    scene = editor.open("SOLID { SPHERE { } SURFACE { COLOR whi$0te } }")
    (white,) = [item for item in await complete(editor, scene) if item.label == "white"]
    assert white.kind == types.CompletionItemKind.Color
    assert "COLOR < 1, 1, 1 > }" in filled_in(white, scene)
    await check(editor, "SOLID { SPHERE { } SURFACE { REFINDEX $0", "1.33", "1.5", "2.42", "1", "little", "big")


async def test_half_typed_text(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE { RAD$0", "CENTER", "RADIUS", "TRANSFORM")
    await check(editor, "SOLID { SPHERE { RADIUS } SPHERE { RADIUS CENTER < 1 $0T }\n\nLIGHT { SOURCE { } }")
    await check(editor, "SOLID { BALL { } SPHERE { $0 RADIUS } }", "CENTER", "RADIUS", "TRANSFORM")
    await check(editor, "SOLID { SPHERE { \nSOLID { SPHERE { $0", "CENTER", "RADIUS", "TRANSFORM")


async def proposal(editor: Editor, marked: str, label: str) -> tuple[types.CompletionItem, Scene]:
    scene = editor.open(HEAD + marked)
    (item,) = [item for item in await complete(editor, scene) if item.label == label]
    return item, scene


@pytest.mark.parametrize(
    ("text", "word", "after"),
    [
        ("SOLID { SPH$0 { RADIUS 1 } }", "SPHERE", "SOLID { SPHERE { RADIUS 1 } }"),
        ("SOLID { SP$0 ball }", "SPHERE", "SOLID { SPHERE ball }"),
        ("SOLID { SPHERE { RA$0 2 } }", "RADIUS", "SOLID { SPHERE { RADIUS 2 } }"),
        ("SOLID { SPHERE { CEN$0TER < 0, 0, 1 > } }", "CENTER", "SOLID { SPHERE { CENTER < 0, 0, 1 > } }"),
        ("SOLID { SPHERE { $0 /* how big */ .5 } }", "RADIUS", "SOLID { SPHERE { RADIUS /* how big */ .5 } }"),
        ("SOL$0\n{\n  SPHERE { }\n}", "SOLID", "SOLID\n{\n  SPHERE { }\n}"),
        ("lit$0 = 2", "little", "little = 2"),
        ("sa$0nd\n = 2", "sand", "sand\n = 2"),
        ("SCENE { MIRAGE { PRO$0 { 0 1 5 2 } } }", "PROFILE", "SCENE { MIRAGE { PROFILE { 0 1 5 2 } } }"),
        (
            "SOLID { SPHERE { RA$0\nCENTER < 0, 0, 1 > } }",
            "RADIUS",
            "SOLID { SPHERE { {RADIUS}\nCENTER < 0, 0, 1 > } }",
        ),
        ("ball = { RA$0 }\nlittle = 2", "RADIUS", "ball = { {RADIUS} }\nlittle = 2"),
        ("lit$0\nlittle = 2", "little", "little = \nlittle = 2"),
    ],
)
async def test_what_is_there_is_not_written_again(editor: Editor, text: str, word: str, after: str) -> None:
    item, scene = await proposal(editor, text, word)
    assert filled_in(item, scene) == HEAD + after.replace("{RADIUS}", default(snippets.statement(RADIUS, SPHERE)))


async def test_no_vector_is_put_before_one(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE { } SURFACE { COLOR $0< 1, 0, 0 > } }", "sand")
    await check(editor, "sand = $0< 1, 0, 0 >")


async def test_what_may_not_be_there_twice_comes_last(editor: Editor) -> None:
    async def order(marked: str) -> list[str]:
        items = await complete(editor, editor.open(HEAD + marked))
        return [item.label for item in sorted(items, key=lambda item: item.sort_text or item.label)]

    assert await order("SOLID { SPHERE { RADIUS 1 $0 } }") == ["CENTER", "TRANSFORM", "RADIUS"]
    assert await order("SOLID { SPHERE { RA$0 /* CENTER */ CENTER < 0, 0, 1 > TRANSFORM { } } }") == [
        "RADIUS",
        "TRANSFORM",
        "CENTER",
    ]
    assert (await order("SOLID { SURFACE { COLOR sand } SPHERE { } $0 }"))[-1] == "SURFACE"
    assert (await order("SOLID { SPHERE { } $0 }"))[0] == "SPHERE"
    # What other blocks hold, and what is left open, does not count.
    assert (await order("SOLID { SURFACE { COLOR sand } SPHERE { $0\nSOLID { SPHERE { RADIUS 1 } }"))[:2] == [
        "CENTER",
        "RADIUS",
    ]
    transform = "SOLID { SPHERE { TRANSFORM { TRANSX 1 $0 } } }"
    assert (await order(transform)) == (await order(transform.replace("TRANSX 1", "")))


@pytest.mark.parametrize(
    ("text", "after"),
    [
        ("SOLID $0", None),
        ("SOLID { SPHERE $0 }", f"SOLID {{ {default(snippets.of_block(SPHERE))} }}"),
        ("SOLID { SPHERE ball $0 }", "SOLID { SPHERE ball {  } }"),
        ("SCENE { MIRAGE { PROFILE $0 } }", None),
        ("VARIABLES $0", None),
    ],
)
async def test_braces_after_the_keyword_of_a_block(editor: Editor, text: str, after: str | None) -> None:
    scene = editor.open(("" if text.startswith("V") else HEAD) + text)
    asked = await complete(editor, scene, " ")
    assert ("{ ... }" in [item.label for item in asked]) == ("ball" not in text)
    (braces,) = [item for item in await complete(editor, scene) if item.label == "{ ... }"]
    assert first_error(filled_in(braces, scene)) is None
    if after is not None:
        assert filled_in(braces, scene) == HEAD + after


async def test_no_braces_before_braces(editor: Editor) -> None:
    await check(editor, "SOLID { SPHERE $0 { } }", "ball")
    await check(editor, "SOLID { SPHERE ball $0 { } }", *LANGUAGE.blocks["SOLID"].members())


@pytest.mark.parametrize("name", ["two-balls", "wheel", "runway", "cylinder-and-cone", "merman"])
async def test_after_half_of_every_word(editor: Editor, name: str) -> None:
    """Wherever a word of a scene is half typed, with or without what follows it, the whole word is proposed; names that
    are being declared are the author's own."""
    whole = (REPOSITORY / f"examples/{name}.m3d").read_text(encoding="utf-8")
    variables = blank_comments(whole).index("}")
    declared, text = whole[:variables], whole[variables:]
    if "VARIABLES" not in declared:
        declared, text = "", whole
    words = list(re.finditer(r"(?<![\w.+-])[A-Za-z]\w*", blank_comments(text)))
    for number, word in enumerate(words[:: max(1, len(words) // 40)]):
        half = word.start() + (len(word[0]) + 1) // 2
        rest = text[word.end() :] if number % 2 else ""
        items = await complete(editor, editor.open(declared + text[:half] + "$0" + rest))
        assert word[0] in {item.label for item in items}, text[max(half - 80, 0) : half]


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("// x\nSOL$0", "SOLID"),
        ("#declare x = 1;\nSOLID { SPH$0", "SPHERE"),
        ("solid { sph$0", "SPHERE"),
        ("solid {\n  sphere {\n    rad$0", "RADIUS"),
        ("SOLID { SPHERE { radius 2 } SUR$0", "SURFACE"),
        ("SOLID { SPHERE { COLOR < 1, 0, 0 > RAD$0", "RADIUS"),
        ("SOLID { SPHERE { RADIUS = 2 CEN$0", "CENTER"),
        ("SOLID { SPHERE { RADIUS: 2 CEN$0", "CENTER"),
        ("SOLID { SPHERE { RADIUS 2; CEN$0", "CENTER"),
        ("SOLID { SPHERE { RADIUS 2*3 CEN$0", "CENTER"),
        ("SOLID { SPHERE { RADIUS 1. CEN$0", "CENTER"),
        ("SOLID { SPHERE { RADIUS CEN$0", "CENTER"),
        ("SOLID { SPHERE { CENTER < 1 2 3 > RAD$0", "RADIUS"),
        ("SOLID { SPHERE { CENTER 1, 2, 3 RAD$0", "RADIUS"),
        ("SCENE { VIEW { FROM (1, 2, 3) FO$0", "FOV"),
        ("SCENE { MIRAGE { PROFILE { 0 10, 1 11 } ELE$0", "ELEVATION"),
        ("SOLID { SPHERE { RADIUS { 5 } CEN$0", "CENTER"),
        ("SOLID { SPHERE { } } } SOL$0", "SOLID"),
        ("VARIABLES { NUMBER x = 1; VEC$0", "VECTOR"),
        ("VARIABLES { NUMBER x VEC$0", "VECTOR"),
        ("little = 2;\nSOL$0", "SOLID"),
        ("little 2\nSOL$0", "SOLID"),
    ],
)
async def test_half_a_word_behind_a_mistake(editor: Editor, text: str, word: str) -> None:
    assert word in {item.label for item in await complete(editor, editor.open(text))}


async def test_nothing_where_nothing_is_wanted(editor: Editor) -> None:
    await check(editor, "/* SOLID { $0 */")
    await check(editor, "SOLID { SPHERE { RADIUS 1$0 } }")
    assert await complete(editor, editor.open("SOLID { SPHERE { RADIUS 1 $0 } }"), " ") == []
    assert await complete(editor, editor.open("SOLID { SPHERE { RADIUS $0 } }"), " ")


async def test_a_taken_proposal_is_a_sentence(editor: Editor) -> None:
    for text in (
        "$0",
        "SOLID { $0 }",
        "SCENE { $0 }",
        "SOLID { SPHERE { } SURFACE { TEXTURE { $0 } } }",
        "ball = { $0 }",
    ):
        scene = editor.open(HEAD + text)
        for item in await complete(editor, scene):
            if item.kind not in (types.CompletionItemKind.Constant, types.CompletionItemKind.Variable):
                assert first_error(filled_in(item, scene)) is None, item.label


async def test_a_variable_shows_what_comments_say_of_it(editor: Editor) -> None:
    text = "VARIABLES { NUMBER size; /* in metres */ NUMBER far; }\nfar = 2 /* away */\nSOLID { SPHERE { RADIUS $0 } }"
    items = {item.label: item for item in await complete(editor, editor.open(text))}
    said = {name: items[name].documentation for name in ("size", "far")}
    assert {name: each.value for name, each in said.items() if isinstance(each, types.MarkupContent)} == {
        "size": "in metres",
        "far": "away",
    }


async def test_a_proposal_says_what_it_is(editor: Editor) -> None:
    items = {
        item.label: item for item in await complete(editor, editor.open(HEAD + "SOLID { SPHERE { $0 RADIUS sand } }"))
    }
    assert items["RADIUS"].detail == "RADIUS radius"
    assert isinstance(items["RADIUS"].documentation, types.MarkupContent)
    assert "Under a scaling transform" in items["RADIUS"].documentation.value
    items = {item.label: item for item in await complete(editor, editor.open(HEAD + "sand = < little, $0"))}
    assert items["little"].detail == "NUMBER = 0.5"


@pytest.mark.parametrize("keyword", LANGUAGE.blocks)
async def test_the_snippet_of_every_block_compiles(keyword: str) -> None:
    text = re.sub(r"\$\{\d+:([^}]*)\}|\$\d", r"\1", snippets.of_block(LANGUAGE.blocks[keyword]))
    while keyword not in LANGUAGE.top:
        keyword = next(parent for parent in LANGUAGE.parents[keyword] if keyword in LANGUAGE.blocks[parent].holds)
        primitive = "SPHERE { } " if keyword == "SOLID" else ""
        text = f"{keyword} {{ {primitive}{text} }}"
    errors = [found for found in m3dc.compile(text).diagnostics if found.severity == "error"]
    assert not errors, text
