"""What the tests of requests that LSP does not know share, and servers of their own for tests that end them."""

from __future__ import annotations

import asyncio
import sys
from typing import Any

import pytest_lsp
from editor import OURS, Editor, Scene, SceneClient, position
from lsprotocol import types

COMMAND = [sys.executable, "-m", "m3d_lsp"]


def to_range(given: Any) -> types.Range:
    """A range as the client gets it in an answer whose form it does not know."""
    return types.Range(
        types.Position(given.start.line, given.start.character), types.Position(given.end.line, given.end.character)
    )


def edit(editor: Editor, scene: Scene, old: str, new: str) -> Scene:
    """Put other words in place of some that stand in a scene once."""
    assert scene.text.count(old) == 1
    start = scene.text.index(old)
    range_ = types.Range(position(scene.text, start), position(scene.text, start + len(old)))
    editor.change(scene, types.TextDocumentContentChangePartial(range_, new))
    return scene._replace(text=scene.text.replace(old, new))


async def start_server(
    like: str = "visual_studio_code", encoding: str = "utf-32", *options: str
) -> tuple[SceneClient, types.ServerCapabilities]:
    """A server of its own, whose client can do what an editor can (a name of pytest-lsp's); and what it can do."""
    client = SceneClient()
    await client.start_io(*COMMAND, *options)  # pyright: ignore[reportUnknownMemberType]  of no type in pygls
    capabilities = pytest_lsp.client_capabilities(like)
    if capabilities.general is None:
        capabilities.general = types.GeneralClientCapabilities()
    capabilities.general.position_encodings = [types.PositionEncodingKind(encoding)]
    if like == "visual_studio_code":
        capabilities.experimental = OURS
    params = types.InitializeParams(capabilities=capabilities, root_uri="file:///scenes")
    result = await client.initialize_session(params)
    return client, result.capabilities


def process_of(client: SceneClient) -> asyncio.subprocess.Process:
    """The server that a client has started."""
    server = client._server  # pyright: ignore[reportPrivateUsage]  pygls has no other name for it
    assert server is not None
    return server
