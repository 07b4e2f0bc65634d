"""Settings: asked for at the start and whenever they change, or taken as the client sends them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast

from lsprotocol import types

from ..registry import server_request

if TYPE_CHECKING:
    from ..server import Server


@server_request(types.INITIALIZED)
async def start(server: Server, params: types.InitializedParams) -> None:
    """Ask for the settings, where the client can be asked."""
    del params
    await server.fetch_settings()


@server_request(types.WORKSPACE_DID_CHANGE_CONFIGURATION)
async def change(server: Server, params: types.DidChangeConfigurationParams) -> None:
    """Some clients send the settings, others only that there are others."""
    if server.can_ask_for_settings:
        await server.fetch_settings()
    elif isinstance(params.settings, Mapping):
        given = cast("Mapping[str, Any]", params.settings)
        server.apply_settings(given.get("m3d", given))
