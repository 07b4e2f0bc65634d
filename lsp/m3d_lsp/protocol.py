"""pygls's protocol with documents of our own: its own are split into lines anew for every question."""

from __future__ import annotations

from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, cast

from lsprotocol import types
from pygls.protocol import LanguageServerProtocol, lsp_method

from .client import Client
from .registry import RefusalError

if TYPE_CHECKING:
    from .server import Server


class Protocol(LanguageServerProtocol):
    """Hands what becomes of documents to the server's `documents`."""

    @property
    def _own(self) -> Server:
        return cast("Server", self._server)

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: types.DidOpenTextDocumentParams) -> Any:
        encoding = self.workspace.position_encoding
        self._own.documents.encoding = str(getattr(encoding, "value", encoding))
        self._own.documents.client = Client.of(self._own.client_capabilities)
        self._own.documents.open(params.text_document)

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: types.DidChangeTextDocumentParams) -> Any:
        self._own.documents.change(params)

    @lsp_method(types.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: types.DidCloseTextDocumentParams) -> Any:
        self._own.documents.close(params.text_document.uri)
        self._own.forget(params.text_document.uri)

    def _send_handler_result(self, future: Future[Any], *, msg_id: str | int) -> None:
        """What is refused is answered with the reason, and is no fault of the server."""
        refusal = None if future.cancelled() else future.exception()
        if isinstance(refusal, RefusalError):
            self._request_futures.pop(msg_id, None)
            error = types.ResponseError(types.LSPErrorCodes.RequestFailed, str(refusal))
            self._send_response(msg_id, error=error)
        else:
            super()._send_handler_result(future, msg_id=msg_id)
