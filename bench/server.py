"""Rows about the language server: what an edit costs until the diagnostics are there, then a hover and a completion.

The same client edits a number somewhere in a scene of 2,000 lines and in a text of as many lines that another server
knows, waits for the diagnostics of that edit, and asks for a hover and for what can stand there.
"""

from __future__ import annotations

import random
import re
import shutil
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from .lsp_client import Client
from .result import Aim, Result, middle
from .scenes import long
from .workshop import Workshop

EDITS = 100
WARM_UP = 10
ASKED = ("diagnostics", "hover", "completion")


class Subject(NamedTuple):
    """A server, and the text that it is given. `pull` is whether its diagnostics are asked for."""

    command: Sequence[str | Path]
    language: str
    text: str
    pull: bool = False


def small(shop: Workshop) -> list[Result]:
    """Ours beside openscad-lsp and the CSS server of VS Code, 2,000 lines each."""
    ours = _times(shop, "m3d", _ours(shop, long()))
    openscad = shutil.which("openscad-lsp")
    theirs = openscad and _times(shop, "openscad", Subject([openscad, "--stdio"], "openscad", _openscad()))
    results = [
        Result(
            f"server-{asked}",
            f"language server, 2,000 lines, an edit: {asked}",
            "openscad-lsp",
            "ms",
            middle(ours[asked]),
            middle(theirs[asked]) if theirs else None,
            Aim(1.0),
            f"of 100, half took no longer; ours {_spread(ours[asked])}{_theirs(theirs, asked)}",
            "`cargo install openscad-lsp`",
        )
        for asked in ASKED
    ]
    css = shutil.which("vscode-css-language-server")
    pulled = css and _times(shop, "css", Subject([css, "--stdio"], "css", _css(), pull=True))
    own = _times(shop, "m3d", _ours(shop, long(), pull=True))["diagnostics"]
    note = f"both are asked for them; ours {_spread(own)}{_theirs(pulled, 'diagnostics')}"
    work, missing = "the same, diagnostics asked for", "`npm install vscode-langservers-extracted`"
    theirs_pulled = middle(pulled["diagnostics"]) if pulled else None
    reference = "VS Code's CSS server"
    return [*results, Result("server-pull", work, reference, "ms", middle(own), theirs_pulled, None, note, missing)]


def large(shop: Workshop) -> list[Result]:
    """Ours alone, on a scene of 50,000 lines, and on one that holds a table of a million triangles."""
    results: list[Result] = []
    for name, text, says in (
        ("server-50k", long(2200), "a scene of {lines:,} lines"),
        ("server-terrain", shop.scene("terrain").read_text(), "the terrain, {megabytes:.0f} MB of text"),
    ):
        times = _times(shop, name, _ours(shop, text), edits=30)
        what = says.format(lines=text.count("\n"), megabytes=len(text) / 1e6)
        note = "; ".join(f"{asked} {_spread(times[asked])}" for asked in ASKED)
        results.append(
            Result(
                name,
                f"diagnostics after an edit, {what}",
                "–",
                "ms",
                middle(times["diagnostics"]),
                None,
                None,
                note,
                "–",
            )
        )
    return results


def _ours(shop: Workshop, text: str, *, pull: bool = False) -> Subject:
    return Subject([shop.command("m3d-lsp")], "m3d", text, pull)


def _times(shop: Workshop, name: str, subject: Subject, edits: int = EDITS) -> dict[str, list[float]]:
    """Milliseconds from an edit to its diagnostics, and from asking for a hover and for a completion to the answer."""
    uri = (shop.folder / f"edited.{subject.language}").as_uri()
    document = {"uri": uri, "languageId": subject.language, "version": 0, "text": subject.text}
    capabilities: dict[str, Any] = {"textDocument": {"diagnostic": {}} if subject.pull else {"publishDiagnostics": {}}}
    places = [match.span() for match in re.finditer(r"(?<=[ \[(])\d+(?=[ ,;)\]p])", subject.text)]
    chance = random.Random(1993)
    times: dict[str, list[float]] = {asked: [] for asked in ASKED}
    with Client(subject.command, shop.folder / f"{name}-server.log") as client:
        client.request("initialize", {"processId": None, "rootUri": None, "capabilities": capabilities})
        client.notify("initialized", {})
        # What comes of this is not waited for: openscad-lsp tells nothing of a text until it changes.
        client.notify("textDocument/didOpen", {"textDocument": document})
        text, version = subject.text, 0
        for number in range(WARM_UP + edits):
            start, end = chance.choice(places)
            for new in (str(chance.randint(1, 9)), subject.text[start:end]):
                version += 1
                change = {"range": _range(text, start, end), "text": new}
                text = text[:start] + new + text[end:]
                end = start + len(new)
                started = time.perf_counter()
                identifier = {"uri": uri, "version": version}
                client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]})
                found = [_diagnostics(client, uri, version, subject.pull) - started]
                where = {"textDocument": {"uri": uri}, "position": _position(text, text.rfind("\n", 0, start) + 6)}
                found += [client.timed(f"textDocument/{asked}", where)[1] for asked in ASKED[1:]]
            if number >= WARM_UP:
                for asked, seconds in zip(ASKED, found, strict=True):
                    times[asked].append(1000 * seconds)
    return times


def _diagnostics(client: Client, uri: str, version: int, pull: bool) -> float:
    """When the diagnostics of a version were there."""
    if pull:
        client.request("textDocument/diagnostic", {"textDocument": {"uri": uri}})
        return time.perf_counter()

    def published(message: dict[str, Any]) -> bool:
        params = message.get("params") or {}
        return message.get("method") == "textDocument/publishDiagnostics" and params.get("version", version) == version

    return client.wait(published).at


def _range(text: str, start: int, end: int) -> dict[str, Any]:
    return {"start": _position(text, start), "end": _position(text, end)}


def _position(text: str, offset: int) -> dict[str, int]:
    return {"line": text.count("\n", 0, offset), "character": offset - text.rfind("\n", 0, offset) - 1}


def _spread(times: Sequence[float]) -> str:
    ordered = sorted(times)
    return f"{middle(times):.1f} ms, 95 of 100 within {ordered[int(0.95 * len(ordered))]:.1f} ms"


def _theirs(times: dict[str, list[float]] | str | None, asked: str) -> str:
    return f"; theirs {_spread(times[asked])}" if isinstance(times, dict) else ""


def _openscad() -> str:
    """2,000 lines of OpenSCAD: modules of a few shapes each, and calls of them."""
    modules = [
        f"module part{n}(size = {n % 7 + 1}) {{\n  difference() {{\n    cube([ {n % 5 + 1} , size, 3 ]);\n"
        f"    translate([ 1 , {n % 9} , 2 ])\n      cylinder(h = 4 , r = 1 );\n  }}\n"
        f"  for (i = [0 : 3 ])\n    rotate([0, 0, i * 90 ])\n      sphere( {n % 4 + 1} );\n}}\n"
        for n in range(182)
    ]  # fmt: skip
    return "".join(f"{module}part{n}( {n % 6 + 1} );\n" for n, module in enumerate(modules))


def _css() -> str:
    """2,000 lines of CSS."""
    return "".join(
        f".part{n} > .inner{n} {{\n  margin: {n % 7 + 1}px {n % 5}px;\n  padding: 1px 2px;\n"
        f"  width: calc(100% - {n % 9 + 1}px);\n  color: rgb( {n % 255} , 20, 30);\n  line-height: 2 ;\n"
        f"  border: 1px solid red;\n  z-index: {n % 9} ;\n}}\n\n"
        for n in range(200)
    )
