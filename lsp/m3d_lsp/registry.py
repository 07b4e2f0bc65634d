"""Which function answers which request. A feature's module declares its own with the decorators below.

    @request(types.TEXT_DOCUMENT_HOVER)
    def hover(snapshot: Snapshot, params: types.HoverParams) -> types.Hover | None: ...

A handler is a plain function of a snapshot and the request's parameters: it knows nothing of the server, sends nothing,
and is not called again for what it says. It runs in a thread, at the same time as others. The server waits for the
snapshot of the document as it was when the request came, or a later one, and sends the answer; a handler that fails is
logged, and its answer is `nothing`. What can not be done it refuses by raising RefusalError.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any, NamedTuple, TypeAlias

Handler: TypeAlias = Callable[..., Any]


class RefusalError(Exception):
    """Why something can not be done, in words for the person who asked for it."""


class Request(NamedTuple):
    """A handler of a request about one document. The answer of an `exact` one is of no use about a later text."""

    method: str
    handler: Handler
    options: Any
    nothing: Any
    exact: bool


class ServerRequest(NamedTuple):
    """A handler that takes the server itself: of what is not about one snapshot."""

    method: str
    handler: Callable[..., Awaitable[Any] | Any]
    options: Any


REQUESTS: list[Request] = []
SERVER_REQUESTS: list[ServerRequest] = []


def request(
    method: str, options: Any = None, *, nothing: Any = None, exact: bool = False
) -> Callable[[Handler], Handler]:
    """Declares the handler of a request whose parameters name a text document, or an item of one."""

    def declare(handler: Handler) -> Handler:
        REQUESTS.append(Request(method, handler, options, nothing, exact))
        return handler

    return declare


def server_request(method: str, options: Any = None) -> Callable[[Handler], Handler]:
    """Declares the handler of another request or notification: `handler(server, params)`, which may be async."""

    def declare(handler: Handler) -> Handler:
        SERVER_REQUESTS.append(ServerRequest(method, handler, options))
        return handler

    return declare
