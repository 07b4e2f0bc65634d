"""Views of what becomes of a scene: the dump, the IR and the syntax tree, and how they follow the text."""

from __future__ import annotations

from typing import Any

import pytest
from editor import Editor, Scene
from own_requests import edit, to_range
from pygls.exceptions import JsonRpcInvalidParams

import m3dc
from m3dc.ir.dump import lines

pytestmark = pytest.mark.asyncio(loop_scope="session")

TWO = """\
SOLID { SPHERE { RADIUS 2 } }
$[SOLID { SPH$0ERE { RADIUS 3 } }$]
LIGHT { $1SOURCE { FROM < 0, 0, 9 > } }
"""


async def ask(editor: Editor, method: str, scene: Scene, mark: str | None = None) -> Any:
    params: dict[str, Any] = {"textDocument": {"uri": scene.uri}}
    if mark is not None:
        at = scene.places[mark]
        params["position"] = {"line": at.line, "character": at.character}
    return await editor.client.protocol.send_request_async(method, params)


async def test_the_dump_is_that_of_the_compiler(editor: Editor) -> None:
    scene = editor.open(TWO)
    shown = await ask(editor, "m3d/dump", scene)
    expected = list(lines(m3dc.compile(scene.text).ir))
    assert shown.text == "\n".join(line.text for line in expected)
    assert (shown.version, shown.stale) == (1, False)
    assert len(shown.ranges) == len(expected)
    told = {scene.part(to_range(r)) for line, r in zip(expected, shown.ranges, strict=True) if "Radius" in line.text}
    assert told == {"SPHERE { RADIUS 2 }", "SPHERE { RADIUS 3 }"}
    assert shown.ranges[0] is None  # there is no SCENE


async def test_the_dump_of_what_is_under_the_cursor(editor: Editor) -> None:
    scene = editor.open(TWO)
    solid = await ask(editor, "m3d/dump", scene, "0")
    assert solid.text.startswith("Solid Object Definition # 1\n")
    assert ": 3.000000" in solid.text
    assert "2.000000" not in solid.text
    assert to_range(solid.ranges[0]) == scene.range
    light = await ask(editor, "m3d/dump", scene, "1")
    assert light.text.startswith("Light Object Definition # 1\n")
    nothing = await ask(editor, "m3d/dump", editor.open("VARIA$0BLES { NUMBER n; }\n" + scene.text), "0")
    assert (nothing.text, list(nothing.ranges)) == ("", [])


async def test_views_follow_edits_and_keep_the_last_good_state(editor: Editor) -> None:
    scene = edit(editor, editor.open(TWO), "RADIUS 3", "RADIUS 4")
    good = await ask(editor, "m3d/dump", scene)
    assert (good.version, good.stale) == (2, False)
    assert ": 4.000000" in good.text

    scene = edit(editor, scene, "RADIUS 2 } }", "RADIUS }\n }")  # what is after the mistake has moved
    kept = await ask(editor, "m3d/dump", scene)
    assert (kept.version, kept.stale, kept.text) == (2, True, good.text)
    (shown,) = {
        scene.part(to_range(r))
        for t, r in zip(kept.text.split("\n"), kept.ranges, strict=True)
        if "Radius" in t and "4.0" in t
    }
    assert shown == "SPHERE { RADIUS 4 }"
    tree = await ask(editor, "m3d/irTree", scene)
    assert (tree.version, tree.stale) == (2, True)

    scene = edit(editor, scene, "RADIUS }", "RADIUS 5 }")
    mended = await ask(editor, "m3d/dump", scene)
    assert (mended.version, mended.stale) == (4, False)
    assert ": 5.000000" in mended.text


async def test_a_scene_that_was_never_good_is_shown_as_far_as_it_goes(editor: Editor) -> None:
    shown = await ask(editor, "m3d/dump", editor.open(TWO + "SOLID { SPHERE"))
    assert shown.stale
    assert ": 3.000000" in shown.text


async def test_the_ir_is_shown_table_by_table(editor: Editor) -> None:
    scene = editor.open(TWO)
    shown = await ask(editor, "m3d/irTree", scene)
    tables = {node.label: node for node in shown.nodes}
    assert tables["scene"].label == "scene"
    assert tables["solids"].description == "2 rows"
    primitive = tables["primitives"].children[1]
    assert primitive.description == "SPHERE"
    assert scene.part(to_range(primitive.range)) == "SPHERE { RADIUS 3 }"
    sphere = {column.label: column.description for column in tables["spheres"].children[1].children}
    assert sphere["radius"] == "3"
    assert sphere["center"] == "<0, 0, 0>"
    assert [node.label for node in tables["scene"].children if node.label == "view"] == ["view"]


async def test_a_large_mesh_is_cut_short(editor: Editor) -> None:
    vertices = "\n".join(f"<{n}, {n * n % 7}, 0>" for n in range(1500))
    facets = "\n".join(f"{n} {n + 1} {n + 2}" for n in range(1400))
    mesh = f"POLYGONS {{ VERTICES {{ 1500 {vertices} }} FACETS {{ 1400 {facets} }} }}"
    scene = editor.open(f"SOLID {{ {mesh} }}\n{TWO}")
    shown = await ask(editor, "m3d/dump", scene)
    assert "... and 500 more" in shown.text
    tree = await ask(editor, "m3d/irTree", scene)
    (table,) = (node for node in tree.nodes if node.label == "vertices")
    assert (len(table.children), table.children[-1].label) == (501, "... and 1000 more")


async def test_the_syntax_tree_is_that_of_the_text_as_it_stands(editor: Editor) -> None:
    scene = editor.open("/* one */ SOLID { SPHERE { RADIUS 1 ] } }\n")
    shown = await ask(editor, "m3d/syntaxTree", scene)
    assert not shown.stale
    comment, solid = shown.nodes
    assert (comment.label, comment.description) == ("comment", "/* one */")
    assert scene.part(to_range(solid.range)) == "SOLID { SPHERE { RADIUS 1 ] } }"
    flat = [*shown.nodes]
    for node in flat:
        flat.extend(getattr(node, "children", []))
    assert {scene.part(to_range(node.range)) for node in flat if node.label == "ERROR"} == {"]"}
    keyword = flat[[node.label for node in flat].index('"SPHERE"')]
    assert keyword.description == "keyword:"


async def test_a_request_that_is_not_understood_is_refused(editor: Editor) -> None:
    scene = editor.open(TWO)
    ask_raw = editor.client.protocol.send_request_async
    with pytest.raises(JsonRpcInvalidParams, match="textDocument must be"):
        await ask_raw("m3d/dump", {})
    with pytest.raises(JsonRpcInvalidParams, match="is not open"):
        await ask_raw("m3d/dump", {"textDocument": {"uri": "file:///nowhere.m3d"}})
    with pytest.raises(JsonRpcInvalidParams, match="position must be"):
        await ask_raw("m3d/dump", {"textDocument": {"uri": scene.uri}, "position": {"line": -1, "character": 0}})
