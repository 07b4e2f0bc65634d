"""Editors differ in what they can do: the server starts with each, and answers all that it says it does."""

from __future__ import annotations

import pytest
from announced import announced
from editor import Editor, SceneClient
from lsprotocol import types
from own_requests import start_server
from pygls.exceptions import JsonRpcMethodNotFound

import m3dc

pytestmark = [pytest.mark.asyncio(loop_scope="session"), pytest.mark.slow]

EDITORS = [
    "visual_studio_code_v1.65.2",
    "neovim_v0.6.1",
    "neovim_v0.7.0",
    "neovim_v0.8.0",
    "neovim_v0.9.1",
    "neovim_v0.10.0",
    "neovim_v0.11.0",
    "emacs_v29.1",
]

SCENE = """\
VARIABLES { NUMBER si$0ze; SURFACE red; }
size = 2
red = { COLOR < 1, 0, 0 > }
SOLID { SPHERE { RADIUS size CENTRE < 0, 0, 1 > } SURFACE red }
LIGHT { SOURCE { FROM < 0, 0, 9 > } }
"""


async def diagnostics(client: SceneClient, editor: Editor, uri: str, pulls: bool) -> list[types.Diagnostic]:
    """The diagnostics of a scene, in the way that an editor gets them."""
    if not pulls:
        published = await client.wait_until(lambda: client.published.get(uri))
        return list(published.diagnostics)
    report = await client.text_document_diagnostic_async(
        types.DocumentDiagnosticParams(types.TextDocumentIdentifier(uri))
    )
    assert isinstance(report, types.RelatedFullDocumentDiagnosticReport)
    return list(report.items)


@pytest.mark.parametrize("like", EDITORS)
async def test_an_editor_is_served(like: str) -> None:
    name, _, version = like.rpartition("_v")
    client, capabilities = await start_server(f"{name}@v{version}")
    try:
        editor = Editor(client)
        scene = editor.open(SCENE)
        assert client.capabilities is not None
        document = client.capabilities.text_document
        pulls = document is not None and document.diagnostic is not None
        shown = await diagnostics(client, editor, scene.uri, pulls)
        assert [each.message for each in shown] == [each.message for each in m3dc.compile(scene.text).diagnostics]
        requests = announced(capabilities, scene.identifier, scene.cursor)
        for method, params in requests:
            await client.protocol.send_request_async(method, params)
        with pytest.raises(JsonRpcMethodNotFound):
            await client.protocol.send_request_async("m3d/unheardOf", {})
    finally:
        await client.shutdown_session()
