"""Reading the parameters of requests that LSP does not know: they are handed over as they came, as JSON."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, TypeGuard, TypeVar, cast

from lsprotocol import types
from pygls.exceptions import JsonRpcInvalidParams

from .reading import FARTHEST

Choice = TypeVar("Choice", bound=str)
Default = TypeVar("Default", float, None)


class Given:
    """The parameters of a request. Each method gives one of them, by its name in the protocol; one that is missing or
    of another kind than expected raises JsonRpcInvalidParams, which the client gets as the answer."""

    def __init__(self, params: Any) -> None:
        self._params = params

    def uri(self) -> str:
        """The document that the request is about."""
        uri = _member(self._get("textDocument"), "uri")
        return uri if isinstance(uri, str) else _refuse("textDocument", "{ uri }", uri)

    def text(self, name: str) -> str:
        value = self._get(name)
        return value if isinstance(value, str) else _refuse(name, "a string", value)

    def one_of(self, name: str, choices: Collection[Choice]) -> Choice:
        value = self._get(name)
        for choice in choices:
            if value == choice:
                return choice
        return _refuse(name, " or ".join(f'"{choice}"' for choice in choices), value)

    def whole(self, name: str, least: int, default: int | None = None) -> int:
        """A whole number; the default where there is one and nothing is given."""
        value = self._get(name)
        if value is None and default is not None:
            return default
        return value if _is_whole(value, least) else _refuse(name, f"a whole number, {least} or more", value)

    def number(self, name: str, default: Default) -> float | Default:
        """A number; the default where nothing is given."""
        value = self._get(name)
        if value is None:
            return default
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return value
        return _refuse(name, "a number", value)

    def flag(self, name: str) -> bool:
        """True or false; false where nothing is given."""
        value = self._get(name)
        return value if isinstance(value, bool) else value is not None and _refuse(name, "true or false", value)

    def position(self, name: str = "position") -> types.Position | None:
        """A position, or None where none is given."""
        value = self._get(name)
        if value is None:
            return None
        line, character = _member(value, "line"), _member(value, "character")
        if _is_whole(line, 0) and _is_whole(character, 0):
            return types.Position(min(line, FARTHEST), min(character, FARTHEST))
        return _refuse(name, "{ line, character }", value)

    def token(self) -> types.ProgressToken | None:
        """The token under which the client wants to hear how far the work is."""
        token = self._get("workDoneToken")
        return token if isinstance(token, (str, int)) else None

    def _get(self, name: str) -> Any:
        return _member(self._params, name)


def _member(value: Any, name: str) -> Any:
    return cast("dict[str, Any]", value).get(name) if isinstance(value, dict) else None


def _is_whole(value: Any, least: int) -> TypeGuard[int]:
    return isinstance(value, int) and not isinstance(value, bool) and value >= least


def _refuse(name: str, wanted: str, found: object) -> Any:
    raise JsonRpcInvalidParams(f"{name} must be {wanted}, not {found!r}")
