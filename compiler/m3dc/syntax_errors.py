"""What to say where a text stops being a sentence of the formal grammar.

Lark is run over the one stretch that tree-sitter could not read, and names the token it stopped at and all that could
have stood there; from that set follows the message, in the words of the thesis's Appendix B.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from tree_sitter_m3d.comments import blank_comments
from tree_sitter_m3d.formal import SyntaxFault, first_error
from tree_sitter_m3d.table import LANGUAGE

from .braces import brace_faults, repaired
from .check import statement_of
from .diagnostics import Findings, Fix, Related
from .ir import Span
from .spelling import is_certain, nearest

# Where a new top-level item begins, as one can tell after an error: at the start of a line. A type in a VARIABLES
# block, which a name and a comma or semicolon follow, is none.
_ITEM_START = re.compile(
    r"^[ \t]*(?=(?:SCENE|VARIABLES)\b|(?:SOLID|LIGHT)\b(?!\s+\w+\s*[;,])|[A-Za-z]\w*\s*=)", re.MULTILINE
)


SHORT = 80  # bytes of a table that are not worth leaving out


def mend_braces(data: bytes, text: str, root: Node, findings: Findings) -> bytes:
    """The data with missing and superfluous braces mended, each reported; the same data where they match, or where
    something else is wrong before them. `text` is what `plain` makes of it."""
    faults = brace_faults(text)
    if not faults:
        return data
    start = _before_first_fault(root)
    first = first_error(text[start:])
    if first is None or "LBRACE" in first.expected or start + first.offset < max(fault.offset for fault in faults):
        return data
    mended = repaired(data, faults)
    if mended is None:
        return data
    for fault in faults:
        if fault.missing:
            related = (Related((fault.opened, fault.opened + 1), "the block that is open begins here"),)
            place = (fault.offset, fault.offset)
            fix = Fix("Close the block", place, _closing(data, fault.opened, fault.offset))
            findings.add("M3D0101", place, "this block is not closed", fill="}", related=related, fix=fix)
        else:
            place = (fault.offset, fault.offset + 1)
            fix = Fix("Remove this brace", place, "")
            findings.add("M3D0107", place, "found '}', which closes more than was opened", fix=fix)
    return mended


def _closing(data: bytes, opened: int, end: int) -> str:
    """A closing brace for the block whose brace is `opened`: on a line of its own, indented like the line on which that
    one stands, if the block has several lines."""
    if b"\n" not in data[opened:end]:
        return " }"
    line = data.rfind(b"\n", 0, opened) + 1
    margin = data[line:opened]
    indent = margin[: len(margin) - len(margin.lstrip())].decode("ascii", "replace")
    return f"\n{indent}}}"


def _before_first_fault(root: Node) -> int:
    """Where the item begins that stands before the first faulty one: all before it can be read."""
    start = before = 0
    for node in root.children:
        if node.has_error or node.is_missing:
            break
        if node.type != "comment":
            start, before = before, node.end_byte
    return start


def report(text: str, root: Node, findings: Findings, most: int) -> frozenset[int] | None:
    """What is wrong in the form of a text, as `plain` gives it: the first fault of each top-level item.

    Returns where the nodes start that are faulty, or belong to an item that is, and of which no more is to be said;
    None if there are so many faults that the text is given up.
    """
    nodes = [node for node in root.children if node.type != "comment"]
    faulty = {node.start_byte for node in nodes if node.has_error or node.is_missing}
    done = faults = 0
    for start, end in _stretches(root, nodes):
        start = max(start, done)
        found = False
        while start < end:
            fault = first_error(text[start:end])
            if fault.length == 0 if fault else not found:
                # The stretch is a sentence, or the beginning of one: it is what follows that does not fit.
                fault = first_error(text[start:])
            if fault is None:
                break
            found = True
            faults += 1
            if faults > most:
                findings.add("M3D0115", (start, start + 1), f"{most} syntax errors up to here")
                return None
            _explain(fault, text[start:], start, findings)
            at = start + fault.offset
            if at >= end:
                done = next((node.start_byte for node in nodes if node.start_byte > at and _is_object(node)), len(text))
                faulty |= {node.start_byte for node in nodes if start <= node.start_byte < done}
            item = _ITEM_START.search(text, max(at, start + 1), end)
            if item is None or not fault.length:
                break
            start = item.end()
        if not found and start < end:
            node = _first_error_node(next(n for n in nodes if n.start_byte >= start and n.has_error))
            findings.add("M3D0107", (node.start_byte, node.end_byte), "this can not be read here")
    return frozenset(faulty)


def _is_object(node: Node) -> bool:
    """Whether a whole item of the top level begins here for certain."""
    return not node.has_error and node.child_count > 0 and node.children[0].type in LANGUAGE.top


def plain(data: bytes, root: Node) -> str:
    """The text as the formal grammar is asked about it, one character a byte, so that its offsets are ours."""
    return blank_comments(_without_tables(data, root).decode("latin-1"))


def _stretches(root: Node, nodes: list[Node]) -> list[tuple[int, int]]:
    """Ranges of bytes to run the grammar over: faulty nodes with the faulty ones that follow them at once."""
    found: list[tuple[int, int]] = []
    run_start: int | None = None
    for node in nodes:
        if node.has_error or node.is_missing:
            run_start = node.start_byte if run_start is None else run_start
        elif run_start is not None:
            found.append((run_start, node.start_byte))
            run_start = None
    if run_start is not None:
        found.append((run_start, root.end_byte))
    return found


def _without_tables(data: bytes, root: Node) -> bytes:
    """The text with the rows of every long table of numbers blanked out; the grammar wants only the counts before."""
    pieces = bytearray(data)
    stack = [node for node in root.children if node.end_byte - node.start_byte > SHORT]
    while stack:
        node = stack.pop()
        if node.type == "numeric_table":
            start = node.start_byte + _counts_end(node, data[node.start_byte : node.start_byte + SHORT])
            pieces[start : node.end_byte] = b" " * (node.end_byte - start)
        else:
            stack.extend(child for child in node.children if child.end_byte - child.start_byte > SHORT)
    return bytes(pieces)


def _counts_end(numbers: Node, text: bytes) -> int:
    """Where the counts at the beginning of a table end, of which some tables have none."""
    table = numbers.parent
    keyword = table.children[0].type if table else ""
    body = table.parent if table else None
    block = body.parent.children[0].type if body and body.parent else ""
    known = LANGUAGE.blocks.get(block)
    entries = [known, *(LANGUAGE.blocks[parent] for parent in LANGUAGE.parents.get(keyword, ()))]
    entry = next((block.tables[keyword] for block in entries if block and keyword in block.tables), None)
    ends = [match.end() for match in re.finditer(rb"[^\s<>,]+", text)]
    count = len(entry.head) if entry else 0
    return ends[count - 1] if 0 < count <= len(ends) else 0


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
        fix = Fix("Remove it", span, "")
        findings.add("M3D0105", span, "this closes a comment that was never opened", fix=fix)
    elif unclosed and "RBRACE" in expected:
        end = base + len(text[: fault.offset].rstrip())
        span = (end, end)
        opened = _open_brace(text[: fault.offset])
        related = (Related((base + opened, base + opened + 1), "the block that is open begins here"),)
        findings.add("M3D0101", span, found, fill="}", related=related, fix=_inserted("}", fault, text, base))
    elif expected == frozenset(("IDENTIFIER",)):
        findings.add("M3D0108", span, f"{found}; a name starts with a letter and is not a keyword")
    elif len(marks) == len(expected) == 1:
        findings.add("M3D0101", span, found, fill=marks[0], fix=_inserted(marks[0], fault, text, base))
    elif expected == frozenset(("COMMA", "SEMICOLON")):
        mark = "," if token.isidentifier() else ";"
        findings.add("M3D0101", span, found, fill=mark, fix=_inserted(mark, fault, text, base))
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
        findings.add("M3D0106", span, detail, fill=statement_of(fault.block), fix=fix)
    else:
        findings.add("M3D0107", span, _near(token, expected, found), fix=_replacement(token, expected, span))


def _inserted(mark: str, fault: SyntaxFault, text: str, base: int) -> Fix | None:
    """The fix that puts a mark before the token at which the text stops being a sentence, right after the one before.
    None if the sentence does not go on with that token then."""
    at = len(text[: fault.offset].rstrip())
    if fault.offset - at > SHORT // 2:
        return None  # there may be the rows of a table between the two, which are blanked out
    new = mark if mark in ",;" else f" {mark}"
    # What comes after the next few tokens does not matter.
    rest = text[at : fault.offset + fault.length + SHORT]
    after = first_error(text[:at] + new + rest)
    if after is not None and after.length and after.offset <= fault.offset + len(new):
        return None
    # A brace might stand elsewhere, an = make an assignment of something else, and two names be meant as one. Before a
    # sign it might be a sum that was meant.
    token = text[fault.offset : fault.offset + fault.length]
    certain = mark in ";>" or (mark == "," and fault.block != "VARIABLES" and token[:1] not in "+-")
    goes_on = after is None or not after.length or after.offset + after.length == len(text[:at] + new + rest)
    return Fix(f"Insert '{mark}'", (base + at, base + at), new, certain and goes_on)


_PUNCTUATION = {"LBRACE": "{", "RBRACE": "}", "COMMA": ",", "EQUAL": "=", "RANGLE": ">", "SEMICOLON": ";"}


def _near(token: str, expected: frozenset[str], found: str) -> str:
    near = nearest(token, expected & LANGUAGE.keywords)
    if near is not None:
        return f"{found}; did you mean {near}?"
    elsewhere = nearest(token, LANGUAGE.keywords)
    places = LANGUAGE.parents.get(elsewhere or "")
    return f"{found}; {elsewhere} stands in {', '.join(places)}" if places else found


def _replacement(token: str, expected: frozenset[str], span: Span) -> Fix | None:
    keywords = expected & LANGUAGE.keywords
    near = nearest(token, keywords)
    return None if near is None else Fix(f"Replace with {near}", span, near, is_certain(token, near, keywords))


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
