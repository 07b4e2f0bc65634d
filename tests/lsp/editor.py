"""An editor as the tests use it: scenes with marks for the cursor, opened in the server.

SOLID { SPH$0ERE { } }          `$0` is the cursor; a scene may have several, `$1`, `$2`, ...
SOLID { $[SPHERE$] { } }        `$[` and `$]` are the ends of a range
"""

from __future__ import annotations

import asyncio
import functools
import itertools
import re
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any, NamedTuple, TypedDict, TypeVar, cast

from cattrs import Converter
from lsprotocol import types
from pygls.protocol import default_converter
from pygls.protocol.json_rpc import JsonRPCNotification, JsonRPCResponseMessage
from pytest_lsp import LanguageClient
from pytest_lsp.client import register_lsp_features

T = TypeVar("T")

_NUMBERS = itertools.count(1)
_MARK = re.compile(r"\$(\d|\[|\])")


class Marked(NamedTuple):
    """A text without its marks, and where they stood: line and character, in characters of the text."""

    text: str
    places: dict[str, types.Position]

    def range(self) -> types.Range:
        return types.Range(self.places["["], self.places["]"])


def read_marks(marked: str) -> Marked:
    """The text of a scene, and the places that are marked in it."""
    text, places, end = "", {}, 0
    for match in _MARK.finditer(marked):
        text += marked[end : match.start()]
        places[match[1]] = position(text, len(text))
        end = match.end()
    return Marked(text + marked[end:], places)


def position(text: str, index: int) -> types.Position:
    """Where a character of a text stands, as UTF-32 counts."""
    line = text.count("\n", 0, index)
    return types.Position(line, index - (text.rfind("\n", 0, index) + 1))


def apply(text: str, edits: Sequence[types.TextEdit]) -> str:
    """A text with edits made, which may not overlap; those that begin at one place come in their order."""
    starts = list(itertools.accumulate((len(line) + 1 for line in text.split("\n")), initial=0))
    parts: list[str] = []
    done = 0
    for edit in sorted(edits, key=lambda edit: (edit.range.start.line, edit.range.start.character)):
        start, end = (starts[place.line] + place.character for place in (edit.range.start, edit.range.end))
        assert done <= start <= end <= len(text)
        parts += [text[done:start], edit.new_text]
        done = end
    return "".join([*parts, text[done:]])


class At(TypedDict):
    """The parameters of a request about a place."""

    text_document: types.TextDocumentIdentifier
    position: types.Position


class Scene(NamedTuple):
    """An open document."""

    uri: str
    text: str
    places: dict[str, types.Position]

    @property
    def identifier(self) -> types.TextDocumentIdentifier:
        return types.TextDocumentIdentifier(self.uri)

    @property
    def cursor(self) -> types.Position:
        return self.places["0"]

    @property
    def range(self) -> types.Range:
        return types.Range(self.places["["], self.places["]"])

    def at(self, mark: str = "0") -> At:
        """The parameters of a request about a place."""
        return {"text_document": self.identifier, "position": self.places[mark]}

    def part(self, range_: types.Range) -> str:
        """What a text holds in a range; only for texts of ASCII."""
        starts = list(itertools.accumulate((len(line) for line in self.text.splitlines(keepends=True)), initial=0))
        start, end = (starts[p.line] + p.character for p in (range_.start, range_.end))
        return self.text[start:end]


# What the extension for VS Code says that it has.
OURS = {"m3d": {"commands": ["m3d.preview", "m3d.render", "m3d.dump", "m3d.showReferences"], "analysed": True}}
OWN_NOTIFICATIONS = ("m3d/analysed", "m3d/preview/tile")


def simple(value: Any) -> Any:
    """JSON with attributes for keys. pygls makes a class for every object in it, which takes long for large answers."""
    if isinstance(value, dict):
        return SimpleNamespace(**{key: simple(each) for key, each in cast(dict[str, Any], value).items()})
    return [simple(each) for each in cast(list[Any], value)] if isinstance(value, list) else value


def converter() -> Converter:
    """How messages become objects: as pygls does it, but for those that LSP does not know."""
    made = default_converter()
    for kind, part in ((JsonRPCResponseMessage, "result"), (JsonRPCNotification, "params")):
        made.register_structure_hook(kind, lambda given, kind, part=part: kind(**given | {part: simple(given[part])}))
    return made


class SceneClient(LanguageClient):
    """A client that keeps what the server sends unasked: the last diagnostics of each document, and all notifications
    of our own, by method."""

    def __init__(self) -> None:
        super().__init__(converter_factory=converter)  # pyright: ignore[reportUnknownMemberType]  of no type in pygls
        self.published: dict[str, types.PublishDiagnosticsParams] = {}
        self.notified: dict[str, list[Any]] = {}
        self._news = asyncio.Event()
        register_lsp_features(self)
        features = cast(dict[str, Any], self.protocol.fm.features)  # pyright: ignore[reportUnknownMemberType]
        # In place of what pytest_lsp has for it, which forgets versions.
        features[types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS] = self._publish
        for method in OWN_NOTIFICATIONS:
            self.feature(method)(functools.partial(self._notify, method))
        for kind in ("diagnostic", "inlayHint", "codeLens"):
            features[f"workspace/{kind}/refresh"] = _nothing

    def _publish(self, params: types.PublishDiagnosticsParams) -> None:
        self.published[params.uri] = params
        self.diagnostics[params.uri] = params.diagnostics
        self._news.set()

    def _notify(self, method: str, params: Any) -> None:
        self.notified.setdefault(method, []).append(params)
        self._news.set()

    async def wait_until(self, look: Callable[[], T | None], seconds: float = 20) -> T:
        """What `look` finds, once it finds something; it looks again at every notification."""
        async with asyncio.timeout(seconds):
            while (found := look()) is None:
                self._news.clear()
                await self._news.wait()
        return found


def _nothing(*_: object) -> None:
    """A client that asks for nothing anew."""


class Editor:
    """Opens, changes and closes documents in a server."""

    def __init__(self, client: SceneClient) -> None:
        self.client = client
        self._open: dict[str, int] = {}

    def open(self, marked: str, name: str = "scene", uri: str = "") -> Scene:
        """Open a scene, without a URI under a name that no other has."""
        text, places = read_marks(marked)
        uri = uri or f"file:///scenes/{name}-{next(_NUMBERS)}.m3d"
        item = types.TextDocumentItem(uri, "m3d", 1, text)
        self.client.text_document_did_open(types.DidOpenTextDocumentParams(item))
        self._open[uri] = 1
        return Scene(uri, text, places)

    def change(self, scene: Scene, *changes: types.TextDocumentContentChangeEvent) -> int:
        """Edit a scene; returns its new version."""
        self._open[scene.uri] += 1
        version = self._open[scene.uri]
        identifier = types.VersionedTextDocumentIdentifier(version, scene.uri)
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(identifier, list(changes)))
        return version

    def replace(self, scene: Scene, marked: str) -> Scene:
        """Put another text in place of all of a scene's."""
        text, places = read_marks(marked)
        self.change(scene, types.TextDocumentContentChangeWholeDocument(text))
        return Scene(scene.uri, text, places)

    async def configure(self, scene: Scene, settings: dict[str, object]) -> None:
        """Change the settings under `m3d`, and wait until the scene has been looked at with them."""
        await self.client.wait_until(lambda: self._analysed(scene) or None)
        before = len(self._analysed(scene))
        self.client.set_configuration(settings, section="m3d")
        self.client.workspace_did_change_configuration(types.DidChangeConfigurationParams(settings=None))
        await self.client.wait_until(lambda: len(self._analysed(scene)) > before or None)

    def _analysed(self, scene: Scene) -> list[Any]:
        """What the server said when it had looked at the newest version."""
        news = self.client.notified.get("m3d/analysed", [])
        return [each for each in news if (each.uri, each.version) == (scene.uri, self._open[scene.uri])]

    async def diagnostics(self, scene: Scene) -> list[types.Diagnostic]:
        """The diagnostics of the newest version, which the server sends unasked."""
        published = await self.client.wait_until(lambda: self._published(scene.uri, self._open[scene.uri]))
        return list(published.diagnostics)

    def _published(self, uri: str, version: int) -> types.PublishDiagnosticsParams | None:
        last = self.client.published.get(uri)
        return last if last is not None and last.version == version else None

    def close(self) -> None:
        for uri in self._open:
            self.client.text_document_did_close(types.DidCloseTextDocumentParams(types.TextDocumentIdentifier(uri)))
        self._open = {}
