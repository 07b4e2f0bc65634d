"""Who uses a variable, what it uses, what it is a copy of, and what are copies of it."""

from __future__ import annotations

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")

SCENE = """\
VARIABLES { NUMBER size; SPHERE ball, big; SOLID pair; }
size = 2
ball = { RADIUS size }
big = ball { RADIUS size CENTER < size, 0, 0 > }
pair = { SPHERE ball SPHERE big }
pair = { SPHERE ball }
/* The one. */
SOLID { SPHERE ball }
SOLID pair
LIGHT { }
"""


async def calls(editor: Editor, scene: Scene) -> tuple[list[str], list[str]]:
    """The names of what uses the thing at the cursor, with how often, and of what it uses."""
    prepared = await editor.client.text_document_prepare_call_hierarchy_async(
        types.CallHierarchyPrepareParams(**scene.at())
    )
    (item,) = prepared or []
    incoming = await editor.client.call_hierarchy_incoming_calls_async(types.CallHierarchyIncomingCallsParams(item))
    outgoing = await editor.client.call_hierarchy_outgoing_calls_async(types.CallHierarchyOutgoingCallsParams(item))
    used = {scene.part(range_) for call in incoming or () for range_ in call.from_ranges}
    assert used <= {item.name}
    return (
        [f"{call.from_.name} {len(call.from_ranges)}" for call in incoming or ()],
        [f"{call.to.name} {len(call.from_ranges)}" for call in outgoing or ()],
    )


async def copies(editor: Editor, scene: Scene) -> tuple[list[str], list[str]]:
    prepared = await editor.client.text_document_prepare_type_hierarchy_async(
        types.TypeHierarchyPrepareParams(**scene.at())
    )
    (item,) = prepared or []
    above = await editor.client.type_hierarchy_supertypes_async(types.TypeHierarchySupertypesParams(item))
    below = await editor.client.type_hierarchy_subtypes_async(types.TypeHierarchySubtypesParams(item))
    return [item.name for item in above or ()], [item.name for item in below or ()]


@pytest.mark.parametrize(
    ("place", "incoming", "outgoing"),
    [
        ("NUMBER $0size", ["ball 1", "big 2"], []),
        ("RADIUS siz$0e CENTER", ["ball 1", "big 2"], []),
        ("SPHERE $0ball, big", ["big 1", "pair 2", "The one 1"], ["size 1"]),
        ("pa$0ir = { SPHERE ball SPHERE", ["SOLID pair 1"], ["ball 2", "big 1"]),
        ("SOL$0ID { SPHERE", [], ["ball 1"]),
    ],
)
async def test_calls(editor: Editor, place: str, incoming: list[str], outgoing: list[str]) -> None:
    scene = editor.open(SCENE.replace(place.replace("$0", ""), place))
    assert await calls(editor, scene) == (incoming, outgoing)


@pytest.mark.parametrize(
    ("place", "above", "below"),
    [
        ("SPHERE $0ball, big", [], ["big", "SPHERE ball", "SPHERE ball", "SPHERE ball"]),
        ("bi$0g = ball", ["ball"], ["SPHERE big"]),
        ("SOL$0ID pair\n", ["pair"], []),
    ],
)
async def test_copies(editor: Editor, place: str, above: list[str], below: list[str]) -> None:
    scene = editor.open(SCENE.replace(place.replace("$0", ""), place))
    assert await copies(editor, scene) == (above, below)


async def test_equal_blocks_are_told_apart(editor: Editor) -> None:
    scene = editor.open("""\
VARIABLES { SPHERE ba$0ll; SOLID pair; }
pair = { SPHERE ball SPHERE ball { CENTER < 1, 0, 0 > } }
SOLID { SPHERE ball TRANSFORM { TRANSLATE < 3, 0, 0 > } }
SOLID { SPHERE ball { CENTER < 2, 0, 0 > } }
""")
    prepared = await editor.client.text_document_prepare_type_hierarchy_async(
        types.TypeHierarchyPrepareParams(**scene.at())
    )
    (item,) = prepared or []
    below = await editor.client.type_hierarchy_subtypes_async(types.TypeHierarchySubtypesParams(item))
    assert [f"{each.name}: {each.detail}" for each in below or ()] == [
        "SPHERE ball: in pair",
        "SPHERE ball: at < 1, 0, 0 >, in pair",
        "SPHERE ball: in SOLID (at < 3, 0, 0 >, SPHERE)",
        "SPHERE ball: at < 2, 0, 0 >, in SOLID (SPHERE at < 2, 0, 0 >)",
    ]


async def test_nothing_is_there(editor: Editor) -> None:
    params = types.CallHierarchyPrepareParams(**editor.open("SOLID { SPH$0ERE { } }").at())
    assert not await editor.client.text_document_prepare_call_hierarchy_async(params)
    params = types.CallHierarchyPrepareParams(**editor.open("VARI$0ABLES { }").at())
    assert not await editor.client.text_document_prepare_call_hierarchy_async(params)
