"""Symbols of all workspace folders: of files as they are on disk, and of open documents as they are in the editor."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from editor import Editor, position
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")

FAR = """\
/* far away: \N{MILKY WAY} */ VARIABLES { VECTOR distant_sand; } distant_sand = < 1, 1, 1 >
/* The distant plain. */
SOLID { PLANE { /* distant part */ } }
"""


@pytest.fixture
def folders(editor: Editor, tmp_path: Path) -> Iterator[list[Path]]:
    """Two more workspace folders with a file each."""
    paths = [tmp_path / "near", tmp_path / "far"]
    for path in paths:
        (path / ".hidden").mkdir(parents=True)
        (path / ".hidden/distant.m3d").write_text("SOLID { } /* distant and hidden */")
    (paths[0] / "first.m3d").write_text("VARIABLES { NUMBER near_by; }")
    (paths[1] / "deep").mkdir()
    (paths[1] / "deep/second.m3d").write_text(FAR, encoding="utf-8")
    change(editor, paths, [])
    yield paths
    change(editor, [], paths)


def change(editor: Editor, added: list[Path], removed: list[Path]) -> None:
    event = types.WorkspaceFoldersChangeEvent(
        *([types.WorkspaceFolder(path.as_uri(), path.name) for path in paths] for paths in (added, removed))
    )
    editor.client.workspace_did_change_workspace_folders(types.DidChangeWorkspaceFoldersParams(event))


async def find(editor: Editor, query: str) -> list[str]:
    found = await editor.client.workspace_symbol_async(types.WorkspaceSymbolParams(query))
    return [f"{Path(symbol.location.uri).name}: {symbol.name}" for symbol in found or ()]


async def test_files_of_all_folders(editor: Editor, folders: list[Path]) -> None:
    assert await find(editor, "distant") == [
        "second.m3d: distant_sand",
        "second.m3d: The distant plain",
    ]
    assert await find(editor, "Near") == ["first.m3d: near_by"]
    assert await find(editor, "nb") == ["first.m3d: near_by"]
    found = await editor.client.workspace_symbol_async(types.WorkspaceSymbolParams("distant_sand"))
    (symbol,) = found or []
    assert isinstance(symbol.location, types.Location)
    assert symbol.location.range.start == position(FAR, FAR.index("distant_sand"))
    assert symbol.kind == types.SymbolKind.Variable


async def test_a_changed_file_is_read_again_and_a_deleted_one_forgotten(editor: Editor, folders: list[Path]) -> None:
    assert await find(editor, "near_by") == ["first.m3d: near_by"]
    (folders[0] / "first.m3d").write_text("VARIABLES { NUMBER near_by_and_more; }")
    assert await find(editor, "near_by") == ["first.m3d: near_by_and_more"]
    (folders[0] / "first.m3d").unlink()
    assert await find(editor, "near_by") == []


async def test_an_open_document_counts_as_it_is_in_the_editor(editor: Editor, folders: list[Path]) -> None:
    scene = editor.open("VARIABLES { NUMBER nearest; }", uri=(folders[0] / "first.m3d").as_uri())
    assert await find(editor, "near") == ["first.m3d: nearest"]
    editor.replace(scene, "VARIABLES { NUMBER nearer; }")
    assert await find(editor, "near") == ["first.m3d: nearer"]
    editor.close()
    assert await find(editor, "near") == ["first.m3d: near_by"]
