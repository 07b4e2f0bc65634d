"""The server: keeps the documents, asks the features, and speaks to the client."""

from __future__ import annotations

import asyncio
import contextlib
import inspect
import logging
import pkgutil
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from importlib import import_module
from importlib.metadata import version
from typing import Any, BinaryIO, TypeAlias, cast

from lsprotocol import types
from pygls.exceptions import JsonRpcException, JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer

from . import client_process, feature, frames, reading, standard_io, view
from .client import APPLY_EDIT
from .document import Document
from .documents import CONTENT_MODIFIED, Documents, file_name
from .feature import diagnostics
from .preview.previews import Previews
from .protocol import Protocol
from .registry import REQUESTS, SERVER_REQUESTS, RefusalError, Request, ServerRequest
from .settings import read_settings
from .snapshot import Snapshot

log = logging.getLogger(__name__)

SECTION = "m3d"

Streams: TypeAlias = tuple[asyncio.StreamReader, asyncio.StreamWriter]


class Server(LanguageServer):
    """A language server for scenes. `documents` are the open ones, `previews` the pictures of them."""

    protocol: Protocol  # pyright: ignore[reportIncompatibleVariableOverride]

    def __init__(self) -> None:
        super().__init__(  # pyright: ignore[reportUnknownMemberType]
            "m3d-lsp", version("m3d-lsp"), protocol_cls=Protocol, converter_factory=reading.converter
        )
        self.documents = Documents(self._looked_at, self._lost)
        self.previews = Previews()
        self.exit_status = 0
        self._attending: asyncio.Task[None] | None = None

    # --- its life -----------------------------------------------------------------------------------------------------

    def start_io(self, stdin: BinaryIO | None = None, stdout: BinaryIO | None = None) -> None:
        """Talk over standard input and output until the client leaves."""
        del stdin, stdout
        self._run(self._talk_over_pipes())

    def start_tcp(self, host: str, port: int) -> None:
        """Talk to the first client that comes to a port. Raises OSError where none can be listened on."""
        self._run(self._talk_over_network(host, port))

    def _run(self, talk: Coroutine[Any, Any, None]) -> None:
        loop = asyncio.new_event_loop()
        try:
            # Not asyncio.run, which waits for what threads still work at.
            loop.run_until_complete(talk)
        except KeyboardInterrupt:
            self.exit_status = 1
        finally:
            self.shutdown()

    async def _talk_over_pipes(self) -> None:
        self.protocol.set_writer(standard_io.Writer())
        await self.attend(await standard_io.reader())

    async def _talk_over_network(self, host: str, port: int) -> None:
        came: asyncio.Future[Streams] = asyncio.get_running_loop().create_future()

        def connected(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            if came.done():
                writer.close()
            else:
                came.set_result((reader, writer))

        listener = await asyncio.start_server(connected, host, port)
        reader, writer = await came
        listener.close()
        self.protocol.set_writer(writer)
        await self.attend(reader)
        writer.close()
        with contextlib.suppress(OSError):
            await writer.wait_closed()

    async def attend(self, reader: asyncio.StreamReader) -> None:
        """Take messages until the client leaves, or the server is ended."""
        self._attending = asyncio.create_task(self._take_messages(reader))
        try:
            await self._attending
        except asyncio.CancelledError:  # by `end`
            await self.protocol.settle()
            return
        except asyncio.IncompleteReadError:
            log.warning("the client left in the middle of a message")
        except OSError as error:  # a pipe or a connection that broke
            log.warning("the client does not listen any more: %s", error)
        self.exit_status = 0 if self.protocol.was_shut_down else 1

    async def _take_messages(self, reader: asyncio.StreamReader) -> None:
        async for content in frames.contents(reader):
            self.protocol.receive(content)
            await asyncio.sleep(0)  # a request begins before the next message changes what it is about

    def end(self, status: int) -> None:
        """Leave, with an exit status."""
        self.exit_status = status
        if self._attending is not None:
            self._attending.cancel()

    def watch(self, process: int | None) -> None:
        """End when the client's process has gone."""
        if process is not None and process > 0:
            client_process.when_gone(process, self._alone)

    def _alone(self) -> None:
        log.warning("the client's process has gone")
        self.end(0 if self.protocol.was_shut_down else 1)

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
        if self.protocol.was_shut_down:
            return
        if not self.pulls:
            self.text_document_publish_diagnostics(
                types.PublishDiagnosticsParams(document.uri, diagnostics.of(snapshot), snapshot.version)
            )
        if self.documents.client.is_told:
            analysed = {"uri": document.uri, "version": snapshot.version, "ok": snapshot.analysis.ok}
            self.protocol.notify("m3d/analysed", analysed)

    def offer_edits(self) -> None:
        """Have a command for what code actions do, for clients that take nothing else."""
        self.command(APPLY_EDIT)(_apply_edit)

    def not_read(self, method: str, given: Any, reason: str) -> None:
        """A notification can not be read. Where it is about the text of a document, that is not known any more."""
        log.warning("not read: %s", reason)
        if method not in (types.TEXT_DOCUMENT_DID_OPEN, types.TEXT_DOCUMENT_DID_CHANGE):
            self.tell(f"ignored: {reason}", types.MessageType.Warning)
            return
        document = cast("Any", given).get("textDocument") if isinstance(given, Mapping) else None
        uri = cast("Any", document).get("uri") if isinstance(document, Mapping) else None
        if isinstance(uri, str):
            self.documents.lose(uri)
        else:
            self._show("The editor changed a file in a way that the language server could not read, nor which file.")

    def _lost(self, uri: str) -> None:
        self.forget(uri)
        self._show(
            f"The editor changed {file_name(uri)} in a way that the language server could not read. It knows the text "
            "again when the file is closed and opened again."
        )

    def _show(self, message: str) -> None:
        self.window_show_message(types.ShowMessageParams(types.MessageType.Error, message))

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
        try:
            answer = await self.workspace_configuration_async(types.ConfigurationParams([item]))
        except JsonRpcException as error:
            self.tell(f"the settings could not be asked for: {error}", types.MessageType.Warning)
            return
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
        version = document.version
        snapshot = await document.snapshot()
        if entry.exact and snapshot.version != version:
            raise JsonRpcException("the text has changed since", CONTENT_MODIFIED)
        try:
            # However long it takes: the message loop waits for nothing.
            return await asyncio.to_thread(entry.handler, snapshot, params)
        except (RefusalError, JsonRpcException):
            raise
        except Exception:
            log.exception("%s failed in version %s of %s", entry.method, snapshot.version, snapshot.uri)
            server.tell(f"{entry.method} failed; the log file of the server says how")
            return entry.nothing

    return answer


async def _apply_edit(server: Server, uri: str, version: int, edit: types.WorkspaceEdit) -> None:
    """Make the edit of a code action. Raises RefusalError where the text is no longer the one that it was for."""
    document = server.documents.get(uri)
    if document is None or document.version != version:
        raise RefusalError("The text has changed since; ask for the actions again.")
    await server.workspace_apply_edit_async(types.ApplyWorkspaceEditParams(edit))


def _uri(params: Any) -> str:
    """The document that a request is about; one about an item that the server gave names the item's, and one about an
    action has it in its data."""
    if isinstance(params, types.CodeAction):
        uri = cast("Any", params.data).get("uri") if isinstance(params.data, Mapping) else None
        if not isinstance(uri, str):
            raise JsonRpcInvalidParams("the action is none that the server has offered")
        return uri
    return (params.text_document if hasattr(params, "text_document") else params.item).uri


def _pass_on(server: Server, entry: ServerRequest) -> Callable[[Any], Any]:
    if inspect.iscoroutinefunction(entry.handler):

        async def handle_later(params: Any) -> Any:
            return await entry.handler(server, params)

        return handle_later

    def handle(params: Any) -> Any:
        return entry.handler(server, params)

    return handle
