"""Rows about the language server: what an edit costs until the diagnostics are there, then a hover and a completion.

The same client edits a number somewhere in a scene of 2,000 lines and in a text of as many lines that another server
knows, waits for the diagnostics of that edit, and asks for a hover and for what can stand there.
"""

from __future__ import annotations

import random
import re
import shutil
import time
from collections.abc import Generator, Sequence
from itertools import count, islice
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from .lsp_client import Client
from .result import Aim, Result, middle
from .scenes import long
from .workshop import Workshop

EDITS = 100
WARM_UP = 10
ASKED = ("diagnostics", "hover", "completion")

Times: TypeAlias = dict[str, list[float]]


class Subject(NamedTuple):
    """A server, and the text that it is given. `pull` is whether its diagnostics are asked for."""

    name: str
    command: Sequence[str | Path]
    language: str
    text: str
    pull: bool = False


def small(shop: Workshop) -> list[Result]:
    """Ours beside openscad-lsp and the CSS server of VS Code, 2,000 lines each, an edit of each in turn."""
    openscad, css = shutil.which("openscad-lsp"), shutil.which("vscode-css-language-server")
    ours, pulled, theirs, theirs_pulled = _times(
        shop,
        EDITS,
        _ours("m3d", long()),
        _ours("m3d-pulled", long(), pull=True),
        Subject("openscad", [openscad, "--stdio"], "openscad", _openscad()) if openscad else None,
        Subject("css", [css, "--stdio"], "css", _css(), pull=True) if css else None,
    )
    openscad_lsp = "openscad-lsp", "`cargo install openscad-lsp`"
    css_server = "VS Code's CSS server", "`npm install vscode-langservers-extracted`"
    return [
        *(
            _beside(
                f"server-{asked}", f"language server, 2,000 lines, an edit: {asked}", openscad_lsp, ours, theirs, asked
            )
            for asked in ASKED
        ),
        _beside("server-pull", "the same, diagnostics asked for", css_server, pulled, theirs_pulled, "diagnostics"),
    ]


def _beside(
    row: str, work: str, reference: tuple[str, str], ours: Times | None, theirs: Times | None, asked: str
) -> Result:
    """Our server beside another one, which is left out where it is not installed."""
    assert ours is not None
    own, other = ours[asked], theirs[asked] if theirs is not None else None
    note = f"of {EDITS} edits, half took no longer; ours {_spread(own)}{f'; theirs {_spread(other)}' if other else ''}"
    name, missing = reference
    return Result(row, work, name, "ms", middle(own), middle(other) if other else None, Aim(1.0), note, missing)


def large(shop: Workshop) -> list[Result]:
    """Ours alone, on a scene of 50,000 lines, and on one that holds a table of a million triangles."""
    results: list[Result] = []
    for name, text, says in (
        ("server-50k", long(2200), "a scene of {lines:,} lines"),
        ("server-terrain", shop.scene("terrain").read_text(), "the terrain, {megabytes:.0f} MB of text"),
    ):
        [times] = _times(shop, 30, _ours(name, text))
        assert times is not None
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


def _ours(name: str, text: str, *, pull: bool = False) -> Subject:
    return Subject(name, [Workshop.command("m3d-lsp")], "m3d", text, pull)


def _times(shop: Workshop, edits: int, *subjects: Subject | None) -> list[Times | None]:
    """Of each server, the milliseconds from each edit to its diagnostics, and from asking for a hover and for a
    completion to the answer. They take turns, so that a busy moment falls on all alike."""
    there = {subject.name: _edited(shop.folder, subject) for subject in subjects if subject is not None}
    rounds = list(islice(zip(*there.values(), strict=True), WARM_UP, WARM_UP + edits))
    for session in there.values():
        session.close()
    columns = dict(zip(there, zip(*rounds, strict=True), strict=True))
    return [
        None if subject is None else {asked: [times[asked] for times in columns[subject.name]] for asked in ASKED}
        for subject in subjects
    ]


def _edited(folder: Path, subject: Subject) -> Generator[dict[str, float]]:
    """Edits a text, again and again: what each edit took."""
    uri = (folder / f"edited.{subject.language}").as_uri()
    document = {"uri": uri, "languageId": subject.language, "version": 0, "text": subject.text}
    capabilities: dict[str, Any] = {"textDocument": {"diagnostic": {}} if subject.pull else {"publishDiagnostics": {}}}
    places = [match.span() for match in re.finditer(r"(?<=[ \[(])\d+(?=[ ,;)\]p])", subject.text)]
    chance = random.Random(1993)
    with Client(subject.command, folder / f"{subject.name}-server.log") as client:
        client.request("initialize", {"processId": None, "rootUri": None, "capabilities": capabilities})
        client.notify("initialized", {})
        # What comes of this is not waited for: openscad-lsp tells nothing of a text until it changes.
        client.notify("textDocument/didOpen", {"textDocument": document})
        text = subject.text
        for version in count(1, 2):
            start, end = chance.choice(places)
            changed = text[:start] + str(chance.randint(1, 9)) + text[end:]
            yield _edit(client, subject, uri, version, (text, changed), (start, end))
            _edit(client, subject, uri, version + 1, (changed, text), (start, start + 1))


def _edit(
    client: Client, subject: Subject, uri: str, version: int, texts: tuple[str, str], span: tuple[int, int]
) -> dict[str, float]:
    """One edit: what stands at `span` is replaced, which makes the second text of the first."""
    before, after = texts
    start, end = span
    new = after[start : len(after) - (len(before) - end)]
    change = {"range": {"start": _position(before, start), "end": _position(before, end)}, "text": new}
    identifier = {"uri": uri, "version": version}
    started = time.perf_counter()
    client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]})
    found = {"diagnostics": 1000 * (_diagnostics(client, uri, version, subject.pull) - started)}
    where = {"textDocument": {"uri": uri}, "position": _position(after, after.rfind("\n", 0, start) + 6)}
    for asked in ASKED[1:]:
        found[asked] = 1000 * client.timed(f"textDocument/{asked}", where)[1]
    return found


def _diagnostics(client: Client, uri: str, version: int, pull: bool) -> float:
    """When the diagnostics of a version were there."""
    if pull:
        client.request("textDocument/diagnostic", {"textDocument": {"uri": uri}})
        return time.perf_counter()

    def published(message: dict[str, Any]) -> bool:
        params: dict[str, Any] = message.get("params") or {}
        return message.get("method") == "textDocument/publishDiagnostics" and params.get("version", version) == version

    return client.wait(published).at


def _position(text: str, offset: int) -> dict[str, int]:
    return {"line": text.count("\n", 0, offset), "character": offset - text.rfind("\n", 0, offset) - 1}


def _spread(times: Sequence[float]) -> str:
    ordered = sorted(times)
    return f"{middle(times):.1f} ms, 95 of 100 within {ordered[int(0.95 * len(ordered))]:.1f} ms"


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
