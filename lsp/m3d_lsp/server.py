"""The server: keeps the documents, asks the features, and speaks to the client."""

from __future__ import annotations

import asyncio
import inspect
import logging
import pkgutil
from collections.abc import Awaitable, Callable
from importlib import import_module
from importlib.metadata import version
from threading import Event
from typing import Any, BinaryIO, cast

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from . import feature, standard_io, view
from .document import Document
from .documents import Documents
from .feature import diagnostics
from .preview.previews import Previews
from .protocol import Protocol
from .registry import REQUESTS, SERVER_REQUESTS, RefusalError, Request, ServerRequest
from .settings import read_settings
from .snapshot import Snapshot

log = logging.getLogger(__name__)

SECTION = "m3d"


class Server(LanguageServer):
    """A language server for scenes. `documents` are the open ones, `previews` the pictures of them."""

    def __init__(self) -> None:
        super().__init__("m3d-lsp", version("m3d-lsp"), protocol_cls=Protocol)  # pyright: ignore[reportUnknownMemberType]
        self.documents = Documents(self._looked_at)
        self.previews = Previews()

    def start_io(self, stdin: BinaryIO | None = None, stdout: BinaryIO | None = None) -> None:
        """Talk over standard input and output until the client leaves."""
        if stdin is not None or stdout is not None or not standard_io.can_wait():
            super().start_io(stdin, stdout)
            return
        self._stop_event = Event()
        try:
            asyncio.run(standard_io.talk(self.protocol, self._stop_event))
        except BrokenPipeError:
            log.error("the client does not listen any more")
        except (KeyboardInterrupt, SystemExit):
            pass
        finally:
            self.shutdown()

    def shutdown(self) -> None:
        self.previews.stop()
        self.documents.stop()
        super().shutdown()

    @property
    def pulls(self) -> bool:
        """Whether the client asks for diagnostics itself."""
        document = self.client_capabilities.text_document
        return document is not None and document.diagnostic is not None

    def tell(self, message: str, kind: types.MessageType = types.MessageType.Error) -> None:
        """Write to the client's log."""
        self.window_log_message(types.LogMessageParams(kind, message))

    def _looked_at(self, document: Document, snapshot: Snapshot) -> None:
        if not self.pulls:
            self.text_document_publish_diagnostics(
                types.PublishDiagnosticsParams(document.uri, diagnostics.of(snapshot), snapshot.version)
            )
        analysed = {"uri": document.uri, "version": snapshot.version, "ok": snapshot.analysis.ok}
        self.protocol.notify("m3d/analysed", analysed)

    def forget(self, uri: str) -> None:
        """A document was closed: nothing is wrong with it any more."""
        if not self.pulls:
            self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, []))

    @property
    def can_ask_for_settings(self) -> bool:
        workspace = self.client_capabilities.workspace
        return workspace is not None and bool(workspace.configuration)

    async def fetch_settings(self) -> None:
        """Ask the client for the settings, if it can be asked."""
        if not self.can_ask_for_settings:
            return
        item = types.ConfigurationItem(section=SECTION)
        answer = await self.workspace_configuration_async(types.ConfigurationParams([item]))
        self.apply_settings(answer[0] if answer else None)

    def apply_settings(self, given: Any) -> None:
        """Take over settings in the editor's form."""
        settings, problems = read_settings(given)
        for problem in problems:
            self.tell(problem, types.MessageType.Warning)
        if settings != self.documents.settings:
            self.documents.set(settings)
            self._refresh()

    def _refresh(self) -> None:
        """Have the client ask anew for what depends on settings."""
        workspace = self.client_capabilities.workspace
        if workspace is None:
            return
        if self.pulls and workspace.diagnostics and workspace.diagnostics.refresh_support:
            self.workspace_diagnostic_refresh(None)
        if workspace.inlay_hint and workspace.inlay_hint.refresh_support:
            self.workspace_inlay_hint_refresh(None)
        if workspace.code_lens and workspace.code_lens.refresh_support:
            self.workspace_code_lens_refresh(None)


def make_server() -> Server:
    """A server with every feature."""
    server = Server()
    # Importing a module declares what it answers.
    for package in (feature, view):
        for module in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
            import_module(module.name)
    import_module(".preview.requests", __package__)
    for entry in REQUESTS:
        server.feature(entry.method, entry.options)(_answer(server, entry))
    for entry in SERVER_REQUESTS:
        server.feature(entry.method, entry.options)(_pass_on(server, entry))
    return server


def _answer(server: Server, entry: Request) -> Callable[[Any], Awaitable[Any]]:
    """What answers a request about one document. A fault in a feature is logged, and the rest goes on."""

    async def answer(params: Any) -> Any:
        document = server.documents.get(_uri(params))
        if document is None:
            return entry.nothing
        snapshot = await document.snapshot()
        try:
            if entry.slow:
                return await asyncio.to_thread(entry.handler, snapshot, params)
            return entry.handler(snapshot, params)
        except RefusalError:
            raise
        except Exception:
            log.exception("%s failed in version %s of %s", entry.method, snapshot.version, snapshot.uri)
            server.tell(f"{entry.method} failed; the log file of the server says how")
            return entry.nothing

    return answer


def _uri(params: Any) -> str:
    """The document that a request is about; one about an item that the server gave names the item's, and one about an
    action has it in its data."""
    if isinstance(params, types.CodeAction):
        return str(cast("dict[str, Any]", params.data)["uri"])
    return (params.text_document if hasattr(params, "text_document") else params.item).uri


def _pass_on(server: Server, entry: ServerRequest) -> Callable[[Any], Any]:
    if inspect.iscoroutinefunction(entry.handler):

        async def handle_later(params: Any) -> Any:
            return await entry.handler(server, params)

        return handle_later

    def handle(params: Any) -> Any:
        return entry.handler(server, params)

    return handle
