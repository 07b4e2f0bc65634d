"""The server's process: what is loaded into it after every feature has been used."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import attrs
import pytest
import pytest_lsp
from editor import OURS, Editor, SceneClient, position
from lsprotocol import converters, types
from pygls.exceptions import JsonRpcException

from m3d_lsp.registry import REQUESTS
from m3d_lsp.server import make_server

pytestmark = pytest.mark.asyncio(loop_scope="session")

# A server that leaves the names of its modules, and of its shared objects where the system tells them, in a file.
SERVER = """
import pathlib, sys
from m3d_lsp.cli import main
status = main([])
maps = pathlib.Path("/proc/self/maps")
pathlib.Path(sys.argv[1]).write_text("\\n".join(sys.modules) + (maps.read_text() if maps.exists() else ""))
sys.exit(status)
"""
SCENE = """\
VARIABLES { NUMBER size; VECTOR sand; SURFACE red; TRANSFORM up; }
size = 2
sand = < 0.8, 0.7, 0.5 >
red = { COLOR sand }
up = { TRANSZ size ROTX 30 }
SOLID { SPHERE { RADIUS size TRANSFORM up } SURFACE red }
SOLID { POLYGONS { VERTICES { 3 < 0, 0, 0 > < 1, 0, 0 > < 0, 1, 0 > } FACETS { 1 0 1 2 } } }
SOLID { PLANE { } SURFACE { TEXTURE { WOOD { COLORS { 0 1 < 0, 0, 0 > < 1, 1, 1 > } } } } }
LIGHT { SOURCE { FROM < 0, 0, 9 > } }
SCENE { VIEW { FROM < 0, 0, 1 > TO < 9, 0, 1 > WIDTH 32 HEIGHT 20 } MIRAGE { PROFILE { 0 15 100 15 200 14 } } }
"""


def asked(uri: str, index: int) -> dict[str, Any]:
    """Parameters that fit every request about a place of a document."""
    place = position(SCENE, index)
    at = {"line": place.line, "character": place.character}
    red = {"start": {"line": 3, "character": 0}, "end": {"line": 3, "character": 3}}
    whole = {"start": {"line": 0, "character": 0}, "end": {"line": SCENE.count("\n"), "character": 0}}
    return {
        "textDocument": {"uri": uri},
        "position": at,
        "positions": [at],
        "range": whole if index == 0 else {"start": at, "end": at},
        "context": {
            "diagnostics": [],
            "includeDeclaration": True,
            "frameId": 0,
            "stoppedLocation": whole,
            "triggerKind": 1,
            "isRetrigger": False,
        },
        "options": {"tabSize": 4, "insertSpaces": True},
        "color": {"red": 1, "green": 0.5, "blue": 0, "alpha": 1},
        "newName": "other",
        "ch": "}",
        "previousResultId": "none",
        "item": {"name": "red", "kind": 13, "uri": uri, "range": red, "selectionRange": red},
    }


async def test_the_kernel_is_never_loaded(tmp_path: Path) -> None:
    make_server()  # imports every feature, which declares what it answers
    client = SceneClient()
    left = tmp_path / "loaded"
    await client.start_io(sys.executable, "-c", SERVER, str(left))  # pyright: ignore[reportUnknownMemberType]
    capabilities = pytest_lsp.client_capabilities("visual_studio_code")
    capabilities.experimental = OURS
    await client.initialize_session(types.InitializeParams(capabilities=capabilities))
    scene = Editor(client).open(SCENE)
    hovers: list[str] = []
    send, structure = client.protocol.send_request_async, converters.get_converter().structure
    for entry in REQUESTS:
        if entry.method == types.CODE_ACTION_RESOLVE:
            continue  # of what an answer has put off; here none does
        kind: Any = types.METHOD_TO_TYPES[entry.method][2]
        about_a_place = {member.name for member in attrs.fields(kind)} & {"position", "positions", "range"}
        for index in range(0, len(SCENE) if about_a_place else 1, 29):
            try:
                answer: Any = await send(entry.method, structure(asked(scene.uri, index), kind))
            except JsonRpcException:
                continue  # refused, as renaming a number is
            if entry.method == types.TEXT_DOCUMENT_HOVER and answer is not None:
                hovers.append(answer.contents.value)
    document = {"textDocument": {"uri": scene.uri}}
    for method in ("m3d/dump", "m3d/irTree", "m3d/syntaxTree"):
        await send(method, document)
    await send(types.WORKSPACE_SYMBOL, types.WorkspaceSymbolParams("re"))
    picture = {"preview": "one", "optics": "mirage", "maxWidth": 32, "maxHeight": 32}
    drawn = await send("m3d/preview/render", document | picture)
    assert drawn.status == "done"
    assert (await send("m3d/preview/pick", {"preview": "one", "x": 16, "y": 19})) is not None
    assert any("ray curvature" in said for said in hovers)
    await client.shutdown_session()
    await client.stop()
    loaded = left.read_text()
    assert "m3d_lsp.feature.hover" in loaded
    assert "m3d_render" not in loaded
    assert "_kernel" not in loaded
