"""A language server in a process of its own, one for all tests, and scenes opened in it."""

from __future__ import annotations

import sys
from collections.abc import AsyncIterator

import pytest_asyncio
import pytest_lsp
from editor import OURS, Editor, SceneClient
from lsprotocol import types
from pytest_lsp import ClientServerConfig

COMMAND = [sys.executable, "-m", "m3d_lsp"]


@pytest_lsp.fixture(  # pyright: ignore[reportUnknownMemberType]  of no type in pytest-lsp
    scope="session",
    loop_scope="session",
    config=ClientServerConfig(server_command=COMMAND, client_factory=SceneClient),
)
async def client(lsp_client: SceneClient):
    """A client that can do what VS Code can. Positions count UTF-32, as Python does."""
    capabilities = pytest_lsp.client_capabilities("visual_studio_code")
    assert capabilities.general is not None
    capabilities.general.position_encodings = [types.PositionEncodingKind.Utf32]
    capabilities.experimental = OURS
    await lsp_client.initialize_session(types.InitializeParams(capabilities=capabilities, root_uri="file:///scenes"))
    yield
    await lsp_client.shutdown_session()


@pytest_asyncio.fixture(loop_scope="session")
async def editor(client: SceneClient) -> AsyncIterator[Editor]:
    """An editor that closes what it opened."""
    editor = Editor(client)
    yield editor
    editor.close()
