"""The edits that declare a variable, and where a new assignment goes."""

from __future__ import annotations

from itertools import count

from m3d_language.table import LANGUAGE
from m3dc.syntax.parse import ast

from ...comments import comments
from ...names import names
from .action import Edit, Site

INDENT = "    "


def unused_name(site: Site, wanted: str) -> str:
    """The name, or with a number if it is taken."""
    known = names(site.analysis)
    tries = (wanted if number == 1 else f"{wanted}_{number}" for number in count(1))
    return next(name for name in tries if not known.of(name) and name not in LANGUAGE.keywords)


def variables_of(site: Site) -> ast.TopLevel | None:
    """The VARIABLES block."""
    return next((top for top in site.analysis.items if isinstance(top.item, ast.Variables)), None)


def declared(site: Site, name: str, type_: str, before: int) -> list[Edit] | None:
    """The edits that declare a variable before a byte: in the VARIABLES block, beside others of its type, or in a new
    block. None where the block stands too late, or is broken."""
    top = variables_of(site)
    if top is None:
        first = site.analysis.items[0].start if site.analysis.items else 0
        return [new_before(site, first, f"VARIABLES {{ {type_} {name}; }}\n\n")]
    assert isinstance(top.item, ast.Variables)
    close = top.place(top.item.span)[1] - 1
    if close >= before or site.data[close : close + 1] != b"}":
        return None
    same = next((d for d in top.item.declarations if d.type.text == type_ and d.names), None)
    if same is not None:
        _, end = top.place(same.names[-1].span)
        return [((end, end), f", {name}")]
    line = site.data.rfind(b"\n", 0, close) + 1
    if line > top.start and not site.data[line:close].strip():
        return [((line, line), f"{_indent(site, top)}{type_} {name};\n")]
    last = max((top.place(d.span)[1] for d in top.item.declarations), default=site.data.find(b"{", top.start) + 1)
    return [((last, last), f" {type_} {name};")]


def _indent(site: Site, top: ast.TopLevel) -> str:
    """How far the last declaration is indented that begins a line."""
    assert isinstance(top.item, ast.Variables)
    for declaration in reversed(top.item.declarations):
        start, _ = top.place(declaration.span)
        margin = site.data[site.data.rfind(b"\n", 0, start) + 1 : start]
        if not margin.strip():
            return margin.decode("ascii")
    return INDENT


def new_before(site: Site, item: int, text: str) -> Edit:
    """The edit that puts text before the top-level item that begins at a byte, and before the comments that belong to
    it, but not before those that begin the file."""
    above = comments(site.analysis).before(item)
    at = above if site.data[:above].strip() else item
    line = site.data.rfind(b"\n", 0, at) + 1
    if not site.data[line:at].strip():
        at = line
    return (at, at), text
