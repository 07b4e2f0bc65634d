"""What to say where a text stops being a sentence of the formal grammar.

Lark is run over the one stretch that tree-sitter could not read, and names the token it stopped at and all that could
have stood there; from that set follows the message, in the words of the thesis's Appendix B.
"""

from __future__ import annotations

import re
from difflib import get_close_matches

from tree_sitter import Node

from tree_sitter_m3d.comments import blank_comments
from tree_sitter_m3d.formal import SyntaxFault, first_error
from tree_sitter_m3d.table import LANGUAGE

from .diagnostics import Findings, Fix, Related
from .ir import Span
from .source import Source

# Where a new top-level item begins, as one can tell after an error: at the start of a line. A type in a VARIABLES
# block, which a name and a comma or semicolon follow, is none.
_ITEM_START = re.compile(
    r"^[ \t]*(?=(?:SCENE|VARIABLES)\b|(?:SOLID|LIGHT)\b(?!\s+\w+\s*[;,])|[A-Za-z]\w*\s*=)", re.MULTILINE
)


def report(source: Source, root: Node, faulty: list[Node], findings: Findings) -> None:
    """What is wrong in the form of the faulty top-level nodes: the first fault of each item in them."""
    # One character a byte, so that the grammar's offsets are ours.
    text = blank_comments(_without_tables(source.data, root).decode("latin-1"))
    for start, end in _stretches(root, faulty):
        found = False
        while start < end:
            fault = first_error(text[start:end])
            if fault is None and not found:
                # The stretch reads as a sentence when it is cut here: it is what follows that does not fit.
                fault = first_error(text[start:])
            if fault is None:
                break
            found = True
            _explain(fault, text[start:], start, findings)
            item = _ITEM_START.search(text, max(start + fault.offset, start + 1), end)
            if item is None or not fault.length:
                break
            start = item.end()
        if not found:
            node = _first_error_node(next(n for n in faulty if n.start_byte >= start))
            findings.add("M3D0107", (node.start_byte, node.end_byte), "this can not be read here")


def _stretches(root: Node, faulty: list[Node]) -> list[tuple[int, int]]:
    """Ranges of bytes to run the grammar over: faulty nodes with the faulty ones that follow them at once."""
    bad = {node.id for node in faulty}
    found: list[tuple[int, int]] = []
    run_start: int | None = None
    for node in root.children:
        if node.type == "comment":
            continue
        if node.id in bad:
            run_start = node.start_byte if run_start is None else run_start
        elif run_start is not None:
            found.append((run_start, node.start_byte))
            run_start = None
    if run_start is not None:
        found.append((run_start, root.end_byte))
    return found


def _without_tables(data: bytes, root: Node) -> bytes:
    """The text with every long table of numbers blanked out but for its beginning, which the grammar wants to see."""
    keep = 80
    pieces = bytearray(data)
    stack = [node for node in root.children if node.end_byte - node.start_byte > keep]
    while stack:
        node = stack.pop()
        if node.type == "numeric_table":
            # A row is cut at white space between entries, after a closed vector or before an opening one.
            head = data[node.start_byte : node.start_byte + keep]
            cut = node.start_byte + _row_end(head)
            pieces[cut : node.end_byte] = b" " * (node.end_byte - cut)
        else:
            stack.extend(child for child in node.children if child.end_byte - child.start_byte > keep)
    return bytes(pieces)


def _row_end(head: bytes) -> int:
    """How much of a table's beginning to keep: its counts, up to the first vector if there is one."""
    vector = head.find(b"<")
    if vector >= 0:
        return vector
    fields = head.split(None, 1)
    return len(head) - len(fields[1]) if len(fields) > 1 else len(head)


def _first_error_node(node: Node) -> Node:
    while node.type != "ERROR" and not node.is_missing:
        inner = next((child for child in node.children if child.has_error or child.is_missing), None)
        if inner is None:
            return node
        node = inner
    return node


def _explain(fault: SyntaxFault, text: str, base: int, findings: Findings) -> None:
    """Report one fault of the grammar. Offsets are characters of Latin-1 text, so they are bytes."""
    offset = fault.offset if fault.length else len(text.rstrip())
    span = (offset + base, offset + base + fault.length)
    token = text[fault.offset : fault.offset + fault.length]
    found = f"found {token!r}" if token else "found the end of the text"
    expected = fault.expected
    marks = [_PUNCTUATION[name] for name in expected if name in _PUNCTUATION]
    unclosed = not token or (fault.block is not None and token in LANGUAGE.top)
    if token == "*/":
        findings.add("M3D0105", span, "this closes a comment that was never opened")
    elif unclosed and "RBRACE" in expected:
        end = base + len(text[: fault.offset].rstrip())
        span = (end, end)
        opened = _open_brace(text[: fault.offset])
        related = (Related((base + opened, base + opened + 1), "the block that is open begins here"),)
        findings.add("M3D0101", span, found, fill="}", related=related)
    elif expected == frozenset(("IDENTIFIER",)):
        findings.add("M3D0108", span, f"{found}; a name starts with a letter and is not a keyword")
    elif len(marks) == len(expected) == 1:
        findings.add("M3D0101", span, found, fill=marks[0])
    elif expected == frozenset(("COMMA", "SEMICOLON")):
        findings.add("M3D0101", span, found, fill="," if token.isidentifier() else ";")
    elif expected == frozenset(("IDENTIFIER", "LBRACE")):
        findings.add("M3D0101", span, f"{found}; the name of a variable could stand here too", fill="{")
    elif fault.block == "VARIABLES":
        findings.add("M3D0109", span, _near(token, expected, found), fix=_replacement(token, expected, span))
    elif "NUMERAL" in expected and "LANGLE" in expected:
        findings.add("M3D0103", span, f"{found}; a vector < x, y, z > or a block could stand here too")
    elif "NUMERAL" in expected:
        findings.add("M3D0103", span, found)
    elif "LANGLE" in expected:
        findings.add("M3D0102", span, f"{found}; a vector is < x, y, z >")
    elif fault.block in LANGUAGE.blocks:
        detail, fix = _near(token, expected, found), _replacement(token, expected, span)
        findings.add("M3D0106", span, detail, fill=fault.block, fix=fix)
    else:
        findings.add("M3D0107", span, _near(token, expected, found), fix=_replacement(token, expected, span))


_PUNCTUATION = {"LBRACE": "{", "RBRACE": "}", "COMMA": ",", "EQUAL": "=", "RANGLE": ">", "SEMICOLON": ";"}


def _nearest(token: str, expected: frozenset[str]) -> str | None:
    """The keyword that may stand here and that a token most looks like, if it looks like any."""
    keywords = sorted(expected & LANGUAGE.keywords)
    return next(iter(get_close_matches(token.upper(), keywords, 1, 0.7)), None)


def _near(token: str, expected: frozenset[str], found: str) -> str:
    near = _nearest(token, expected)
    return found if near is None else f"{found}; did you mean {near}?"


def _replacement(token: str, expected: frozenset[str], span: Span) -> Fix | None:
    near = _nearest(token, expected)
    return None if near is None else Fix(f"Replace with {near}", span, near)


def _open_brace(text: str) -> int:
    """Where the innermost brace stands that is still open at the end of the text."""
    text = blank_comments(text)
    depth = 0
    for offset in range(len(text) - 1, -1, -1):
        if text[offset] == "}":
            depth += 1
        elif text[offset] == "{":
            if depth == 0:
                return offset
            depth -= 1
    return 0
