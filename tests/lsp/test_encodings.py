"""Places are right whatever an editor counts: bytes, UTF-16 units or characters, also beyond the first 65,536."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from editor import Editor
from lsprotocol import types
from own_requests import start_server

pytestmark = pytest.mark.asyncio(loop_scope="session")

BEFORE = "/* 𝔐 ∂ é 🏝 */ SOLID { SPHERE { /* 🐚 */ RADIUS "
SCENE = f"/* 🌅 */\n{BEFORE}-5 /* 🐟 */ }} }}\nLIGHT {{ SOURCE {{ FROM < 0, 0, 9 > }} }}\n"
COUNTED: dict[str, Callable[[str], int]] = {
    "utf-8": lambda text: len(text.encode()),
    "utf-16": lambda text: len(text.encode("utf-16-le")) // 2,
    "utf-32": len,
}


@pytest.mark.slow
@pytest.mark.parametrize("encoding", COUNTED)
async def test_places_count_what_was_agreed_on(encoding: str) -> None:
    client, capabilities = await start_server(encoding=encoding)
    try:
        assert capabilities.position_encoding == encoding
        editor = Editor(client)
        scene = editor.open(SCENE)
        units = COUNTED[encoding](BEFORE)
        number = types.Range(types.Position(1, units), types.Position(1, units + 2))
        (shown,) = await editor.diagnostics(scene)
        assert shown.range == number

        minus = types.Range(number.start, types.Position(1, units + 1))
        editor.change(scene, types.TextDocumentContentChangePartial(minus, "/* 🦀 */ "))
        assert await editor.diagnostics(scene) == []
        dump = await client.protocol.send_request_async("m3d/dump", {"textDocument": {"uri": scene.uri}})
        assert ": 5.000000" in dump.text
        ends = {(place.end.line, place.end.character) for place in dump.ranges if place and place.start.line == 1}
        line = BEFORE + "/* 🦀 */ 5 /* 🐟 */ } }"
        assert (1, COUNTED[encoding](line)) in ends

        past = types.Position(1, 10_000)  # the end of its line, LSP says
        editor.change(scene, types.TextDocumentContentChangePartial(types.Range(past, past), " /* 🐙 */ )"))
        (shown,) = await editor.diagnostics(scene)
        assert shown.range.start == types.Position(1, COUNTED[encoding](line + " /* 🐙 */ "))
    finally:
        await client.shutdown_session()
