"""Markdown for the client, or plain text where it shows no Markdown."""

from __future__ import annotations

import base64
import re
from collections.abc import Sequence

from lsprotocol import types

_IMAGE = re.compile(r"!\[([^]]*)\]\([^)]*\) ?")
_LINK = re.compile(r"\[([^]]*)\]\([^)]*\)")
_MARKS = re.compile(r"\*\*|`|(?<!\w)\*(?=\S)|(?<=\S)\*(?!\w)")
_FENCE = re.compile(r"^```.*\n?", re.MULTILINE)
_SPECIAL = re.compile(r"([\\`*_\[\]<>#|~])")
_ESCAPED = re.compile(r"\\([\\`*_\[\]<>#|~])")
_RULE = re.compile(r"^\|[-| :]*\|\n", re.MULTILINE)


def markup(text: str, *, markdown: bool) -> types.MarkupContent:
    """A text written in Markdown, in the form that the client can show."""
    kind = types.MarkupKind.Markdown if markdown else types.MarkupKind.PlainText
    return types.MarkupContent(kind, text if markdown else plain(text))


def plain(text: str) -> str:
    """The text of our Markdown: fences, rules, links and emphasis left out."""
    text = _RULE.sub("", _FENCE.sub("", text))
    text = _LINK.sub(r"\1", _IMAGE.sub("", text))
    pieces = _ESCAPED.split(text)
    pieces[::2] = [_MARKS.sub("", piece) for piece in pieces[::2]]
    return "".join(pieces).strip()


def escaped(text: str) -> str:
    """Text of the user as it is, none of it taken for Markdown."""
    return _SPECIAL.sub(r"\\\1", text)


def fenced(code: str) -> str:
    """A piece of a scene."""
    return f"```m3d\n{code}\n```"


def swatch(color: Sequence[float]) -> str:
    """A colour, RGB 0..1, as a small picture."""
    picture = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="28" height="14">'
        f'<rect width="27" height="13" x=".5" y=".5" fill="{hexadecimal(color)}" stroke="#888"/></svg>'
    )
    return f"![colour](data:image/svg+xml;base64,{base64.b64encode(picture.encode()).decode()})"


def hexadecimal(color: Sequence[float]) -> str:
    """A colour, RGB 0..1, as `#rrggbb`."""
    return "#" + "".join(f"{round(255 * min(max(component, 0.0), 1.0)):02x}" for component in color)


def shown(color: Sequence[float], *, images: bool) -> str:
    """A colour as it looks, and its number."""
    number = f"`{hexadecimal(color)}`"
    return f"{swatch(color)} {number}" if images else number


def matrix(rows: Sequence[Sequence[float]]) -> str:
    """A matrix, its columns in line."""
    written = [[f"{number + 0.0:.6g}" for number in row] for row in rows]
    width = max(len(number) for row in written for number in row)
    return "```\n" + "\n".join("  ".join(number.rjust(width) for number in row) for row in written) + "\n```"
