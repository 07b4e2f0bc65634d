"""Whatever standard input is, messages are read from it; and the server ends when its client is gone."""

from __future__ import annotations

import json
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.slow

SERVER = [sys.executable, "-c", "import sys; from m3d_lsp.cli import main; sys.exit(main([]))"]
PATIENCE_S = 60


def framed(message: dict[str, Any]) -> bytes:
    body = json.dumps({"jsonrpc": "2.0", **message}).encode()
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


MESSAGES: list[dict[str, Any]] = [
    {"id": 1, "method": "initialize", "params": {"processId": None, "rootUri": None, "capabilities": {}}},
    {"method": "initialized", "params": {}},
    {"id": 2, "method": "shutdown", "params": None},
    {"method": "exit", "params": None},
]
SESSION = b"".join(map(framed, MESSAGES))


def answered(output: bytes) -> list[int]:
    """The numbers of the requests that were answered."""

    def messages() -> Iterator[dict[str, Any]]:
        rest = output
        while rest:
            head, _, rest = rest.partition(b"\r\n\r\n")
            length = int(head.split(b"Content-Length: ")[1].split(b"\r\n")[0])
            yield json.loads(rest[:length])
            rest = rest[length:]

    return [message["id"] for message in messages() if "result" in message]


def test_a_pipe() -> None:
    ran = subprocess.run(SERVER, input=SESSION, capture_output=True, timeout=PATIENCE_S, check=False)
    assert answered(ran.stdout) == [1, 2], ran.stderr.decode()


def test_a_file(tmp_path: Path) -> None:
    (tmp_path / "session").write_bytes(SESSION)
    with (tmp_path / "session").open("rb") as session:
        ran = subprocess.run(SERVER, stdin=session, capture_output=True, timeout=PATIENCE_S, check=False)
    assert answered(ran.stdout) == [1, 2], ran.stderr.decode()


def test_one_socket_for_both_ways() -> None:
    ours, theirs = socket.socketpair()
    with (
        ours,
        subprocess.Popen(SERVER, stdin=theirs.fileno(), stdout=theirs.fileno(), stderr=subprocess.PIPE) as server,
    ):
        theirs.close()
        ours.settimeout(PATIENCE_S)
        ours.sendall(SESSION)
        output = b"".join(iter(lambda: ours.recv(1 << 16), b""))
        assert answered(output) == [1, 2]
        server.wait(PATIENCE_S)


def test_a_client_that_is_gone() -> None:
    for kept in (0, len(SESSION) - 20):
        ran = subprocess.run(SERVER, input=SESSION[:kept], capture_output=True, timeout=PATIENCE_S, check=False)
        assert answered(ran.stdout) == [1, 2][: kept and 2]
        assert b"Traceback" not in ran.stderr
