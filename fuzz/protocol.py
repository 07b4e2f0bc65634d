"""Whatever a client sends, every request is answered once, none for a fault of the server, and nothing ends it but
`exit`.

A case is a session: `initialize` with capabilities as LSP has them, with members missing, null, or nobody's idea; a
scene that is opened; then messages of all of LSP's methods and our own, most of them damaged.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import random
import typing
from collections.abc import Callable, Iterator
from enum import Enum
from typing import Any

import attrs
from lsprotocol import converters, types

from m3d_lsp.server import Server, make_server

from . import repeating
from .json_values import is_container, keys, values

SUFFIX = ".lsp"

# Less than a whole target is given after its time (GRACE_SECONDS), so that a lost answer is reported.
PATIENCE_S = 30.0
URI = "file:///nowhere/scene.m3d"
SCENE = """\
VARIABLES { NUMBER size; SURFACE red; }
size = 2
red = { COLOR < 1, 0, 0 > }
SOLID { SPHERE { RADIUS size } SURFACE red }
LIGHT { SOURCE { FROM < 0, 0, 9 > } }
"""
TEXTS = [
    "",
    URI,
    "file:///nowhere",
    "http://[",
    "untitled:\x00",
    "markdown",
    "plaintext",
    "SOLID",
    "é\ud800",
    "m3d.applyEdit",
]
ODD: list[Any] = [
    None,
    True,
    -1,
    0,
    1.5,
    1 << 31,
    1 << 70,
    "",
    "x",
    "\x00",
    [],
    {},
    [[]],
    [None],
    {"uri": 5},
    {"uri": URI},
]
OWN = {
    "m3d/dump": {"textDocument": {"uri": URI}, "position": {"line": 3, "character": 9}},
    "m3d/irTree": {"textDocument": {"uri": URI}},
    "m3d/syntaxTree": {"textDocument": {"uri": URI}},
    "m3d/preview/pick": {"preview": "none", "x": 1, "y": 2},
    "m3d/preview/mask": {"preview": "none", "position": {"line": 3, "character": 9}},
    "m3d/preview/ray": {"preview": "none", "x": 1, "y": 2, "width": 9, "height": 9},
    "m3d/preview/close": {"preview": "none"},
    "m3d/unheardOf": {},
    "m3d/preview/save": {"textDocument": {"uri": URI}, "optics": "no such optics", "path": "nowhere/x.png"},
}
# They end a session, and so are sent at its end.
LAST = (types.INITIALIZE, types.SHUTDOWN, types.EXIT)
METHODS = sorted({*types.METHOD_TO_TYPES, *OWN} - {*LAST})

_CONVERTER = converters.get_converter()  # resolves the types of members


# --- making sessions --------------------------------------------------------------------------------------------------


def make(chance: random.Random) -> bytes:
    return session(chance, chance.randint(5, 60))


def session(chance: random.Random, messages: int) -> bytes:
    """A session of so many messages after its start."""
    number = iter(range(1, messages + 9))
    sent: list[bytes] = [
        _framed(chance, {"id": 0, "method": types.INITIALIZE, "params": initialize(chance)}),
        _framed(chance, {"method": types.INITIALIZED, "params": {}}),
        _framed(chance, _opened()),
    ]
    for _ in range(messages):
        sent.append(_message(chance, number))
        if chance.random() < 0.05:  # or no document would be known any more after a while
            sent.append(_framed(chance, _opened()))
    return b"".join(sent)


def initialize(chance: random.Random) -> dict[str, Any]:
    """The parameters of `initialize`."""
    made: dict[str, Any] = {"processId": None, "rootUri": "file:///nowhere"}
    made["capabilities"] = of_type(types.ClientCapabilities, chance)
    if chance.random() < 0.5:
        made["capabilities"]["experimental"] = {"m3d": {"commands": ["m3d.preview", "m3d.dump"], "analysed": True}}
    if chance.random() < 0.3:
        made |= {"trace": chance.choice(["off", "verbose", "odd", None]), "locale": chance.choice([None, "de", 5])}
    damage(made["capabilities"], chance, chance.choice((0, 1, 3, 9)))
    return made


def _opened() -> dict[str, Any]:
    item = {"uri": URI, "languageId": "m3d", "version": 1, "text": SCENE}
    return {"method": types.TEXT_DOCUMENT_DID_OPEN, "params": {"textDocument": item}}


def _message(chance: random.Random, number: Iterator[int]) -> bytes:
    if chance.random() < 0.05:
        return _no_message(chance)
    method = chance.choice(METHODS)
    message: dict[str, Any] = {"method": method, "params": _params(method, chance)}
    if chance.random() < 0.6:
        damage(message["params"], chance, chance.choice((1, 1, 2, 5)))
    elif chance.random() < 0.1:
        message["params"] = chance.choice(ODD)
    # The second is the type of the answer, None for a notification.
    known: tuple[Any, ...] | None = types.METHOD_TO_TYPES.get(method)
    if known is None or known[1] is not None or chance.random() < 0.1:
        message["id"] = next(number) if chance.random() < 0.8 else str(next(number))
    return _framed(chance, message)


def _params(method: str, chance: random.Random) -> Any:
    if method in OWN:
        return json.loads(json.dumps(OWN[method]))
    kind = types.METHOD_TO_TYPES[method][2]
    return {} if kind is None else of_type(kind, chance)


def _no_message(chance: random.Random) -> bytes:
    content = chance.choice([
        b"", b"{", b"[" * 100_000, b"\xff\xfe", b'"jsonrpc"', b"null", b"[]", b"[1]", b"{}", b'{"id":NaN}',
        b'{"jsonrpc":"2.0"}', b'{"jsonrpc":"2.0","id":[],"method":"shutdown"}', b'{"jsonrpc":"1.0","method":"exit"}',
        b'{"jsonrpc":"2.0","id":null,"result":null}', b'{"jsonrpc":"2.0","method":7}',
    ])  # fmt: skip
    if chance.random() < 0.2:
        return chance.choice([b"\r\n", b"Content-Length: -5\r\n\r\n", b"Content-Type: x\r\n\r\n", b"no header\r\n"])
    return _with_headers(chance, content)


def _framed(chance: random.Random, message: dict[str, Any]) -> bytes:
    return _with_headers(chance, json.dumps({"jsonrpc": "2.0", **message}).encode())


def _with_headers(chance: random.Random, content: bytes) -> bytes:
    name = chance.choice([b"Content-Length", b"content-length", b"CONTENT-LENGTH"])
    headers = [name + chance.choice([b": ", b":", b" :\t "]) + b"%d" % len(content) + chance.choice([b"", b" \t"])]
    if chance.random() < 0.1:
        headers.append(b"Content-Type: application/vscode-jsonrpc; charset=utf8")
    if chance.random() < 0.1:
        headers.insert(0, b"X-Whatever: 1")
    return b"\r\n".join([*headers, b"", b""]) + content


def _is_enum(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, Enum)


def of_type(kind: Any, chance: random.Random, depth: int = 0) -> Any:
    """JSON of one of LSP's types, or of another where that says little."""
    origin, parts = typing.get_origin(kind), typing.get_args(kind)
    if kind is types.Position:
        return {"line": chance.randint(0, 6), "character": chance.randint(0, 50)}
    if _is_enum(kind):
        return chance.choice([*(member.value for member in kind)]) if chance.random() < 0.9 else chance.choice(ODD)
    if attrs.has(kind):
        likely = 0.8 if depth < 3 else 0.4
        return {
            _in_json(member.name): of_type(member.type, chance, depth + 1)
            for member in attrs.fields(kind)
            if member.default is attrs.NOTHING or chance.random() < likely
        }
    if origin is typing.Union:
        return of_type(chance.choice(parts), chance, depth)
    if origin is typing.Literal:
        return parts[0]
    if origin is not None and issubclass(origin, typing.Sequence) and depth < 12:
        return [of_type(parts[0], chance, depth + 1) for _ in range(chance.randint(0, 3))]
    simple: dict[Any, Callable[[], Any]] = {
        bool: lambda: chance.random() < 0.7,
        int: lambda: chance.randint(0, 30),
        float: chance.random,
        str: lambda: URI if chance.random() < 0.7 else chance.choice(TEXTS),
    }
    return simple[kind]() if kind in simple else chance.choice(ODD)


def _in_json(name: str) -> str:
    first, *rest = name.removesuffix("_").split("_")
    return first + "".join(part.title() for part in rest)


def damage(value: Any, chance: random.Random, times: int) -> None:
    """Take members away from JSON, or put something else in their place."""
    for _ in range(times):
        places = [(inner, key) for inner in _containers(value) for key in keys(inner)]
        if not places:
            return
        inner, key = chance.choice(places)
        if chance.random() < 0.3:
            del inner[key]
        else:
            inner[key] = json.loads(json.dumps(chance.choice(ODD)))


def _containers(value: Any) -> Iterator[Any]:
    if is_container(value):
        yield value
        for inner in values(value):
            yield from _containers(inner)


# --- what must hold ---------------------------------------------------------------------------------------------------


def numbers(data: bytes) -> list[int | str]:
    """The requests of a session that are owed an answer."""
    found: list[int | str] = []
    for content in _contents(data):
        try:
            message: Any = json.loads(content)
        except (ValueError, RecursionError):
            continue
        number = typing.cast("dict[str, Any]", message).get("id") if isinstance(message, dict) else None
        if isinstance(number, (int, str)) and "method" in message:
            found.append(number)
    return found


def _contents(data: bytes) -> Iterator[bytes]:
    while (at := data.lower().find(b"content-length")) >= 0:
        head, _, rest = data[at:].partition(b"\r\n\r\n")
        length = int(head.split(b"\r\n")[0].split(b":")[1])
        yield rest[: max(length, 0)]
        data = rest[max(length, 0) :]


def faults(data: bytes, answers: list[dict[str, Any]]) -> str | None:
    """What is wrong with the answers to a session."""
    owed = numbers(data)
    given = [answer["id"] for answer in answers if "method" not in answer and answer["id"] is not None]
    if sorted(map(repr, given)) != sorted(map(repr, owed)):
        missing = [number for number in owed if number not in given]
        return f"unanswered: {missing}; answered again: {[n for n in given if given.count(n) > 1]}"
    internal = types.ErrorCodes.InternalError.value
    for answer in answers:
        if answer.get("error", {}).get("code") == internal:
            return f"a fault of the server: {answer}"
    if "result" not in next(answer for answer in answers if answer.get("id") == 0):
        return "initialize was refused"
    return None


def check(data: bytes) -> str | None:
    heard = _Errors()
    logging.getLogger().addHandler(heard)
    try:
        answers = asyncio.run(_run(data))
    finally:
        logging.getLogger().removeHandler(heard)
    return faults(data, answers) or "\n".join(heard.messages) or None


class _Errors(logging.Handler):
    """What the server logs as a fault of its own."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.setFormatter(logging.Formatter())
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(self.format(record))


class _Answers:
    """What a server writes; it is finished when all that is owed has come."""

    def __init__(self, owed: int) -> None:
        self.messages: list[dict[str, Any]] = []
        self.finished = asyncio.Event()
        self._owed = owed

    def write(self, data: bytes) -> None:
        message = json.loads(data.partition(b"\r\n\r\n")[2])
        self.messages.append(message)
        self._owed -= "method" not in message and message["id"] is not None
        if self._owed <= 0:
            self.finished.set()

    def close(self) -> None:
        pass


async def _run(data: bytes) -> list[dict[str, Any]]:
    """What a server in this process says in a session."""
    reader = asyncio.StreamReader()
    reader.feed_data(data)
    server: Server = make_server()
    answers = _Answers(len(numbers(data)))
    server.protocol.set_writer(answers)
    attending = asyncio.create_task(server.attend(reader))
    with contextlib.suppress(TimeoutError):  # `faults` says what is missing
        await asyncio.wait_for(answers.finished.wait(), PATIENCE_S)
    reader.feed_eof()
    await attending
    server.shutdown()
    return answers.messages


run = repeating(make, check)
