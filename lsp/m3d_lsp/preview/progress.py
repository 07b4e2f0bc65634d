"""Work-done progress (LSP): a bar in the editor for work that takes a while, and a button that ends it."""

# pygls leaves the type of its progress's futures open.
# pyright: reportUnknownMemberType=false
from __future__ import annotations

import asyncio
import contextlib
import uuid
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, cast

from lsprotocol import types
from pygls.exceptions import JsonRpcException

if TYPE_CHECKING:
    from ..server import Server


class WorkDone:
    """The progress of a request: under the token that the client gave, or one that it is asked to make a bar for, if it
    can. Cancelling it in the editor cancels the task that began it."""

    def __init__(self, server: Server, token: types.ProgressToken | None) -> None:
        self._progress = server.work_done_progress
        self._token = token
        window = server.client_capabilities.window
        self._may_ask = window is not None and bool(window.work_done_progress)
        self._shown = False
        self._percentage = -1

    @property
    def _tokens(self) -> dict[types.ProgressToken, Future[Any]]:
        return cast("Any", self._progress).tokens

    async def begin(self, title: str) -> None:
        if self._token is None and self._may_ask:
            token = str(uuid.uuid4())
            with contextlib.suppress(JsonRpcException):  # then there is no bar
                await self._progress.create_async(token)  # pyright: ignore[reportUnknownMemberType]
                self._token = token
        if self._token is None:
            return
        value = types.WorkDoneProgressBegin(title, cancellable=True, percentage=0)
        self._progress.begin(self._token, value)
        self._shown = True
        task = asyncio.current_task()

        def cancelled(future: Future[Any]) -> None:
            if future.cancelled() and task is not None:
                task.cancel()

        self._tokens[self._token].add_done_callback(cancelled)

    def report(self, done: int, of: int) -> None:
        """Some of the work is done; told in whole percents."""
        percentage = 100 * done // of
        if self._shown and self._token is not None and percentage > self._percentage:
            self._percentage = percentage
            self._progress.report(self._token, types.WorkDoneProgressReport(percentage=percentage))

    def end(self) -> None:
        if self._shown and self._token is not None:
            self._progress.end(self._token, types.WorkDoneProgressEnd())
            self._tokens.pop(self._token, None)
