"""A variable renamed: in all its places, or refused with the reason."""

from __future__ import annotations

import pytest
from editor import Editor, Scene, apply
from lsprotocol import types
from pygls.exceptions import JsonRpcException

pytestmark = pytest.mark.asyncio(loop_scope="session")

SCENE = """\
VARIABLES { NUMBER size, far; SPHERE ball; }
size = 0.5 far = size /* size */
SOLID { SPHERE ball { RADIUS si$0ze CENTER < far, size, 0 > } }
"""


async def rename(editor: Editor, scene: Scene, new: str) -> str:
    edit = await editor.client.text_document_rename_async(types.RenameParams(new_name=new, **scene.at()))
    assert edit is not None
    assert edit.changes is not None
    assert list(edit.changes) == [scene.uri]
    return apply(scene.text, edit.changes[scene.uri])


async def test_all_places_change(editor: Editor) -> None:
    scene = editor.open(SCENE)
    assert await rename(editor, scene, "radius_1") == (
        "VARIABLES { NUMBER radius_1, far; SPHERE ball; }\n"
        "radius_1 = 0.5 far = radius_1 /* size */\n"
        "SOLID { SPHERE ball { RADIUS radius_1 CENTER < far, radius_1, 0 > } }\n"
    )


async def test_half_typed_text(editor: Editor) -> None:
    scene = editor.open("VARIABLES { NUMBER a$0; }\nSOLID { SPHERE { RADIUS a } PLA }\nSOLID { SPHERE { RADIUS a } }\n")
    assert (await rename(editor, scene, "b")).count("RADIUS b") == 2


async def test_broken_text(editor: Editor) -> None:
    scene = editor.open("""\
VARIABLES { NUMBER size$0; }
size = 1
SOLID { SPHERE { CENTER < size, 2 > RADIUS size } SPHERE { CENTER < size+1, 1e5, 3size > } ( size } /* size */
other = = size
size = size;
""")
    assert (
        await rename(editor, scene, "r")
        == """\
VARIABLES { NUMBER r; }
r = 1
SOLID { SPHERE { CENTER < r, 2 > RADIUS r } SPHERE { CENTER < r+1, 1e5, 3size > } ( r } /* size */
other = = r
r = r;
"""
    )


@pytest.mark.parametrize(
    ("new", "reason"),
    [
        ("RADIUS", "RADIUS is a reserved word of the language. Small letters would do: radius."),
        ("far", "There is a NUMBER far already."),
        ("2nd", "'2nd' is no name: a name starts with a letter and goes on with letters, digits and underscores."),
        ("größe", "'größe' is no name: a name starts with a letter and goes on with letters, digits and underscores."),
        ("x" * 257, "The name has 257 characters; it can have 256 at most."),
        (" ", "A variable needs a name."),
    ],
)
async def test_a_name_that_can_not_be(editor: Editor, new: str, reason: str) -> None:
    scene = editor.open(SCENE)
    with pytest.raises(JsonRpcException) as refused:
        await rename(editor, scene, new)
    assert refused.value.message == reason
    assert refused.value.code == types.LSPErrorCodes.RequestFailed


async def test_prepare(editor: Editor) -> None:
    scene = editor.open(SCENE)
    found = await editor.client.text_document_prepare_rename_async(types.PrepareRenameParams(**scene.at()))
    assert isinstance(found, types.PrepareRenamePlaceholder)
    assert (found.placeholder, scene.part(found.range)) == ("size", "size")
    scene = editor.replace(scene, SCENE.replace("si$0ze", "size").replace("SPHERE ball {", "SPH$0ERE ball {"))
    with pytest.raises(JsonRpcException, match="There is no variable here"):
        await editor.client.text_document_prepare_rename_async(types.PrepareRenameParams(**scene.at()))


async def test_linked_editing(editor: Editor) -> None:
    scene = editor.open(SCENE)
    found = await editor.client.text_document_linked_editing_range_async(types.LinkedEditingRangeParams(**scene.at()))
    assert found is not None
    assert [scene.part(range_) for range_ in found.ranges] == ["size"] * 5
    scene = editor.replace(scene, "SOLID { SPHERE { RADIUS unde$0clared } }")
    params = types.LinkedEditingRangeParams(**scene.at())
    assert await editor.client.text_document_linked_editing_range_async(params) is None
