"""JSON as LSP's objects.

pygls's converter makes what is expected of whatever comes: of null the text "None". Here a text is a text and a number
a number, and what is something else can not be read. A value that LSP does not know, or not yet, is no reason to
refuse a message where it may be left out: an unknown kind in a list of kinds, an unknown trigger. Of what a client says
of itself at the start, whatever can not be read is as if it were not there.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from functools import cache, partial
from types import NoneType, UnionType
from typing import Any, Union, cast, get_args, get_origin

import attrs
from cattrs import Converter, transform_error
from lsprotocol import converters, types
from pygls.protocol import default_converter

FARTHEST = (1 << 31) - 1  # of the lines and characters that LSP can name

# Left out of a list when they can not be read: those of other servers, which a client hands on, are of no use here.
_DISPENSABLE = (types.Diagnostic,)
# What brought a request about is never needed to answer it.
_OPTIONAL_CONTEXTS = (types.CompletionContext, types.SignatureHelpContext)


@cache
def converter() -> Converter:
    """How servers read messages."""
    made = _exact(default_converter())
    made.register_structure_hook_factory(_is_list_of(_is_dispensable), partial(_what_can_be_read, made))
    made.register_structure_hook_factory(_is_optional(_is_dispensable), partial(_or_nothing, made))
    made.register_structure_hook_func(_is_change, lambda given, _: _change(made, given))
    made.register_structure_hook(types.Position, lambda given, _: _position(made, given))
    made.register_structure_hook(types.Range, lambda given, _: _range(made, given))
    lenient = _lenient()
    made.register_structure_hook(types.InitializeParams, lambda given, _: _initialize(lenient, given))
    return made


def what_is_wrong(error: Exception) -> str:
    """Why something could not be read, in the names of the protocol."""
    reasons = transform_error(error)
    return "; ".join(re.sub(r"_(\w)", lambda match: match[1].upper(), reason) for reason in reasons[:3])


# --- values -----------------------------------------------------------------------------------------------------------


def _exact(made: Converter) -> Converter:
    """Take texts, numbers and truth values only for what they are."""
    made.register_structure_hook(str, _text)
    made.register_structure_hook(int, _whole)
    made.register_structure_hook(float, _number)
    made.register_structure_hook(bool, _truth)
    made.register_structure_hook_factory(_is_open_enumeration, partial(_known_or_plain, made))
    return made


def _text(given: Any, kind: Callable[[str], Any]) -> Any:
    """A text, or the member of an enumeration of texts."""
    if not isinstance(given, str):
        raise TypeError(f"must be a text, not {given!r:.60}")
    return kind(given)


def _whole(given: Any, kind: Callable[[int], Any]) -> Any:
    """A whole number, or the member of an enumeration of numbers."""
    if isinstance(given, bool) or not isinstance(given, (int, float)) or given != given // 1:
        raise TypeError(f"must be a whole number, not {given!r:.60}")
    return kind(int(given))


def _number(given: Any, _: object) -> float:
    if isinstance(given, bool) or not isinstance(given, (int, float)):
        raise TypeError(f"must be a number, not {given!r:.60}")
    return float(given)


def _truth(given: Any, _: object) -> bool:
    if not isinstance(given, bool):
        raise TypeError(f"must be true or false, not {given!r:.60}")
    return given


def _is_open_enumeration(kind: object) -> bool:
    """Whether it is an enumeration to which others may add texts or numbers."""
    parts = get_args(kind) if get_origin(kind) in (Union, UnionType) else ()
    return len(parts) == 2 and any(map(_is_enumeration, parts)) and (str in parts or int in parts)


def _known_or_plain(made: Converter, kind: Any) -> Callable[[Any, Any], Any]:
    parts = sorted(get_args(kind), key=_is_enumeration, reverse=True)

    def read(given: Any, _: object) -> Any:
        known = _read(made, given, parts[0])
        return known[0] if known else made.structure(given, parts[1])

    return read


def _is_change(kind: object) -> bool:
    return set(get_args(kind)) == {
        types.TextDocumentContentChangePartial,
        types.TextDocumentContentChangeWholeDocument,
    }


def _change(made: Converter, given: Any) -> types.TextDocumentContentChangeEvent:
    """A change of a text; one without a range, or whose range is null, is the whole text."""
    text = made.structure(given["text"], str)
    if given.get("range") is None:
        return types.TextDocumentContentChangeWholeDocument(text)
    return types.TextDocumentContentChangePartial(made.structure(given["range"], types.Range), text)


def _position(made: Converter, given: Any) -> types.Position:
    """A position, moved to where one can be."""
    line, character = (made.structure(given[name], int) for name in ("line", "character"))
    return types.Position(min(max(line, 0), FARTHEST), min(max(character, 0), FARTHEST))


def _range(made: Converter, given: Any) -> types.Range:
    """A range, turned round where it ends before it starts."""
    ends = [made.structure(given[name], types.Position) for name in ("start", "end")]
    return types.Range(*sorted(ends, key=lambda end: (end.line, end.character)))


# --- what may be left out ---------------------------------------------------------------------------------------------


def _is_dispensable(kind: Any) -> bool:
    return _is_enumeration(kind) or kind in _DISPENSABLE or kind in _OPTIONAL_CONTEXTS


def _is_enumeration(kind: object) -> bool:
    return isinstance(kind, type) and issubclass(kind, Enum)


def _is_list_of(holds: Callable[[object], bool]) -> Callable[[object], bool]:
    return lambda kind: get_origin(kind) in (list, Sequence) and holds(get_args(kind)[0])


def _is_optional(holds: Callable[[object], bool]) -> Callable[[object], bool]:
    def is_optional(kind: object) -> bool:
        parts = get_args(kind) if get_origin(kind) in (Union, UnionType) else ()
        return len(parts) == 2 and NoneType in parts and any(map(holds, parts))

    return is_optional


def _what_can_be_read(made: Converter, kind: Any) -> Callable[[Any, Any], list[Any]]:
    """A list without those elements that can not be read."""
    element = get_args(kind)[0]

    def read(given: Any, _: object) -> list[Any]:
        if not isinstance(given, list):
            raise TypeError(f"must be a list, not {given!r:.60}")
        return [value for each in cast("list[Any]", given) for value in _read(made, each, element)]

    return read


def _or_nothing(made: Converter, kind: Any) -> Callable[[Any, Any], Any]:
    (element,) = (part for part in get_args(kind) if part is not NoneType)
    return lambda given, _: None if given is None else next(iter(_read(made, given, element)), None)


def _read(made: Converter, given: Any, kind: Any) -> tuple[Any, ...]:
    """The value, if it can be read."""
    try:
        return (made.structure(given, kind),)
    except Exception:  # the hooks of lsprotocol raise whatever their code happens to
        return ()


# --- what a client says of itself -------------------------------------------------------------------------------------


def _lenient() -> Converter:
    """How capabilities are read: what can not be is as if it were not there, whatever it is."""
    made = _exact(converters.get_converter())
    made.register_structure_hook_func(attrs.has, partial(_members, made))
    made.register_structure_hook_factory(_is_list_of(lambda _: True), partial(_what_can_be_read, made))
    return made


def _initialize(lenient: Converter, given: Any) -> types.InitializeParams:
    params: types.InitializeParams = _members(lenient, given, types.InitializeParams)
    return params


def _members(made: Converter, given: Any, kind: Any) -> Any:
    """An object of those members that can be read. One that must be there and is not is empty, where it can be."""
    if not isinstance(given, Mapping):
        raise TypeError(f"must be an object, not {given!r:.60}")
    members = cast("Mapping[str, Any]", given)
    read: dict[str, Any] = {}
    for member in attrs.fields(kind):
        values = _read(made, members.get(_in_json(member.name)), member.type)
        if not values and member.default is attrs.NOTHING:
            values = (_empty(made, member.type),)
        if values and (values[0] is not None or member.default is attrs.NOTHING):
            read[member.alias] = values[0]
    return kind(**read)


def _empty(made: Converter, kind: Any) -> Any:
    return [] if get_origin(kind) in (list, Sequence) else made.structure({}, kind)


def _in_json(name: str) -> str:
    first, *rest = name.removesuffix("_").split("_")
    return first + "".join(part.title() for part in rest)
