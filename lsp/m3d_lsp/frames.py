"""Messages as bytes: LSP's base protocol, headers as HTTP allows them and then the content.

Names of headers have any case, blanks may stand around values, lines may end with a line feed alone, and headers that
are not known are skipped. Bytes that are no message cost what they cover: reading goes on at the next header with a
length.
"""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator
from typing import NamedTuple

# A larger message is skipped without being kept: nothing that a client sends is as long.
LARGEST = 1 << 30
# How much of a message that is skipped is read at once; and the longest line of a header.
PIECE = 1 << 16

_HEADER = re.compile(rb"([!#$%&'*+.^_`|~0-9A-Za-z-]+)[ \t]*:[ \t]*(.*?)\s*")
_LENGTH = re.compile(rb"[0-9]{1,18}")
# What follows bytes that are no message, without a line break between them.
_LENGTH_AT_END = re.compile(rb"(?i)content-length[ \t]*:[^\r\n]*\s*\Z")
_CHARSET = re.compile(rb"(?i)charset\s*=\s*\"?([^\s;\"]+)")


class Fault(NamedTuple):
    """Why what came is no message."""

    reason: str


async def contents(reader: asyncio.StreamReader) -> AsyncIterator[bytes | Fault]:
    """The content of each message, until the client closes its side. Raises asyncio.IncompleteReadError where that is
    in the middle of a content."""
    while (head := await _head(reader)) is not None:
        if isinstance(head, Fault):
            yield head
        elif head.length > LARGEST:
            await _skip(reader, head.length)
            yield Fault(f"a message of {head.length} bytes is too long; {LARGEST} are the most")
        else:
            content = await reader.readexactly(head.length)
            yield content if head.fault is None else head.fault


class _Head(NamedTuple):
    """How long a content is, and why it can not be read all the same."""

    length: int
    fault: Fault | None


async def _head(reader: asyncio.StreamReader) -> _Head | Fault | None:
    """The headers of the next message; None at the end of the input."""
    lengths: set[bytes] = set()
    fault: Fault | None = None
    begun = False
    while line := await _line(reader):
        if line.strip():
            begun = True
            header = _HEADER.fullmatch(line)
            if header is None:  # what came up to here is no message
                lengths, fault = set(), None
                late = _LENGTH_AT_END.search(line)
                header = None if late is None else _HEADER.fullmatch(late[0])
            if header is not None and header[1].lower() == b"content-length":
                lengths.add(header[2])
            elif header is not None and header[1].lower() == b"content-type":
                charset = _CHARSET.search(header[2])
                if charset is not None and charset[1].lower() not in (b"utf-8", b"utf8"):
                    fault = Fault(f"messages must be in UTF-8, not {charset[1].decode('latin-1')}")
        elif begun:  # HTTP too has readers overlook empty lines before a message
            if len(lengths) == 1 and _LENGTH.fullmatch(length := lengths.pop()):
                return _Head(int(length), fault)
            return Fault("the headers of a message must have one Content-Length, in bytes")
    return None


async def _line(reader: asyncio.StreamReader) -> bytes:
    """A line; empty at the end of the input."""
    try:
        return await reader.readline()
    except ValueError:  # longer than any header: what there is of it is dropped
        return b"\x00\n"


async def _skip(reader: asyncio.StreamReader, length: int) -> None:
    while length > 0:
        length -= len(await reader.readexactly(min(length, PIECE)))
