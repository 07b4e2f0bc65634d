"""JSON-RPC as LSP has it: every request is answered, whatever it holds, and nothing that a client sends ends the server
but its `exit`.

pygls's protocol reads a message and looks for its handler; what it would leave unanswered is answered here. Documents
are our own: pygls's are split into lines anew for every question.
"""

from __future__ import annotations

import asyncio
import contextvars
import json
import logging
import typing
from collections.abc import Generator, Mapping
from concurrent.futures import Future
from typing import Any, NoReturn, cast

from lsprotocol import types
from pygls.exceptions import (
    JsonRpcException,
    JsonRpcInternalError,
    JsonRpcInvalidParams,
    JsonRpcInvalidRequest,
    JsonRpcMethodNotFound,
    JsonRpcParseError,
    JsonRpcServerNotInitialized,
)
from pygls.protocol import LanguageServerProtocol, lsp_method

from .client import Client
from .documents import Documents
from .frames import Fault
from .reading import what_is_wrong
from .registry import RefusalError

log = logging.getLogger(__name__)

# Answers are not waited for any longer once the client wants the server to end.
LAST_ANSWERS_S = 1.0

Message = Mapping[str, Any]


class Owner(typing.Protocol):
    """What the protocol tells of to the server whose it is."""

    documents: Documents

    def end(self, status: int) -> None: ...
    def watch(self, process: int | None) -> None: ...
    def offer_edits(self) -> None: ...
    def not_read(self, method: str, given: Any, reason: str) -> None: ...
    def forget(self, uri: str) -> None: ...


class Protocol(LanguageServerProtocol):
    """Takes messages as they come, and hands what becomes of documents to the server's `documents`."""

    _initialized = False

    @property
    def _own(self) -> Owner:
        return cast("Owner", self._server)

    @property
    def was_shut_down(self) -> bool:
        """Whether the client has asked the server to shut down."""
        return self._shutdown

    # --- messages -----------------------------------------------------------------------------------------------------

    def receive(self, content: bytes | Fault) -> None:
        """Take the content of a message."""
        if isinstance(content, Fault):
            self._refuse(None, JsonRpcInvalidRequest(content.reason))
            return
        log.debug("received: %s", content)
        try:
            message = json.loads(content, parse_constant=_no_json)
        except (ValueError, RecursionError) as error:
            self._refuse(None, JsonRpcParseError(f"this is no JSON: {error}"))
            return
        if isinstance(message, list):
            self._refuse_batch(cast("list[Any]", message))
        else:
            try:
                # Each message is handled in a context of its own.
                contextvars.copy_context().run(self._take, message)
            except ConnectionError:  # nobody is left to answer
                raise
            except Exception as error:
                log.exception("a message could not be handled")
                number = cast("Message", message).get("id") if isinstance(message, dict) else None
                self._refuse(number, JsonRpcInternalError(f"the message could not be handled: {error}"))

    def _refuse_batch(self, messages: list[Any]) -> None:
        each = [cast("Message", message) for message in messages if isinstance(message, dict)]
        numbers = [message["id"] for message in each if "id" in message]
        for number in numbers or [None]:
            self._refuse(number, JsonRpcInvalidRequest("LSP has no batches: each message must come by itself"))

    def _take(self, message: Any) -> None:
        if not isinstance(message, dict):
            self._refuse(None, JsonRpcInvalidRequest(f"a message must be an object, not {message!r:.60}"))
            return
        given = cast("Message", message)
        number, method = given.get("id"), given.get("method")
        if method is None and ("result" in given or "error" in given):
            self._take_answer(given)
        elif given.get("jsonrpc") != self.VERSION:
            self._refuse(number, JsonRpcInvalidRequest('"jsonrpc" must be "2.0"'))
        elif not isinstance(method, str):
            self._refuse(number, JsonRpcInvalidRequest(f'"method" must be a string, not {method!r:.60}'))
        elif "id" not in given:
            self._take_notification(method, given.get("params"))
        elif not _is_id(number):
            self._refuse(None, JsonRpcInvalidRequest(f'"id" must be a string or a number, not {number!r:.60}'))
        else:
            self._take_request(number, method, given.get("params"))

    def _take_request(self, number: Any, method: str, given: Any) -> None:
        try:
            if not self._initialized and method != types.INITIALIZE:
                raise JsonRpcServerNotInitialized(f"{method} came before initialize")
            if self._shutdown:
                raise JsonRpcInvalidRequest(f"{method} came after shutdown")
            if self._initialized and method == types.INITIALIZE:
                raise JsonRpcInvalidRequest("initialize may come only once")
            if not self._handles(method) or _is_notification(method):
                raise JsonRpcMethodNotFound.of(method)
            params = self._params(method, given)
        except JsonRpcException as error:
            self._refuse(number, error)
        else:
            self._handle_request(number, method, params)

    def _take_notification(self, method: str, given: Any) -> None:
        if method == types.EXIT:
            self._own.end(0 if self._shutdown else 1)
        elif not self._initialized or self._shutdown:
            log.warning("%s is ignored before initialize and after shutdown", method)
        elif method != types.CANCEL_REQUEST and (not self._handles(method) or not _is_notification(method)):
            log.info("%s is not known as a notification", method)
        else:
            try:
                params = self._params(method, given)
            except JsonRpcInvalidParams as error:
                self._own.not_read(method, given, error.message)
            else:
                self._handle_notification(method, params)

    def _take_answer(self, message: Message) -> None:
        """An answer to a request of the server's own; nobody waits for one with another number."""
        number: Any = message.get("id")
        future = self._request_futures.get(number) if _is_id(number) else None
        if future is None or isinstance(future, asyncio.Future) or future.done():
            log.warning("an answer to nothing that was asked: %r", number)
            return
        del self._request_futures[number]
        kind = self._result_types.pop(number, None)
        try:
            if message.get("error") is not None:
                error = self._converter.structure(message["error"], types.ResponseError)
                future.set_exception(JsonRpcException.from_error(error))
            else:
                # Answers without a result have been seen.
                answer = {"jsonrpc": self.VERSION, "result": None, **message}
                future.set_result(answer["result"] if kind is None else self._converter.structure(answer, kind).result)
        except Exception as error:
            future.set_exception(JsonRpcInternalError(f"the answer can not be read: {what_is_wrong(error)}"))

    def _handles(self, method: str) -> bool:
        manager = cast("Any", self.fm)  # which leaves its types open
        return method in manager.builtin_features or method in manager.features

    def _params(self, method: str, given: Any) -> Any:
        """The parameters of a message; those of a method of our own as they came. Raises JsonRpcInvalidParams."""
        given = {} if given is None else given
        if method in types.METHOD_TO_TYPES:
            kind = types.METHOD_TO_TYPES[method][2]
            try:
                return None if kind is None else self._converter.structure(given, kind)
            except Exception as error:  # the hooks of lsprotocol raise whatever their code happens to
                raise JsonRpcInvalidParams(f"the parameters of {method}: {what_is_wrong(error)}") from error
        if not isinstance(given, dict):
            raise JsonRpcInvalidParams(f"the parameters of {method} must be an object, not {given!r:.60}")
        return cast("Any", given)

    # --- answers ------------------------------------------------------------------------------------------------------

    def _refuse(self, number: Any, error: JsonRpcException) -> None:
        """Answer what is no request, or one that can not be answered otherwise."""
        log.info("refused: %s", error)
        # pygls would leave out an id of null.
        given = number if _is_id(number) else None
        answer = {"jsonrpc": self.VERSION, "id": given, "error": {"code": error.code, "message": error.message}}
        self._send_data(answer)

    def _send_handler_result(self, future: Future[Any], *, msg_id: str | int) -> None:
        """What is refused is answered with the reason, and is no fault of the server."""
        refusal = None if future.cancelled() else future.exception()
        if isinstance(refusal, RefusalError):
            refusal = JsonRpcException(str(refusal), types.LSPErrorCodes.RequestFailed.value)
        if isinstance(refusal, JsonRpcException):
            self._request_futures.pop(msg_id, None)
            self._refuse(msg_id, refusal)
        else:
            super()._send_handler_result(future, msg_id=msg_id)

    def _send_data(self, data: Any) -> None:
        """Send a message; where an answer can not be put into JSON, that."""
        try:
            body = json.dumps(data, default=self._serialize_message, allow_nan=False)
        except Exception as fault:
            log.exception("%r can not be sent", data)
            if hasattr(data, "method"):
                return
            error = types.ResponseError(types.ErrorCodes.InternalError, f"the answer can not be sent: {fault}")
            answer = types.ResponseErrorMessage(getattr(data, "id", None), error)
            body = json.dumps(answer, default=self._serialize_message)
        log.debug("sent: %s", body)
        if self.writer is not None:
            self.writer.write(f"Content-Length: {len(body)}\r\n\r\n{body}".encode("ascii"))

    def _run_generator(
        self, future: Future[Any] | None, *, gen: Generator[Any, Any, Any], result_future: Future[Any]
    ) -> None:
        """Go on with one of pygls's own handlers, unless what it waited for was given up."""
        if future is not None and future.cancelled():
            result_future.cancel()
        else:
            super()._run_generator(future, gen=gen, result_future=result_future)

    def _handle_cancel_notification(self, msg_id: str | int) -> None:
        """Cancel a request of the client's; not one of the server's own that has the same number."""
        if _is_id(msg_id) and isinstance(self._request_futures.get(msg_id), asyncio.Future):
            super()._handle_cancel_notification(msg_id)

    # --- the life of the server ---------------------------------------------------------------------------------------

    @lsp_method(types.INITIALIZE)
    def lsp_initialize(self, params: types.InitializeParams) -> Any:
        client = Client.of(params.capabilities)
        if client.applies_edits and not client.action_literals:
            self._own.offer_edits()
        result = yield from super().lsp_initialize(params)
        encoding = self.workspace.position_encoding
        self._own.documents.encoding = str(getattr(encoding, "value", encoding))
        self._own.documents.client = client
        self._initialized = True
        self._own.watch(params.process_id)
        return result

    async def settle(self) -> None:
        """Wait until what shutting down has cancelled is answered."""
        tasks = [task for task in self._request_futures.values() if isinstance(task, asyncio.Task)]
        cancelled = [task for task in tasks if task.cancelling()]
        if cancelled:
            await asyncio.wait(cancelled, timeout=LAST_ANSWERS_S)

    @lsp_method(types.WORKSPACE_EXECUTE_COMMAND)
    def lsp_workspace__execute_command(self, params: types.ExecuteCommandParams) -> Any:
        # pygls takes a command without arguments for one that needs none.
        params.arguments = params.arguments or []
        return (yield from super().lsp_workspace__execute_command(params))

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: types.DidOpenTextDocumentParams) -> Any:
        self._own.documents.open(params.text_document)

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: types.DidChangeTextDocumentParams) -> Any:
        self._own.documents.change(params)

    @lsp_method(types.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: types.DidCloseTextDocumentParams) -> Any:
        self._own.documents.close(params.text_document.uri)
        self._own.forget(params.text_document.uri)


def _is_id(number: object) -> bool:
    return isinstance(number, (str, int, float)) and not isinstance(number, bool)


def _is_notification(method: str) -> bool:
    """Whether LSP has a method as one that is not answered; all of our own are."""
    known = cast("dict[str, tuple[Any, ...]]", types.METHOD_TO_TYPES).get(method)
    return known is not None and known[1] is None


def _no_json(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no number")
