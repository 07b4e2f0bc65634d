"""Much at once: someone types, everything that an editor asks for is asked for after each stroke, half of it is given
up, and a preview is drawn all the while."""

from __future__ import annotations

import asyncio
import random
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

import pytest
from announced import VIEWS, announced
from editor import Editor, position
from lsprotocol import types
from own_requests import start_server
from pygls.exceptions import JsonRpcException, JsonRpcRequestCancelled

import m3dc

pytestmark = [pytest.mark.asyncio(loop_scope="session"), pytest.mark.slow]

EDITS = 500
MOST_WAITING = 12  # of requests: an editor asks for no more at once
STROKES = ["1", "0", "-", " ", "}", "{", "\n", "/* 🐚 */", "SPHERE { }", "size", "RADIUS"]


async def test_a_storm(examples: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = tmp_path / "log.txt"
    client, capabilities = await start_server("visual_studio_code", "utf-32", "--log-file", str(log))
    chance = random.Random(1993)
    times: dict[str, list[float]] = defaultdict(list)
    ends: dict[str, int] = defaultdict(int)
    waiting: set[asyncio.Task[None]] = set()

    async def ask(method: str, params: Any, number: str) -> None:
        started = time.perf_counter()
        try:
            answer = await asyncio.wrap_future(client.protocol.send_request(method, params, msg_id=number))
        except JsonRpcRequestCancelled:
            ends["cancelled"] += 1
            return
        except JsonRpcException as error:  # there is nothing to rename, or tokens would be of a later text
            if error.code not in (types.LSPErrorCodes.RequestFailed, types.LSPErrorCodes.ContentModified):
                raise
            ends["refused"] += 1
            return
        times[method].append(time.perf_counter() - started)
        ends[getattr(answer, "status", "answered")] += 1

    editor = Editor(client)
    good = (examples / "two-balls.m3d").read_text(encoding="utf-8")
    scene = editor.open(good)
    text, identifier = good, {"uri": scene.uri}
    drawn = {"textDocument": identifier, "preview": "storm", "optics": "mirage", "maxWidth": 200}
    for stroke in range(EDITS):
        at = chance.randint(0, len(text))
        end = min(len(text), at + chance.choice((0, 0, 0, 1, 9)))
        new = chance.choice(STROKES)
        range_ = types.Range(position(text, at), position(text, end))
        editor.change(scene, types.TextDocumentContentChangePartial(range_, new))
        text = text[:at] + new + text[end:]
        if len(text) > 2 * len(good) or stroke % 50 == 49:  # or nothing would ever be right again
            editor.change(scene, types.TextDocumentContentChangeWholeDocument(good))
            text = good
        requests = announced(capabilities, scene.identifier, position(text, chance.randint(0, len(text))))
        requests = chance.sample(requests, min(3, len(requests)))
        requests.append((chance.choice(VIEWS), {"textDocument": identifier}))
        if stroke % 5 == 0:
            requests.append(("m3d/preview/render", drawn))
        for method, params in requests:
            number = f"{stroke} {method}"
            task = asyncio.create_task(ask(method, params, number))
            waiting.add(task)
            task.add_done_callback(waiting.discard)
            if chance.random() < 0.3:
                await asyncio.sleep(0)  # it is sent
                client.cancel_request(types.CancelParams(number))
        while len(waiting) > MOST_WAITING:
            await asyncio.wait(waiting, return_when=asyncio.FIRST_COMPLETED)
        await asyncio.sleep(chance.choice((0, 0, 0.005, 0.02)))
    async with asyncio.timeout(120):
        await asyncio.gather(*waiting)

    shown = await editor.diagnostics(scene)
    expected = m3dc.compile(text).diagnostics
    assert [(each.code, each.message) for each in shown] == [(each.code, each.message) for each in expected]
    editor.replace(scene, good)
    answer = await client.protocol.send_request_async("m3d/preview/render", drawn)
    assert (answer.status, answer.stale) == ("done", False)
    await client.shutdown_session()
    assert " ERROR " not in log.read_text(encoding="utf-8")
    assert ends["cancelled"]
    assert not ends["error"]
    with capsys.disabled():
        print(f"\n{EDITS} edits; requests: {dict(ends)}")
        for method, taken in sorted(times.items()):
            ordered = sorted(1000 * each for each in taken)
            p50, p95 = (ordered[int(share * (len(ordered) - 1))] for share in (0.5, 0.95))
            print(f"  {method:36} p50 {p50:7.1f} ms   p95 {p95:7.1f} ms   of {len(ordered)}")
