"""What is shown between the words of a text."""

from __future__ import annotations

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")


async def hints(editor: Editor, scene: Scene, range_: types.Range | None = None) -> list[types.InlayHint]:
    whole = types.Range(types.Position(0, 0), types.Position(scene.text.count("\n") + 1, 0))
    params = types.InlayHintParams(scene.identifier, range_ or whole)
    return list(await editor.client.text_document_inlay_hint_async(params) or ())


async def check(editor: Editor, text: str, part: bool = False) -> None:
    """The hints are what stands in `⟨⟩`; with `part`, those in the range between `$[` and `$]` alone."""
    lines: list[str] = []
    expected: dict[int, list[tuple[int, str]]] = {}
    for number, line in enumerate(text.splitlines()):
        while "⟨" in line:
            before, rest = line.split("⟨", 1)
            label, after = rest.split("⟩", 1)
            expected.setdefault(number, []).append((len(before.replace("$[", "").replace("$]", "")), label))
            line = before + after
        lines.append(line)
    scene = editor.open("\n".join(lines) + "\n")
    found: dict[int, list[tuple[int, str]]] = {}
    for hint in await hints(editor, scene, scene.range if part else None):
        found.setdefault(hint.position.line, []).append((hint.position.character, str(hint.label)))
    assert {line: sorted(found[line]) for line in found} == expected


async def test_vertices_are_numbered(editor: Editor) -> None:
    await check(
        editor,
        """\
SOLID
{
    POLYGONS
    {
        VERTICES
        {
            ⟨vertices:⟩4 /* < 9, 9, 9 > */
            ⟨0:⟩< 0, 0, 0 >  ⟨1:⟩< 1, 0, 0 >
            ⟨2:⟩< 0, 1, 0 >  ⟨3:⟩< 1, 1, 0 >
        }
        FACETS { ⟨facets:⟩2  0 1 2  1 2 3 }
    }
}""",
    )


async def test_arguments_have_names(editor: Editor) -> None:
    await check(
        editor,
        """\
SCENE
{
    VIEW { FROM < 0, 0, 1 > REGION ⟨top:⟩0, ⟨left:⟩0, ⟨bottom:⟩199, ⟨right:⟩319 WIDTH 320 }
    MIRAGE { PROFILE { ⟨elevation:⟩0 ⟨temperature:⟩10  5 11  10 12 } }
}
SOLID { TERRAIN { VERTICES { ⟨rows:⟩2 ⟨columns:⟩2 < 0, 0, 0 > < 0, 1, 0 > < 1, 0, 0 > < 1, 1, 1 > } } }
SOLID
{
    SPHERE { }
    SURFACE
    {
        TEXTURE
        {
            WOOD { COLORS { ⟨start:⟩0 ⟨end:⟩1 ⟨start color:⟩< 0, 0, 0 > ⟨end color:⟩< 1, 1, 1 > } }
            MARBLE { COLORS { 0 0.5 < 0, 0, 0 > < 1, 1, 1 >
                              0.5 1 < 0, 0, 0 > < 1, 1, 1 > } }
        }
    }
}""",
    )


async def test_variables_have_values(editor: Editor) -> None:
    await check(
        editor,
        """\
VARIABLES { NUMBER r, s; VECTOR v, w; SPHERE ball; }
r = 2

s = r ⟨= 2⟩

v = < 1, r ⟨= 2⟩, 0 >
w = v ⟨= < 1, 2, 0 >⟩
ball = { RADIUS s ⟨= 2⟩ }
r = 3

SOLID { SPHERE ball { CENTER w ⟨= < 1, 2, 0 >⟩ RADIUS r ⟨= 3⟩ } }
SOLID
{
    POLYGONS
    {
        VERTICES { ⟨vertices:⟩3 ⟨0:⟩w ⟨= < 1, 2, 0 >⟩ ⟨1:⟩< r ⟨= 3⟩, 0, 0 > ⟨2:⟩< 0, 0, 0 > }
        FACETS { ⟨facets:⟩1 0 1 2 }
    }
}
""".replace(" ⟨= ", "⟨= "),
    )


async def test_columns_stay_lined_up(editor: Editor) -> None:
    rows = "".join(f"    ⟨\N{FIGURE SPACE}{row}:⟩< {row}, 0, 0 >\n" for row in range(10))
    await check(
        editor,
        f"""\
SCENE
{{
    MIRAGE
    {{
        PROFILE
        {{
             0 10
             5 11
            10 12
        }}
    }}
}}
SOLID {{ POLYGONS {{ VERTICES {{ ⟨vertices:⟩11
{rows}    ⟨10:⟩< 10, 0, 0 > }} FACETS {{ ⟨facets:⟩1 0 1 2 }} }} }}""",
    )


async def test_a_value_is_said_once(editor: Editor) -> None:
    await check(
        editor,
        """\
VARIABLES { NUMBER r; VECTOR v; }
r = 2

SOLID { SPHERE { RADIUS r ⟨= 2⟩ CENTER < r, r, 0 > } }
SOLID { SPHERE { RADIUS r } }
SOLID { SPHERE { RADIUS r } }

SOLID { SPHERE { RADIUS r ⟨= 2⟩ } }
r = 3
SOLID { SPHERE { RADIUS r } }
r = 4 SOLID { SPHERE { RADIUS r } }

SOLID { SPHERE { RADIUS r ⟨= 4⟩ } }
""".replace(" ⟨= ", "⟨= "),
    )


async def test_only_what_is_in_view(editor: Editor) -> None:
    await check(
        editor,
        """\
SOLID { POLYGONS { VERTICES { 5
< 0, 0, 0 >
$[⟨1:⟩< 1, 0, 0 >
⟨2:⟩< 2, 0, 0 >
$]< 3, 0, 0 >
< 4, 0, 0 > } } }""",
        part=True,
    )


async def test_each_kind_can_be_switched_off() -> None:
    from m3d_lsp.client import Client
    from m3d_lsp.feature.inlay_hints import inlay_hints
    from m3d_lsp.settings import read_settings
    from m3d_lsp.snapshot import Snapshot
    from m3d_lsp.text import Text
    from m3dc.analysis import Analyser

    text = Text.of(
        "VARIABLES { NUMBER r; } r = 1\n\nSCENE { VIEW { REGION 0, 0, r, 9 } }\n"
        "SOLID { POLYGONS { VERTICES { 3 < 0, 0, 0 > < 1, 0, 0 > < 0, 1, 0 > } FACETS { 1 0 1 2 } } }\n"
    )
    analysis = Analyser().analyse(text.source)
    shown = {"vertexIds": "0:", "argumentNames": "top:", "variableValues": "= 1"}
    for off in shown:
        settings, _ = read_settings({"inlayHints": {off: False}})
        snapshot = Snapshot("file:///s.m3d", 1, text, analysis, settings, Client())
        range_ = snapshot.range((0, len(text.data)))
        labels = {
            hint.label
            for hint in inlay_hints(snapshot, types.InlayHintParams(types.TextDocumentIdentifier(""), range_))
        }
        assert {kind for kind, label in shown.items() if label in labels} == shown.keys() - {off}
