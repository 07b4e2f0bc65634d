"""Reading a stretch of text that tree-sitter could not: every item of it as far as it goes, and what is wrong.

The reader goes through the form of the language by recursive descent (the same form as grammar.js: which keyword may
stand where is for `check` to say). Where a token does not fit it takes the text for what it most likely means, says so
once, and goes on. An item in which that was not certain is marked `doubtful`: nothing more is said of it.

The files stand one upon another. `lexer` makes the tokens, `faults` reports each mistake once, and a `cursor` is a
place among the tokens. The rest are functions of a cursor: `skip` passes what cannot be used, `nesting` deals with
braces, `values`, `arguments`, `variables`, `tables`, `blocks` and `items` read a part of the language each, and
`expressions`, `misplaced` and `stray` deal with what it does not have. A `reader` goes from item to item.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from tree_sitter import Node

from m3d_language.table import LANGUAGE

from ...diagnostics import TextFindings, catalogue
from ...text.span import Span
from .limit import GivenUpError
from .reader import Read, Reader

__all__ = ["Read", "Recovered", "recover"]


class Recovered(NamedTuple):
    """The items of all broken stretches, and the `names` that they may declare or assign to."""

    items: tuple[Read, ...]
    stretches: tuple[Span, ...]
    names: frozenset[str]


def recover(data: bytes, root: Node, end: int, findings: TextFindings, most: int) -> Recovered | None:
    """Read the stretches of a text, up to `end`, that have errors in its tree. None where the text is given
    up: there are more faults than `most`, or too much to be read."""
    nodes = [node for node in root.children if node.type != "comment" and node.start_byte < end]
    whole = {node.start_byte for node in nodes if _is_whole(node, root)}
    reader = Reader(data, end, findings, whole, most, _declared_types(nodes))
    done = 0
    try:
        for number, node in enumerate(nodes):
            if node.end_byte <= done or (node.start_byte >= done and node.start_byte in whole):
                continue
            start = max(node.start_byte, done)
            # What stands before may be the beginning of what is broken.
            for before in reversed(nodes[:number]):
                far = b"\n" in data[before.end_byte : start] and start < node.start_byte
                if before.start_byte < done or _has_body(before) or far:
                    break
                start = before.start_byte
            done = reader.run(start, node.start_byte + 1)
    except GivenUpError as reason:
        place = findings.found[-1].span if len(findings.found) >= most else reader.place
        findings.add(catalogue.TOO_MANY_ERRORS, place, str(reason))
        return None
    return Recovered(tuple(reader.read), tuple(reader.stretches), frozenset(reader.names))


def _declared_types(nodes: Iterable[Node]) -> dict[str, str]:
    """The types of the variables that sound VARIABLES blocks declare."""
    types: dict[str, str] = {}
    for node in nodes:
        for declaration in node.children if node.type == "variables" else ():
            names = declaration.children_by_field_name("name")
            type_ = declaration.children[0].type if names else ""
            types |= {name.text.decode("latin-1"): type_ for name in names if name.text is not None}
    return types


def _is_whole(node: Node, root: Node) -> bool:
    """Whether a node of the top level is an item without an error."""
    if node.has_error or node.is_missing or not node.child_count or node.type == "ERROR":
        return False
    return root.type != "ERROR" or node.type in ("variables", "assignment") or node.children[0].type in LANGUAGE.top


def _has_body(node: Node) -> bool:
    return node.type == "variables" or (node.child_count > 0 and node.children[-1].type == "body")
