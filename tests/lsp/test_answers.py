"""Every request is answered, whatever it holds and whatever its client is, and only `exit` ends the server."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Callable, Iterator
from threading import Thread, Timer
from typing import Any

import pytest

from fuzz import protocol as session

pytestmark = pytest.mark.slow

SERVER = [sys.executable, "-m", "m3d_lsp"]
PATIENCE_S = 30
URI = session.URI

NO_DIAGNOSTICS: dict[str, list[Any]] = {"diagnostics": []}
PARSE, REQUEST, METHOD, PARAMS = -32700, -32600, -32601, -32602
NOT_INITIALIZED, CONTENT_MODIFIED, FAILED = -32002, -32801, -32803


def framed(message: Any) -> bytes:
    body = json.dumps(message).encode()
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


def request(number: Any, method: str, params: Any = None) -> bytes:
    return framed({"jsonrpc": "2.0", "id": number, "method": method, "params": params})


def notification(method: str, params: Any = None) -> bytes:
    return framed({"jsonrpc": "2.0", "method": method, "params": params})


def initialize(capabilities: Any = None, **more: Any) -> bytes:
    return request(0, "initialize", {"processId": None, "rootUri": None, "capabilities": capabilities or {}, **more})


def opened(text: str = session.SCENE) -> bytes:
    item = {"uri": URI, "languageId": "m3d", "version": 1, "text": text}
    return notification("textDocument/didOpen", {"textDocument": item})


def changed(*changes: Any, version: Any = 2) -> bytes:
    identifier = {"uri": URI, "version": version}
    return notification("textDocument/didChange", {"textDocument": identifier, "contentChanges": list(changes)})


END = request("end", "shutdown") + notification("exit")


def read(output: bytes) -> Iterator[dict[str, Any]]:
    while output:
        head, _, rest = output.partition(b"\r\n\r\n")
        length = int(head.split(b":")[1])
        yield json.loads(rest[:length])
        output = rest[length:]


def told(sent: bytes, status: int = 0) -> list[dict[str, Any]]:
    """What a server says to some messages that it gets at once."""
    ran = subprocess.run(SERVER, input=sent, capture_output=True, timeout=PATIENCE_S, check=False)
    assert b"Traceback" not in ran.stderr, ran.stderr.decode()
    assert ran.returncode == status
    return list(read(ran.stdout))


class Talk:
    """A server that one talks with; `said` is what else it says than what is waited for."""

    def __init__(self, start: bytes = initialize()) -> None:
        self._process = subprocess.Popen(SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self._start = start
        self._patience = Timer(PATIENCE_S, self._process.kill)
        self._patience.start()
        self.said: list[dict[str, Any]] = []

    def __enter__(self) -> Talk:
        if self._start:
            self.ask(0, self._start)
        return self

    def __exit__(self, *error: object) -> None:
        with self._process as process:
            self._patience.cancel()
            if error[0] is not None:
                process.kill()
                return
            self.send(END)
            process.communicate(timeout=PATIENCE_S)
            assert process.returncode == 0

    def send(self, data: bytes) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(data)
        self._process.stdin.flush()

    def ask(self, number: Any, data: bytes) -> Any:
        """Send a request; its result, or the code of its error."""
        self.send(data)
        answer = self.answer(number)
        return answer["result"] if "result" in answer else answer["error"]["code"]

    def answer(self, number: Any) -> dict[str, Any]:
        """The answer to a request."""
        return self._find(lambda message: "method" not in message and message["id"] == number)

    def asked(self, method: str) -> dict[str, Any]:
        """What the server asks, or has asked."""
        return self._find(lambda message: message.get("method") == method)

    def text(self) -> Any:
        """What the server takes the document's text for, by its syntax tree; or the code of the error."""
        answer = self.ask("text", request("text", "m3d/syntaxTree", {"textDocument": {"uri": URI}}))
        return answer if isinstance(answer, int) else " ".join(node["description"] for node in answer["nodes"])

    def _find(self, wanted: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        found = next(filter(wanted, self.said), None)
        if found is not None:
            self.said.remove(found)
            return found
        while (message := self._next()) is not None:
            if wanted(message):
                return message
            self.said.append(message)
        raise EOFError

    def _next(self) -> dict[str, Any] | None:
        output = self._process.stdout
        assert output is not None
        head = output.readline()
        if not head:
            return None
        output.readline()
        return json.loads(output.read(int(head.split(b":")[1])))


# --- what a client says of itself -------------------------------------------------------------------------------------


NOT_UNDERSTOOD: list[Any] = [
    {"textDocument": {"documentSymbol": {"symbolKind": {"valueSet": [1, 2, 999]}}}},
    {"textDocument": {"publishDiagnostics": {"tagSupport": {"valueSet": [1, 99]}}}},
    {"textDocument": {"completion": {"completionItem": {"tagSupport": {"valueSet": None}}}}},
    {"textDocument": {"completion": {"completionItem": {"documentationFormat": ["asciidoc", "markdown"]}}}},
    {"textDocument": {"codeAction": {"codeActionLiteralSupport": {}}}},
    {"textDocument": {"codeAction": {"codeActionLiteralSupport": None}}},
    {"textDocument": {"semanticTokens": {"formats": ["absolute"]}}},
    {"textDocument": {"foldingRange": {"foldingRangeKind": {"valueSet": "all"}}}},
    {"textDocument": None, "workspace": None, "general": None, "window": None},
    {"workspace": {"workspaceEdit": {"failureHandling": "hope"}}},
    {"general": {"positionEncodings": ["utf-7", 8, {}, None]}},
    {"general": {"positionEncodings": None, "markdown": {}}},
    {"textDocument": [], "workspace": "yes", "experimental": 1993},
    None,
    [],
]


def test_capabilities_that_are_not_understood_are_not_there() -> None:
    for capabilities in NOT_UNDERSTOOD:
        params = {"processId": "none", "capabilities": capabilities, "trace": "everything"}
        data = request(0, "initialize", params) + notification("initialized", {}) + opened()
        assert (capabilities, session.check(data)) == (capabilities, None)


def test_what_a_client_can_not_show_is_not_sent() -> None:
    """One that has said nothing of itself."""
    with Talk() as talk:
        talk.send(opened(session.SCENE.replace("size;", "size, spare;")))
        document = {"textDocument": {"uri": URI}}
        place = {**document, "position": {"line": 3, "character": 9}}
        symbols = talk.ask(1, request(1, "textDocument/documentSymbol", document))
        assert [(each["name"], each.get("containerName")) for each in symbols][:2] == [
            ("VARIABLES", None),
            ("size", "VARIABLES"),
        ]
        (solid,) = (each for each in symbols if each["name"] == "SOLID")
        assert solid["containerName"] == "SPHERE, red"
        assert {each["kind"] for each in symbols} <= set(range(1, 19))
        assert {each["location"]["uri"] for each in symbols} == {URI}
        found = talk.ask(2, request(2, "workspace/symbol", {"query": ""}))
        assert {each["kind"] for each in found} <= set(range(1, 19))
        range_ = {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}}
        actions = {**document, "range": range_, "context": NO_DIAGNOSTICS}
        assert talk.ask(3, request(3, "textDocument/codeAction", actions)) == []
        assert talk.ask(4, request(4, "textDocument/codeLens", document)) == []
        hover = talk.ask(5, request(5, "textDocument/hover", place))
        assert hover["contents"]["kind"] == "plaintext"
        completion = talk.ask(6, request(6, "textDocument/completion", place))["items"]
        assert completion
        for item in completion:
            assert item["kind"] in range(1, 19)
            assert item.get("insertTextFormat", 1) == 1
            assert "insert" not in item["textEdit"]
        published = talk.asked("textDocument/publishDiagnostics")["params"]["diagnostics"]
        assert published
        assert not {"relatedInformation", "tags", "codeDescription"} & {key for each in published for key in each}
        assert not [message for message in talk.said if message.get("method") != "textDocument/publishDiagnostics"]


def test_no_more_folds_than_a_client_takes() -> None:
    """The outermost."""
    text = "SOLID {\n  SPHERE {\n  RADIUS 2\n  }\n}\nLIGHT {\n  SOURCE {\n  FROM < 0, 0, 9 >\n  }\n\n}\n"
    every = [(0, 4), (1, 3), (5, 10), (6, 8)]
    limits: list[tuple[Any, list[tuple[int, int]]]] = [(3, every[:3]), (0, []), (5000, every), (-1, every)]
    for limit, expected in limits:
        capabilities = {"textDocument": {"foldingRange": {"rangeLimit": limit, "lineFoldingOnly": True}}}
        with Talk(initialize(capabilities)) as talk:
            talk.send(opened(text))
            folds = talk.ask(1, request(1, "textDocument/foldingRange", {"textDocument": {"uri": URI}}))
            assert (limit, [(fold["startLine"], fold["endLine"]) for fold in folds]) == (limit, expected)


def test_what_a_client_shows_of_diagnostics_that_it_asks_for() -> None:
    """It may say so where it says that it asks, or where it says what it takes when told."""
    shows = {"relatedInformation": True, "codeDescriptionSupport": True, "tagSupport": {"valueSet": [1]}}
    unused = "VARIABLES { SPHERE a; } a = { } SCENE { SKY { } SKY { } }\n"
    document = {"textDocument": {"uri": URI}}
    said: tuple[dict[str, Any], ...] = (
        {"diagnostic": shows},
        {"diagnostic": {}, "publishDiagnostics": shows},
        {"diagnostic": {}},
    )
    for capabilities in said:
        with Talk(initialize({"textDocument": capabilities})) as talk:
            talk.send(opened(unused))
            found = talk.ask(1, request(1, "textDocument/diagnostic", document))["items"]
            members = {"relatedInformation", "codeDescription", "tags"} & {key for each in found for key in each}
            assert len(members) == (3 if shows in capabilities.values() else 0)
            assert not talk.said


def test_a_document_opened_again_with_another_text_has_its_own_diagnostics() -> None:
    document = {"textDocument": {"uri": URI}}
    with Talk(initialize({"textDocument": {"diagnostic": {}}})) as talk:
        talk.send(opened("SOLID { SPHERE { } }\n"))
        first = talk.ask(1, request(1, "textDocument/diagnostic", document))
        again = {**document, "previousResultId": first["resultId"]}
        assert talk.ask(2, request(2, "textDocument/diagnostic", again))["kind"] == "unchanged"
        talk.send(notification("textDocument/didClose", document) + opened("SOLID { SPHERE }\n"))
        other = talk.ask(3, request(3, "textDocument/diagnostic", again))
        assert (other["kind"], [each["severity"] for each in other["items"]]) == ("full", [1])


def test_commands_in_place_of_actions() -> None:
    with Talk(initialize({"workspace": {"applyEdit": True}})) as talk:
        talk.send(opened("SOLID { SPHERE { RADIUS size } }\n"))
        range_ = {"start": {"line": 0, "character": 26}, "end": {"line": 0, "character": 26}}
        actions = {"textDocument": {"uri": URI}, "range": range_, "context": NO_DIAGNOSTICS}
        found = talk.ask(1, request(1, "textDocument/codeAction", actions))
        command = next(each for each in found if "eclare" in each["title"])
        assert command["command"] == "m3d.applyEdit"
        chosen = {"command": command["command"], "arguments": command["arguments"]}
        talk.send(request(2, "workspace/executeCommand", chosen))
        asked = talk.asked("workspace/applyEdit")
        (edit,) = asked["params"]["edit"]["changes"][URI]
        assert "size" in edit["newText"]
        talk.send(framed({"jsonrpc": "2.0", "id": asked["id"], "result": {"applied": True}}))
        assert talk.answer(2)["result"] is None
        talk.send(changed({"text": "/* another text */"}))
        assert talk.ask(3, request(3, "workspace/executeCommand", chosen)) == FAILED
        for arguments in (None, [], [1, 2, 3], [URI, 1, {"changes": 5}]):
            wrong = {"command": command["command"], "arguments": arguments}
            assert talk.ask(4, request(4, "workspace/executeCommand", wrong)) == PARAMS


@pytest.mark.parametrize("seeds", [range(first, first + 100) for first in range(0, 500, 100)], ids=str)
def test_500_clients_that_nobody_has_thought_of(seeds: range) -> None:
    """In this process, each with a server of its own."""
    for seed in seeds:
        data = session.session(random.Random(seed), 3)
        assert (seed, session.check(data)) == (seed, None)


@pytest.mark.parametrize("seed", range(4))
def test_2000_messages_that_nobody_has_thought_of(seed: int) -> None:
    """In a server as it is started: 500 at once."""
    data = session.session(random.Random(seed), 500)
    with Talk(b"") as talk:
        writing = Thread(target=talk.send, args=(data + b"\r\n",))
        writing.start()
        given = [talk.answer(number) for number in session.numbers(data)]
        writing.join()
        assert session.faults(data, given) is None


# --- the life of a server ---------------------------------------------------------------------------------------------


def test_nothing_is_answered_before_initialize_and_after_shutdown() -> None:
    hover = {"textDocument": {"uri": URI}, "position": {"line": 0, "character": 0}}
    early = request("early", "textDocument/hover", hover) + request("early end", "shutdown") + opened()
    late = request("late", "textDocument/hover", hover) + request("late start", "initialize", {"capabilities": {}})
    sent = early + initialize() + initialize() + request("end", "shutdown") + late + notification("exit")
    given = told(sent)
    codes = [(each["id"], each.get("error", {}).get("code")) for each in given]
    assert codes == [
        ("early", NOT_INITIALIZED),
        ("early end", NOT_INITIALIZED),
        (0, None),
        (0, REQUEST),
        ("end", None),
        ("late", REQUEST),
        ("late start", REQUEST),
    ]


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (initialize() + END, 0),
        (initialize() + request("end", "shutdown"), 0),  # and the input ends
        (initialize() + notification("exit"), 1),
        (notification("exit", ["now"]), 1),
        (initialize(), 1),
        (b"", 1),
    ],
)
def test_the_status_tells_whether_it_was_shut_down(sent: bytes, status: int) -> None:
    told(sent, status)


@pytest.mark.skipif(sys.platform == "win32", reason="it is started by a shell")
def test_it_ends_with_the_process_of_its_client() -> None:
    with subprocess.Popen(["sleep", "1000"]) as client, subprocess.Popen(
        SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as server:  # fmt: skip
        assert server.stdin is not None
        assert server.stdout is not None
        server.stdin.write(initialize(processId=client.pid))
        server.stdin.flush()
        server.stdout.readline()
        client.kill()
        client.wait()
        assert server.wait(PATIENCE_S) == 1


def test_a_process_that_can_not_be_seen_is_not_waited_for() -> None:
    assert told(initialize(processId=1 << 40) + END)[-1]["id"] == "end"


# --- messages that are none -------------------------------------------------------------------------------------------


REFUSED: list[tuple[bytes, Any, int]] = [
    (b"", None, PARSE),
    (b"{", None, PARSE),
    (b"\xff", None, PARSE),
    (b"[" * 100_000, None, PARSE),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "shutdown", "params": NaN}', None, PARSE),
    (b"1993", None, REQUEST),
    (b"[]", None, REQUEST),
    (b'[{"jsonrpc": "2.0", "id": 7, "method": "shutdown"}, {"jsonrpc": "2.0", "method": "exit"}]', 7, REQUEST),
    (b'{"id": 1, "method": "shutdown"}', 1, REQUEST),
    (b'{"jsonrpc": "1.0", "id": 1, "method": "shutdown"}', 1, REQUEST),
    (b'{"jsonrpc": "2.0", "id": 1, "method": 5}', 1, REQUEST),
    (b'{"jsonrpc": "2.0", "id": 1}', 1, REQUEST),
    (b'{"jsonrpc": "2.0", "id": null, "method": "shutdown"}', None, REQUEST),
    (b'{"jsonrpc": "2.0", "id": {}, "method": "shutdown"}', None, REQUEST),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "m3d/unheardOf"}', 1, METHOD),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "$/unheardOf"}', 1, METHOD),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "textDocument/didOpen"}', 1, METHOD),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "exit"}', 1, METHOD),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "textDocument/hover"}', 1, PARAMS),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "textDocument/hover", "params": [1]}', 1, PARAMS),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "m3d/dump", "params": [1]}', 1, PARAMS),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "m3d/dump", "params": {"textDocument": {"uri": 5}}}', 1, PARAMS),
    (b'{"jsonrpc": "2.0", "id": 1, "method": "codeAction/resolve", "params": {"title": "x"}}', 1, PARAMS),
]


def test_what_can_not_be_answered_is_refused() -> None:
    with Talk() as talk:
        for content, number, code in REFUSED:
            message = b"Content-Length: %d\r\n\r\n%b" % (len(content), content)
            assert (content, talk.ask(number, message)) == (content, code)


HEADERS = [
    b"content-length: %d\r\n",
    b"CONTENT-LENGTH:%d\r\n",
    b"Content-Length \t:  %d \t\r\n",
    b"Content-Length: %d\n",
    b"\r\n\r\nContent-Length: %d\r\n",
    b"Content-Length: %d\r\nContent-Length: %d\r\n",
    b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\nContent-Length: %d\r\n",
    b"Content-Length: %d\r\nContent-Type: application/vscode-jsonrpc; charset=utf8\r\n",
    b'Content-Length: %d\r\nCONTENT-TYPE: x/y;CharSet="UTF-8"\r\n',
    b"Date: never\r\nX-Empty:\r\nContent-Length: %d\r\n",
]


def test_headers_are_those_of_http() -> None:
    with Talk() as talk:
        for number, headers in enumerate(HEADERS, 1):
            message = {"jsonrpc": "2.0", "id": number, "method": "workspace/symbol", "params": {"query": "x"}}
            body = json.dumps(message).encode()
            assert talk.ask(number, headers.replace(b"%d", b"%d" % len(body)) + b"\r\n" + body) == []


NO_MESSAGES = [
    (b"no header at all\r\n", False),
    (b"{}", False),
    (b"x" * 200_000 + b"\r\n", False),
    (b"Content-Length: -5\r\n\r\n", True),
    (b"Content-Length: 5\r\nContent-Length: 6\r\n\r\n", True),
    (b"Content-Type: x\r\n\r\n", True),
    (b"Content-Length: 2\r\nContent-Type: x; charset=utf-16\r\n\r\n{}", True),
]


def test_what_is_no_message_costs_what_it_covers() -> None:
    with Talk() as talk:
        for between, refused in NO_MESSAGES:
            talk.send(between)
            assert talk.ask(1, request(1, "workspace/symbol", {"query": "x"})) == []
            errors = [message["error"]["code"] for message in talk.said if message.get("id", "") is None]
            assert (between, errors) == (between, [REQUEST] if refused else [])
            talk.said.clear()


# --- documents --------------------------------------------------------------------------------------------------------


def place(line: Any, character: Any) -> dict[str, Any]:
    return {"line": line, "character": character}


CHANGES: list[tuple[Any, str]] = [
    ({"text": "/* 3 */"}, "/* 3 */"),
    ({"range": None, "text": "/* 3 */"}, "/* 3 */"),
    ({"range": {"start": place(0, 3), "end": place(0, 4)}, "text": "3"}, "/* 3 */ /* 2 */"),
    ({"range": {"start": place(0, 3), "end": place(0, 4)}, "text": "3", "rangeLength": "x"}, "/* 3 */ /* 2 */"),
    ({"range": {"start": place(0, 4), "end": place(0, 3)}, "text": "3"}, "/* 3 */ /* 2 */"),
    ({"range": {"start": place(0, 3.0), "end": place(0, 4.0)}, "text": "3"}, "/* 3 */ /* 2 */"),
    ({"range": {"start": place(-1, -9), "end": place(0, 4)}, "text": "/* 3"}, "/* 3 */ /* 2 */"),
    ({"range": {"start": place(0, 3), "end": place(0, 1 << 40)}, "text": "3 */"}, "/* 3 */ /* 2 */"),
    ({"range": {"start": place(1, 0), "end": place(1 << 40, 9)}, "text": "/* 3 */"}, "/* 1 */ /* 3 */"),
]


def test_a_change_is_made_where_it_can_be() -> None:
    with Talk() as talk:
        for change, text in CHANGES:
            talk.send(opened("/* 1 */\n/* 2 */") + changed(change))
            assert (change, talk.text()) == (change, text)
        assert not [message for message in talk.said if message.get("method") == "window/showMessage"]


NO_CHANGES: list[Any] = [
    {},
    {"text": None},
    {"text": 5},
    {"range": {}, "text": "x"},
    {"range": {"start": place(0, 0)}, "text": "x"},
    {"range": {"start": place(0, "x"), "end": place(0, 1)}, "text": "x"},
    {"range": {"start": place(0, 0.5), "end": place(0, 1)}, "text": "x"},
    "x",
    None,
]


def test_a_change_that_can_not_be_read_is_told() -> None:
    small = {"range": {"start": place(0, 3), "end": place(0, 4)}, "text": "3"}
    with Talk() as talk:
        for change in NO_CHANGES:
            talk.send(opened("/* 1 */") + changed(change, small))
            assert (change, talk.text()) == (change, CONTENT_MODIFIED)
            shown = talk.asked("window/showMessage")["params"]["message"]
            assert "changed scene.m3d in a way that the language server could not read" in shown
            talk.send(changed(small, version=3))  # this may be in the wrong place
            assert talk.text() == CONTENT_MODIFIED
            talk.send(changed({"text": "/* 2 */"}, small, version=4))
            assert talk.text() == "/* 3 */"
            talk.send(changed(change, version=5) + opened("/* 4 */"))
            assert talk.text() == "/* 4 */"
            talk.said.clear()


def test_a_document_of_which_nothing_was_heard_is_not_made_up() -> None:
    small = {"range": {"start": place(0, 3), "end": place(0, 4)}, "text": "3"}
    with Talk() as talk:
        talk.send(changed(small))
        assert talk.text() == CONTENT_MODIFIED
        talk.send(changed({"text": "/* 1 */"}, small))
        assert talk.text() == "/* 3 */"
        talk.send(notification("textDocument/didClose", {"textDocument": {"uri": URI}}))
        assert talk.text() == PARAMS  # it is not open


def test_tokens_are_of_the_text_that_they_were_asked_for() -> None:
    """An editor moves them by what was typed since: those of a later text would be moved twice."""
    document = {"textDocument": {"uri": URI}}
    range_ = {"start": place(0, 0), "end": place(9, 0)}
    with Talk() as talk:
        talk.send(opened("SOLID { SPHERE { } }\n" * 9))
        asked = request(1, "textDocument/semanticTokens/full", document)
        asked += request(2, "textDocument/semanticTokens/range", {**document, "range": range_})
        talk.send(asked + changed({"text": "SOLID { }"}))
        for answer in (talk.answer(1), talk.answer(2)):
            if "error" in answer:  # unless it was ready when it was asked for
                assert answer["error"]["code"] == CONTENT_MODIFIED
            else:
                assert len(answer["result"]["data"]) == 9 * 2 * 5
        assert len(talk.ask(3, request(3, "textDocument/semanticTokens/full", document))["data"]) == 5


def test_a_large_document_keeps_a_small_one_from_nothing() -> None:
    large = {"uri": "file:///nowhere/large.m3d", "languageId": "m3d", "version": 1}
    large["text"] = "SOLID { SPHERE { RADIUS 1 } }\n" * 20_000
    with Talk() as talk:
        talk.send(notification("textDocument/didOpen", {"textDocument": large}) + opened())
        hover = {"textDocument": {"uri": URI}, "position": place(3, 10)}
        assert talk.ask(1, request(1, "textDocument/hover", hover))
        first = talk.asked("textDocument/publishDiagnostics")
        assert first["params"]["uri"] == URI


# --- the server's own questions ---------------------------------------------------------------------------------------


def test_an_answer_that_can_not_be_read_keeps_nobody_waiting() -> None:
    with Talk(initialize({"workspace": {"configuration": True}})) as talk:
        for answer in ({"result": 5}, {"error": 5}, {"error": {"code": 1, "message": "no"}}, {"result": [None]}, {}):
            talk.send(notification("workspace/didChangeConfiguration", {"settings": None}))
            asked = talk.asked("workspace/configuration")
            # Somebody else's numbers change nothing.
            talk.send(framed({"jsonrpc": "2.0", "id": "unheard of", "result": 1}))
            talk.send(framed({"jsonrpc": "2.0", "id": asked["id"], "result": None} | answer))
        talk.send(notification("workspace/didChangeConfiguration", {"settings": None}))
        asked = talk.asked("workspace/configuration")
        talk.send(framed({"jsonrpc": "2.0", "id": asked["id"], "result": [{"codeLens": {"enabled": False}}]}))
        talk.send(opened())
        assert talk.ask(1, request(1, "textDocument/codeLens", {"textDocument": {"uri": URI}})) == []
