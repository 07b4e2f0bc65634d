"""From text to syntax tree: `parse` takes any text and gives the items that can be read, and what is wrong in form.

tree-sitter builds the tree, whatever the text. A stretch in which it met an error is read again, item by item, to say
what is wrong and what was probably meant (recovery/).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

from tree_sitter import Language, Node, Parser, Point, Range, Tree

import m3d_language
from m3d_language.comments import outermost
from m3d_language.table import LANGUAGE

from ..diagnostics import Finding, Findings, ItemFindings, Related, TextFindings, catalogue
from ..text import long_tables
from ..text.difference import Difference
from ..text.places import Places
from ..text.source import Source
from ..text.span import Base, FileId, Local, Placed, Span
from . import ast, numerals

if TYPE_CHECKING:
    from .recovery import Read

_GRAMMAR = Language(m3d_language.language())
_COMMENT_MARK = re.compile(rb"/\*|\*/")
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1f\x7f]")


# Diagnostics after which a text is given up: it is no scene, and nobody reads more.
MOST_FOUND = 10_000
MOST_FAULTS = 200  # of form, which are dearer to explain
MOST_CONTROL = 8  # characters that no text holds

# A text of which, long tables aside, so many bytes are judged by its head first.
VERY_LONG = 4_000_000
HEAD = 500_000
MOST_LOOSE = 4_000
_LOOSE = ("identifier", "number")


class Syntax(NamedTuple):
    """A parsed scene: its concrete tree, and the top-level items as abstract ones, made as they are asked for; `places`
    knows where those that have been made begin.

    `faulty` are the starts of the nodes that stand in a stretch with a syntax error, `doubtful` those of the items that
    may be incomplete, and `unfinished` of those too of which a block is not closed; `names` may be declared or assigned
    to in one. `broken`: something is wrong in the form.
    """

    tree: Tree
    items: Iterator[ast.TopLevel]
    places: Places
    faulty: frozenset[int] = frozenset()
    doubtful: frozenset[int] = frozenset()
    unfinished: frozenset[int] = frozenset()
    names: frozenset[str] = frozenset()
    broken: bool = True


def parse(source: Source, findings: Findings, before: Parsed | None = None) -> Syntax:
    """Read a scene. Never raises on any text; what is wrong goes into `findings`. What was `before`, the text parsed
    last, and has not changed is used again."""
    data = source.data
    outside = long_tables.outside(data)
    head = _hopeless_head(data, outside)
    if head is not None:
        return parse(Source(head, source.name, source.file), findings)
    form = TextFindings()
    syntax = _parse(source, outside, form, findings, before)
    findings.add_text(form)
    return syntax


def _parse(
    source: Source, outside: list[Span], form: TextFindings, findings: Findings, before: Parsed | None
) -> Syntax:
    """As `parse`. What is wrong in the form of the text as a whole is found now; what is in its items, one by one."""
    data = source.data
    places = Places() if before is None else Places(before.places)
    tree = _tree(data, outside) if before is None else before.tree(data, outside)
    control = _find_control(data, outside)
    if control:
        found = f"it holds the byte {data[control[0]]:#04x}"
        form.add(
            catalogue.NOT_A_TEXT_FILE,
            (control[0], control[0] + 1),
            f"{found}; a scene is plain text, in UTF-8 or ASCII",
        )
        if len(control) > MOST_CONTROL or data[:2] in (b"\xff\xfe", b"\xfe\xff"):  # the marks of UTF-16
            return Syntax(tree, iter(()), places)
    unclosed = _unclosed_comment(data, outside)
    if unclosed is not None:
        _report_unclosed_comment(data, unclosed, form)
    elif all(node.type == "comment" for node in tree.root_node.children):
        form.add(catalogue.EMPTY_FILE, (0, 0), "a scene needs at least one SOLID, LIGHT or SCENE")
    if not tree.root_node.has_error:
        whole = _Items(tree.root_node.children, ())
        items = _items(whole, source, places, findings, before)
        return Syntax(tree, items, places, broken=bool(form.found))

    from .recovery import recover

    end = len(data) if unclosed is None else unclosed
    recovered = recover(data, tree.root_node, end, form, MOST_FAULTS)
    if recovered is None:
        return Syntax(tree, iter(()), places)
    if not form.found:
        # Nothing that is broken is taken for a scene in silence.
        place = _first_error(tree.root_node)
        form.add(catalogue.INVALID_AT_TOP, place, "this can not be read here")
    apart = [
        node
        for node in tree.root_node.children
        if not any(start <= node.start_byte < stop for start, stop in recovered.stretches)
    ]
    whole = {(read.start, read.end) for read in recovered.items if not read.doubtful and not read.unclosed}
    sound = {node.start_byte for node in apart}
    sound |= {node.start_byte for node in tree.root_node.children if (node.start_byte, node.end_byte) in whole}
    faulty = {node.start_byte for node in tree.root_node.children} - sound
    doubtful = {read.start for read in recovered.items if read.doubtful}
    unfinished = {read.start for read in recovered.items if read.doubtful or read.unclosed}
    items = _items(_Items(apart, recovered.items), source, places, findings, before)
    return Syntax(
        tree, items, places, frozenset(faulty | doubtful), frozenset(doubtful), frozenset(unfinished), recovered.names
    )


class _Items(NamedTuple):
    """The top level of a text: `nodes` of the tree that are whole, and what was `read` in between."""

    nodes: list[Node]
    read: tuple[Read, ...]

    def in_order(self) -> list[Node | Read]:
        if not self.read:
            return [*self.nodes]
        found: list[Node | Read] = [*self.nodes, *self.read]
        return sorted(found, key=lambda each: each.start_byte if isinstance(each, Node) else each.start)


def _hopeless_head(data: bytes, outside: list[Span]) -> bytes | None:
    """The beginning of a very long text if it is full of errors: there is no need to read the rest."""
    if sum(end - start for start, end in outside) <= VERY_LONG:
        return None
    head = data[: data.find(b"\n", HEAD) + 1 or HEAD]
    tree = _tree(head, long_tables.outside(head))
    root = tree.root_node
    faulty = sum(node.has_error for node in root.children)
    loose = sum(_loose_tokens(node) for node in (root, *root.children) if node.is_error)
    return head if faulty > MOST_FAULTS or loose > MOST_LOOSE else None


def _loose_tokens(error: Node) -> int:
    """How many tokens of a stretch that could not be read are part of nothing. A block that is not closed, as the last
    one of a head never is, has few of its own."""
    return sum(not node.is_named or node.is_error or node.type in _LOOSE for node in error.children)


def _items(
    whole: _Items, source: Source, places: Places, findings: Findings, before: Parsed | None
) -> Iterator[ast.TopLevel]:
    """The top-level items that can be read, as they are asked for."""
    data = source.data
    if before is not None:
        before.begin(data, places)
    for each in whole.in_order():
        if isinstance(each, Node) and each.type == "comment":
            continue
        start = each.start_byte if isinstance(each, Node) else each.start
        if len(findings.found) >= MOST_FOUND:
            found = f"{len(findings.found)} problems up to here; the rest of the text is not looked at"
            findings.add_at(catalogue.TOO_MANY_ERRORS, Local(0, 1).at(places.new(source.file, start)), found)
            return
        if not isinstance(each, Node):
            base, item = places.new(source.file, start), each.item
        elif before is None:
            base = places.new(source.file, start)
            item = _Builder(data, ItemFindings(findings, base), start).item(each, 0)
        else:
            base, item = before.item(each, source.file, findings)
        if item is not None:
            yield ast.TopLevel(start, base, item)


def _report_unclosed_comment(data: bytes, start: int, findings: TextFindings) -> None:
    """A comment that is never closed, and the one within it that took the end it has, if it has one."""
    marks = list(_COMMENT_MARK.finditer(data, start + 2))
    inner = next((mark for mark in marks if mark[0] == b"/*"), None)
    related: tuple[Related[Span], ...] = ()
    detail = "this comment is never closed with */"
    if inner is not None and any(mark[0] == b"*/" for mark in marks):
        detail += "; comments nest: each /* needs its own"
        related = (Related(inner.span(), "a comment within it begins here"),)
    findings.add(catalogue.UNBALANCED_COMMENT, (start, start + 2), detail, related=related)


def _first_error(root: Node) -> Span:
    """Where the first node stands that is an error."""
    node = root
    while node.type != "ERROR" and not node.is_missing:
        inner = next((child for child in node.children if child.has_error or child.is_missing), None)
        if inner is None:
            break
        node = inner
    return node.start_byte, node.end_byte


def _tree(data: bytes, outside: list[Span]) -> Tree:
    """The concrete tree. Where long tables are left out, rows and columns are wrong after them; bytes never are."""
    if len(outside) == 1:
        return Parser(_GRAMMAR).parse(data)
    anywhere = Point(0, 0)
    ranges = [Range(anywhere, anywhere, start, end) for start, end in outside[:-1]]
    ranges.append(Range(anywhere, Point(0xFFFFFFFF, 0xFFFFFFFF), outside[-1][0], 0xFFFFFFFF))
    return Parser(_GRAMMAR, included_ranges=ranges).parse(data)


class Parsed:
    """What was made of the text parsed last: its tree and its items. `places` tells where the items of the text that is
    being parsed begin."""

    def __init__(self) -> None:
        self.places = Places()
        self._tree: Tree | None = None
        self._tree_data = b""
        self._whole = False  # whether the tree was made of the whole text
        self._items_data = b""
        self._difference = Difference(0, 0, 0)
        self._lost: dict[bytes, list[_Read]] = {}  # by their text, the items that stood where the text has changed
        self._before: dict[int, _Read] = {}
        self._now: dict[int, _Read] = {}

    def tree(self, data: bytes, outside: list[Span]) -> Tree:
        """The tree of a text, of the tree of the last one. The same tree as from the start: where the text is broken,
        mending it might depend on the edits before, so that it is parsed anew."""
        tree = None
        whole = len(outside) == 1
        if self._tree is not None and self._whole and whole and not self._tree.root_node.has_error:
            self._tree.edit(*_edit(self._tree_data, data))
            tree = Parser(_GRAMMAR).parse(data, self._tree)
        if tree is None or tree.root_node.has_error:
            tree = _tree(data, outside)
        self._tree, self._tree_data, self._whole = tree, data, whole
        return tree.copy()

    def begin(self, data: bytes, places: Places) -> None:
        """Start to go through the items of a text, whose `places` are to be found."""
        difference = self._difference = Difference.between(self._items_data, data)
        self._lost = {}
        for start, read in self._now.items():
            if start < difference.old_end and start + read.length > difference.start:
                self._lost.setdefault(self._items_data[start : start + read.length], []).append(read)
        self._items_data = data
        self._before, self._now = self._now, {}
        self.places = places

    def item(self, node: Node, file: FileId, findings: Findings) -> tuple[Base, ast.Item | None]:
        """The item of a node, and its base: those of the same text before, if there is one."""
        start = node.start_byte
        read = None if node.has_error else self._same(start, node.end_byte)
        if read is not None:
            findings.found.extend(read.found)
            self.places.put(read.base, file, start)
        else:
            base = self.places.new(file, start)
            before = len(findings.found)
            item = _Builder(self._items_data, ItemFindings(findings, base), start).item(node, 0)
            read = _Read(base, node.end_byte - start, item, tuple(findings.found[before:]))
        if not node.has_error:
            self._now[start] = read
        return read.base, read.item

    def _same(self, start: int, end: int) -> _Read | None:
        """What was read of the same stretch of text, or else of one with the same text."""
        difference = self._difference
        if end > difference.start and start < difference.new_end:
            alike = self._lost.get(self._items_data[start:end])
            return alike.pop() if alike else None
        # What is deleted right before an item ends where it starts: the item itself is behind the difference.
        moved = 0 if end <= difference.start else difference.old_end - difference.new_end
        read = self._before.get(start + moved)
        return read if read is not None and read.length == end - start else None


class _Read(NamedTuple):
    """The item that a stretch of text is read as, its base, and what was wrong."""

    base: Base
    length: int
    item: ast.Item | None
    found: tuple[Finding[Placed], ...]


def _edit(old: bytes, new: bytes) -> tuple[int, int, int, Point, Point, Point]:
    """The difference of two texts as tree-sitter wants it: in bytes, and in rows and columns."""
    start, old_end, new_end = Difference.between(old, new)
    return start, old_end, new_end, _point(old, start), _point(old, old_end), _point(new, new_end)


def _point(data: bytes, offset: int) -> Point:
    line = data.rfind(b"\n", 0, offset) + 1
    return Point(data.count(b"\n", 0, line), offset - line)


def _find_control(data: bytes, outside: list[Span]) -> list[int]:
    """Where the first bytes are that no text holds; no more of them than tell a text from what is none."""
    found = (match.start() for start, end in outside for match in _CONTROL.finditer(data, start, end))
    return list(islice(found, MOST_CONTROL + 1))


def _unclosed_comment(data: bytes, outside: list[Span]) -> int | None:
    """Where the comment opens that is never closed, if any: the outermost one."""
    return next((begin for begin, end in outermost(data, outside) if end is None), None)


class _Builder:
    """Makes abstract nodes of the concrete ones of an item that begins at `start`."""

    def __init__(self, data: bytes, findings: ItemFindings, start: int) -> None:
        self._data = data
        self._findings = findings
        self._start = start

    def _span(self, node: Node) -> Local:
        return Local(node.start_byte - self._start, node.end_byte - self._start)

    def _text(self, node: Node) -> str:
        return self._data[node.start_byte : node.end_byte].decode("utf-8", "replace")

    def _fields(self, node: Node) -> dict[str, list[Node]]:
        fields: dict[str, list[Node]] = {}
        cursor = node.walk()
        if cursor.goto_first_child():
            while True:
                name = cursor.field_name
                if name is not None:
                    child = cursor.node  # made anew each time that it is asked for
                    if child is not None and not child.is_missing:
                        fields.setdefault(name, []).append(child)
                if not cursor.goto_next_sibling():
                    break
        return fields

    def item(self, node: Node, depth: int) -> ast.Item | None:
        """The item of a node, or None where there is too little of it."""
        if depth > ast.DEEPEST:
            self._findings.add(
                catalogue.NESTED_TOO_DEEPLY, self._span(node), f"no scene needs more than {ast.DEEPEST} levels"
            )
            return None
        fields = self._fields(node)
        keyword = self._keyword(fields)
        match node.type:
            case "statement" if keyword:
                return ast.Statement(keyword, self._arguments(fields.get("argument", ())), self._span(node))
            case "block" if keyword:
                return ast.Block(keyword, self._name(fields, "name"), self._body(fields, depth), self._span(node))
            case "table" if keyword:
                data = fields.get("data")
                entries = self._arguments(fields.get("entry", ()))
                return ast.Table(keyword, self._span(data[0]) if data else None, entries, self._span(node))
            case "variables" if keyword:
                declarations = tuple(self._declaration(child) for child in node.children if child.type == "declaration")
                return ast.Variables(keyword, tuple(d for d in declarations if d is not None), self._span(node))
            case "assignment":
                target = self._name(fields, "target")
                values = self._arguments([*fields.get("value", ()), *fields.get("source", ())])
                body = self._body(fields, depth)
                if target is None or (not values and body is None):
                    return None
                return ast.Assignment(target, values[0] if values else None, body, self._span(node))
            case _:
                return None

    def _keyword(self, fields: dict[str, list[Node]]) -> ast.Keyword | None:
        nodes = fields.get("keyword")
        return ast.Keyword(nodes[0].type, self._span(nodes[0])) if nodes else None

    def _body(self, fields: dict[str, list[Node]], depth: int) -> ast.Body | None:
        nodes = fields.get("body")
        if not nodes:
            return None
        items = (self.item(child, depth + 1) for child in nodes[0].named_children if child.type != "comment")
        return ast.Body(tuple(item for item in items if item is not None), self._span(nodes[0]))

    def _name(self, fields: dict[str, list[Node]], field: str) -> ast.Name | None:
        nodes = fields.get(field)
        return self._identifier(nodes[0]) if nodes else None

    def _identifier(self, node: Node) -> ast.Name:
        name = ast.Name(self._text(node), self._span(node))
        longest = LANGUAGE.limits["identifier"]
        if len(name.text) > longest:
            self._findings.add(
                catalogue.NAME_TOO_LONG, name.span, f"at most {longest} characters, not {len(name.text)}"
            )
        return name

    def _declaration(self, node: Node) -> ast.Declaration | None:
        fields = self._fields(node)
        types = fields.get("type")
        if not types:
            return None
        kind = types[0]
        type_: ast.Keyword | ast.Name = (
            self._identifier(kind) if kind.type == "identifier" else ast.Keyword(kind.type, self._span(kind))
        )
        names = tuple(self._identifier(n) for n in fields.get("name", ()))
        return ast.Declaration(type_, names, self._span(node))

    def _arguments(self, nodes: list[Node] | tuple[()]) -> tuple[ast.Argument, ...]:
        arguments = (self._argument(node) for node in nodes)
        return tuple(argument for argument in arguments if argument is not None)

    def _argument(self, node: Node) -> ast.Argument | None:
        match node.type:
            case "number":
                return self._number(node)
            case "identifier":
                return self._identifier(node)
            case "vector":
                components = self._arguments(self._fields(node).get("component", []))
                scalars = tuple(c for c in components if not isinstance(c, ast.Vector))
                return ast.Vector(scalars, self._span(node)) if len(scalars) == 3 else None
            case _:
                return None

    def _number(self, node: Node) -> ast.Number:
        span = self._span(node)
        value, fault = numerals.read(self._data[node.start_byte : node.end_byte])
        if fault is not None:
            place = Local(span.start + fault.start, span.end)
            self._findings.add(fault.entry, place, fault.detail, fix=fault.fix(span))
        return ast.Number(value, span)
