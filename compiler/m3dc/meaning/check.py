"""Checks the syntax tree against the language table and the declared names: syntax tree in, checked program out.

Nothing here needs a value: which keyword may stand where, how many arguments of what shape it takes, which names are
declared and with what type. Values out of range are the evaluator's business, for only it knows them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from m3d_language import Stop, read_table
from m3d_language import table as language
from m3d_language.table import LANGUAGE

from ..diagnostics import Findings, Fix, ItemFindings, Related, catalogue
from ..diagnostics.findings import moved_fix
from ..diagnostics.spelling import Names, meant_type, nearest
from ..diagnostics.words import CAPITALS, place_of, statement_of, takes
from ..syntax import ast, numerals
from ..syntax.table_faults import layout_of, table_fault
from ..text.cut import cut
from ..text.source import Source
from ..text.span import WHOLE, Local, Placed, Span
from . import program
from .memo import Ledger, Steps

if TYPE_CHECKING:
    from ..syntax.parse import Syntax

# The members of every block that is a variable type: what the body of an assignment may hold when the type of its
# variable is not known.
ANY_BODY = language.Block(
    keyword="",
    holds=tuple(dict.fromkeys(m for t in LANGUAGE.types if t in LANGUAGE.blocks for m in LANGUAGE.blocks[t].holds)),
    statements={k: s for t in LANGUAGE.types if t in LANGUAGE.blocks for k, s in LANGUAGE.blocks[t].statements.items()},
    tables={k: s for t in LANGUAGE.types if t in LANGUAGE.blocks for k, s in LANGUAGE.blocks[t].tables.items()},
    variable=False,
    adds=False,
    once=None,
    uses=(),
    usual=(),
    says="",
    example="",
    thesis="",
)

_NONE: frozenset[str] = frozenset()
_EXPECTED = {
    "vector": catalogue.EXPECTED_VECTOR,
    "number": catalogue.EXPECTED_NUMBER,
    "integer": catalogue.EXPECTED_NUMBER,
}


class Known(NamedTuple):
    """What is known of a variable, or, by its keyword, of a block that a file has once: its type, where it is declared,
    and what was done with it. A number or vector is `unknown` when its last assignment was wrong: no more is said of
    it. Nor is of a variable whose type is "": what its declaration says could not be read."""

    type: str
    place: Placed
    assigned: bool = False
    used: bool = False
    unknown: bool = False


class Checker:
    """Walks the items of one scene in file order. With `names=False` it checks form alone: that is what the formal
    grammar can tell, which knows no declarations."""

    def __init__(
        self, source: Source, findings: Findings, *, names: bool = True, lost: frozenset[str] = frozenset()
    ) -> None:
        self._data = source.data
        self._all = findings
        self._findings = ItemFindings(findings, WHOLE)  # of the item being checked
        self._names = names
        self._start = 0
        self._said_count = False  # of the current block, that a table lacks its count
        self._around: list[str] = []  # keywords of the blocks around a member, outermost first
        self.known: Ledger[Known] = Ledger()
        self._known = Names(())
        self._words_known = 0
        for name in lost:
            self.known[_lost(name)] = Known("", Placed(0, 0))

    def item(self, top: ast.TopLevel) -> program.Content | None:
        """One top-level item; None where nothing of it can be used."""
        self._start = top.start
        self._findings = ItemFindings(self._all, top.base)
        return self._content(top.item)

    def _content(self, item: ast.Item) -> program.Content | None:
        match item:
            case ast.Variables():
                return self._variables(item)
            case ast.Assignment():
                return self._assignment(item)
            case ast.Block() if item.keyword.text in LANGUAGE.top:
                return self._block(item, LANGUAGE.blocks[item.keyword.text], {})
            case _:
                self._findings.add(catalogue.INVALID_AT_TOP, item.keyword.span, place_of(item.keyword.text, ()))
                return None

    # --- variables ----------------------------------------------------------------------------------------------

    def _variables(self, item: ast.Variables) -> tuple[program.Declaration, ...]:
        if self._names:
            self._only_once("VARIABLES", item.keyword.span, LANGUAGE.variables["once"], None)
        declared: list[program.Declaration] = []
        self._wrong_types([declaration.type for declaration in item.declarations])
        for declaration in item.declarations:
            type_ = declaration.type.text
            if type_ not in LANGUAGE.types:
                type_ = meant_type(type_) or ""
            for number, name in enumerate(declaration.names):
                before = self.known.get(name.text)
                if before is not None and self._names:
                    related = (Related(before.place, "first declared here"),)
                    detail = f"{name.text} is already a {before.type}"
                    again = self._without(declaration, number) if before.type == type_ else None
                    fix = Fix(f"Remove this {name.text}", again, "", certain=True) if again else None
                    self._findings.add(catalogue.VARIABLE_ALREADY_DEFINED, name.span, detail, related=related, fix=fix)
                    continue
                wrong = type_ != declaration.type.text
                lost = type_ in LANGUAGE.basics and self.known.get(_lost(name.text)) is not None
                place = self._findings.place(name.span)
                self.known[name.text] = Known(type_, place, assigned=lost or wrong, used=wrong, unknown=lost)
                if type_:
                    declared.append(program.Declaration(name, type_))
        return tuple(declared)

    def _wrong_types(self, types: list[ast.Keyword | ast.Name]) -> None:
        """Report what is no type; of those that only lack capitals the first, with a fix for all."""
        wrong = [type_ for type_ in types if type_.text not in LANGUAGE.types]
        small = [type_ for type_ in wrong if type_.text.upper() in LANGUAGE.types]
        for type_ in wrong:
            near = meant_type(type_.text)
            elsewhere = LANGUAGE.types_elsewhere.get(type_.text.lower())
            fix = Fix(f"Replace with {near}", type_.span, near, certain=True) if near else None
            if type_ in small:
                if type_ is not small[0]:
                    continue
                says = f"did you mean {near}? {CAPITALS}"
                fix = self._in_capitals(small)
            elif elsewhere is not None:
                says = elsewhere if near is None else f"write {near}"
            elif near is not None or (near := nearest(type_.text, LANGUAGE.types)) is not None:
                says = f"did you mean {near}?"
            else:
                says = f"the types are {', '.join(LANGUAGE.types)}"
            self._findings.add(catalogue.INVALID_TYPE, type_.span, f"{type_.text} is not a type; {says}", fix=fix)

    def _in_capitals(self, words: list[ast.Keyword | ast.Name]) -> Fix[Local] | None:
        """The fix that writes some words of the item in capitals."""
        whole = Local(words[0].span.start, words[-1].span.end)
        text = bytearray(self._bytes(whole))
        for word in words:
            text[word.span.start - whole.start : word.span.end - whole.start] = word.text.upper().encode()
        places = f" ({len(words)} places)" if len(words) > 1 else ""
        try:
            return Fix(f"Write {words[0].text.upper()}{places}", whole, text.decode(), certain=True)
        except UnicodeDecodeError:
            return None

    def _without(self, declaration: ast.Declaration, number: int) -> Local:
        """What to cut out so that a declaration lacks one of its names, or is gone with its only one."""
        names = declaration.names
        if number:
            return Local(names[number - 1].span.end, names[number].span.end)
        return Local(names[0].span.start, names[1].span.start) if len(names) > 1 else self._cut(declaration.span)

    def _cut(self, span: Local) -> Local:
        """A part of the current item, with what goes with it when it is cut out."""
        start, end = cut(self._data, *span.within(self._start))
        return self._local((max(start, self._start), end))

    def _local(self, span: Span) -> Local:
        """A part of the text as one of the current item."""
        return Local(span[0] - self._start, span[1] - self._start)

    def _bytes(self, span: Local) -> bytes:
        """What is written in a part of the current item."""
        return self._data[slice(*span.within(self._start))]

    def _text(self, span: Local) -> bytes:
        """The words in a part of the current item."""
        return b" ".join(self._bytes(span).split())

    def _only_once(self, keyword: str, span: Local, message: str, seen: dict[str, Placed] | None) -> bool:
        """Whether this is the first of what was `seen` in a block, or, without that, in the file; reports any other."""
        place = self._findings.place(span)
        if seen is None:
            known = self.known.get(keyword)
            first = place if known is None else known.place
            if known is None:
                self.known[keyword] = Known(keyword, place)
        else:
            first = seen.setdefault(keyword, place)
        if first == place:
            return True
        related = (Related(first, "the first one is here"),)
        detail = "only the first one counts" if keyword != "VARIABLES" else "all declarations stand in the first one"
        self._findings.add(catalogue.BLOCK_ALREADY_DEFINED, span, detail, fill=message, related=related)
        return False

    def _variables_known(self) -> Iterator[tuple[str, Known]]:
        return ((name, known) for name, known in self.known.items() if name.isidentifier() and name not in _KEYWORDS)

    def _near(self, name: str) -> str | None:
        """The variable that a name was probably meant to be."""
        entries = self.known.items()
        if len(self.known) != self._words_known:  # names are only ever added
            self._words_known = len(self.known)
            self._known = Names(other for other, _ in entries if other.isidentifier() and other not in _KEYWORDS)
        return self._known.nearest(name)

    def _lookup(self, name: ast.Name, wanted: str = "", also: str = "") -> Known | None:
        """What is known of a variable; reports an undeclared name, and what there is to say of it `also`."""
        known = self.known.get(name.text)
        if known is None and self.known.get(_lost(name.text)) is None:
            elsewhere = LANGUAGE.values_elsewhere.get(name.text.lower())
            near = self._near(name.text) if elsewhere is None else None
            if near is not None:
                detail = f"{name.text} is not declared before here; did you mean {near}?"
                fix = Fix(f"Replace with {near}", name.span, near)  # or it is a name that is yet to be declared
                # It is not unused, nor without a value, because its name is misspelt.
                meant = self.known[near]
                self.known[near] = meant._replace(assigned=True, used=True, unknown=meant.type in LANGUAGE.basics)
            else:
                detail, fix = f"{name.text} is not declared in a VARIABLES block before here{also}", None
                if elsewhere is not None:
                    detail += f"; {elsewhere}"
                colour = LANGUAGE.colours.get(name.text.lower()) if wanted == "VECTOR" else None
                if colour is not None:
                    detail += f"; there are no colours by name: {name.text} is {colour}"
                    fix = Fix(f"Write {colour}", name.span, colour)
            self._findings.add(catalogue.UNDEFINED_NAME, name.span, detail, fix=fix)
        return known

    def _has_type(self, name: ast.Name, wanted: str, also: str = "") -> bool:
        if not self._names:
            return True
        known = self._lookup(name, wanted, also)
        if known is None:
            return False
        if not known.type:
            return False
        related = (Related(known.place, "declared here"),)
        if known.type != wanted:
            detail = f"{name.text} is a {known.type}, and a {wanted} is expected"
            self._findings.add(catalogue.INCOMPATIBLE_TYPES, name.span, detail, related=related)
            return False
        if not known.assigned and not known.used:
            self._findings.add(
                catalogue.UNASSIGNED_VARIABLE, name.span, f"{name.text} still has its default value", related=related
            )
        if not known.used:
            self.known[name.text] = known._replace(used=True)
        return True

    def report_unused(self) -> None:
        """Report the variables that nothing has used, after the last item."""
        for name, known in self._variables_known():
            if not known.used and known.type:
                self._all.add_at(catalogue.UNUSED_VARIABLE, known.place, f"nothing uses {name}")

    def _assignment(self, item: ast.Assignment) -> program.Assignment | None:
        if not self._names:
            if item.body is not None:
                self._members(item.body, ANY_BODY)
            return None
        known = self._lookup(item.target)
        target = None if known is None else known.type
        value = item.value
        if known is not None:
            self.known[item.target.text] = known._replace(assigned=True, unknown=target in LANGUAGE.basics)
        block = LANGUAGE.blocks.get(target or "")
        body, broken = (None, _NONE) if item.body is None else self._members(item.body, block or ANY_BODY)
        if not target:
            return None
        if isinstance(value, ast.Name):
            if value.text == item.target.text:
                gone = item.span if item.body is None else Local(value.span.start, item.body.span.start)
                # That another name is meant can not be told where there is nothing else.
                title = f"Remove {'the assignment' if item.body is None else value.text}"
                fix = Fix(title, gone, "", certain=item.body is not None)
                self._findings.add(
                    catalogue.ASSIGNED_TO_ITSELF, value.span, f"{value.text} already has its own value", fix=fix
                )
                return None
            if not self._is_usable(value, target):
                return None
        elif value is not None and not self._fits(value, target):
            return None
        if body is not None and block is None:
            assert item.body is not None
            self._findings.add(
                catalogue.INCOMPATIBLE_TYPES, item.body.span, f"{item.target.text} is a {target}, not a structure"
            )
            return None
        self.known[item.target.text] = self.known[item.target.text]._replace(unknown=False)
        return program.Assignment(item.target, target, value, body, broken, item.span)

    def _fits(self, value: ast.Argument, target: str) -> bool:
        """Whether a constant can be assigned to a variable of the type; checks the names in a vector."""
        if isinstance(value, ast.Vector) and target == "VECTOR":
            return self._components(value)
        if isinstance(value, ast.Number) and target == "NUMBER":
            return _is_known(value)
        found = "a vector" if isinstance(value, ast.Vector) else "a number"
        if target in LANGUAGE.basics:
            self._findings.add(_EXPECTED[target.lower()], value.span, f"found {found}")
        else:
            self._findings.add(catalogue.INCOMPATIBLE_TYPES, value.span, f"found {found}, and a {target} is expected")
        return False

    def _components(self, vector: ast.Vector) -> bool:
        return _each(
            self._is_usable(c, "NUMBER") if isinstance(c, ast.Name) else _is_known(c) for c in vector.components
        )

    def _is_usable(self, name: ast.Name, wanted: str) -> bool:
        """Whether a name can stand for a constant: it has the type, and a value."""
        known = self.known.get(name.text)
        return self._has_type(name, wanted) and not (known and known.unknown)

    # --- blocks -------------------------------------------------------------------------------------------------

    def _block(self, item: ast.Block, entry: language.Block, seen: dict[str, Placed]) -> program.Block | None:
        first = True
        if entry.once is not None and self._names:
            inside = None if entry.keyword in LANGUAGE.top else seen
            first = self._only_once(entry.keyword, item.keyword.span, entry.once, inside)
        also = "; what a thing is called stands in a comment" if item.body is not None else ""
        known = item.name is None or self._has_type(item.name, entry.keyword, also)
        body, broken = ((), _NONE) if item.body is None else self._members(item.body, entry)
        if not first or not known:
            return None
        return program.Block(entry, item.name, body, broken, item.keyword, item.span)

    def _members(self, body: ast.Body, block: language.Block) -> tuple[tuple[program.Member, ...], frozenset[str]]:
        """The members of a body that are right, and the keywords of those that are not."""
        members: list[program.Member] = []
        broken: set[str] = set()
        seen: dict[str, Placed] = {}
        standing: dict[str, list[Local]] = {}
        said: set[str] = set()
        self._around.append(block.keyword)
        self._said_count = False
        for item in body.items:
            member = self._member(item, block, seen, said)
            if member is not None:
                members.append(member)
                self._weigh(member, block, standing)
            elif not isinstance(item, ast.Assignment):
                broken.add(item.keyword.text)
        self._around.pop()
        self._said_count = False
        return tuple(members), frozenset(broken)

    def _weigh(self, member: program.Member, block: language.Block, standing: dict[str, list[Local]]) -> None:
        """Report the members that a new one overwrites, or that it changes, of those standing by keyword."""
        keyword = member.entry.keyword
        if _overwrites(member, block):
            related = (Related(self._findings.place(member.span), "this one counts"),)
            for span in standing.get(keyword, ()):
                alike = self._text(span) == self._text(member.span)
                fix = Fix(f"Remove this {keyword}", self._cut(span), "", certain=alike)
                self._findings.add(catalogue.OVERWRITTEN, span, fill=keyword, related=related, fix=fix)
            standing[keyword] = [member.span]
        elif isinstance(member, program.Block) and _is_one_structure(member.entry):
            before = standing.setdefault(keyword, [])
            if before:
                related = (Related(self._findings.place(before[-1]), "it keeps what this one says"),)
                detail = "what it does not name stays as it was; one block can say it all"
                self._findings.add(
                    catalogue.CHANGES_THE_ONE_BEFORE, member.keyword.span, detail, fill=keyword, related=related
                )
            before.append(member.span)

    def _member(
        self, item: ast.Item, block: language.Block, seen: dict[str, Placed], said: set[str]
    ) -> program.Member | None:
        """One member, if it is right. What belongs into another block is reported once for all that does: `said`."""
        match item:
            case ast.Statement() if item.keyword.text in block.statements:
                return self._statement(item, block.statements[item.keyword.text], block)
            case ast.Table() if item.keyword.text in block.tables:
                return self._table(item, block.tables[item.keyword.text])
            case ast.Block() if item.keyword.text in block.holds:
                return self._block(item, LANGUAGE.blocks[item.keyword.text], seen)
            case ast.Assignment():
                self._invalid(block, item.target.span, "variables are assigned to outside of all blocks")
            case _:
                detail = self._wrong_form(item, block)
                _, stands, place = detail.partition(" stands in ")
                if not stands or place not in said:
                    self._invalid(block, item.keyword.span, detail)
                said.add(place)
        return None

    def _invalid(self, block: language.Block, span: Local, detail: str, fix: Fix[Local] | None = None) -> None:
        if block is ANY_BODY:
            self._findings.add(catalogue.INVALID_AT_TOP, span, detail, fix=fix)
        else:
            self._findings.add(catalogue.INVALID_IN_BLOCK, span, detail, fill=statement_of(block.keyword), fix=fix)

    def _wrong_form(self, item: ast.Statement | ast.Table | ast.Block | ast.Variables, block: language.Block) -> str:
        """Why an item does not belong: wrong keyword, or the right keyword in another form."""
        keyword = item.keyword.text
        if keyword in block.statements:
            return f"{keyword} {takes(block.statements[keyword])} here, not a block"
        if keyword in block.tables or keyword in block.holds:
            return f"{keyword} takes a block in braces here"
        return place_of(keyword, self._around)

    def _statement(
        self, item: ast.Statement, entry: language.Statement, block: language.Block
    ) -> program.Statement | None:
        wanted, given = entry.arguments, item.arguments
        good = True
        bare = len(wanted) == 1 and wanted[0].shape == "vector" and not any(isinstance(a, ast.Vector) for a in given)
        if bare and (len(given) > 2 or (len(given) == 2 and isinstance(given[0], ast.Number))):
            span = Local(given[0].span.start, given[-1].span.end)
            text = self._bytes(span).decode("utf-8", "replace")
            plain = len(given) == 3 and "/*" not in text
            fix = Fix(f"Write < {text} >", span, f"< {text} >", certain=True) if plain else None
            self._findings.add(catalogue.EXPECTED_VECTOR, span, "a vector stands between < and >", fix=fix)
            return None
        for expected, argument in zip(wanted, given, strict=False):
            good &= self._argument(argument, expected, entry)
        if len(given) > len(wanted):
            decimal = self._decimal_comma(given) if len(wanted) == 1 else None
            if decimal is not None:
                detail = f"{entry.keyword} {takes(entry)}; a decimal point is a point: {decimal.text}"
                self._invalid(block, decimal.span, detail, decimal)
                return None
            fix = self._flag_alone(item) if entry.is_flag else None
            self._invalid(block, given[len(wanted)].span, f"{entry.keyword} {takes(entry)}", fix)
            return None
        if len(given) < len(wanted):
            missing = wanted[len(given)]
            detail = f"{entry.keyword} {takes(entry)}; the {missing.name} is missing"
            end = given[-1].span.end if given else item.keyword.span.end
            if given and missing.shape != "vector":
                self._findings.add(catalogue.MISSING_MARK, Local(end, end), detail, fill=",")
            else:
                self._findings.add(_EXPECTED[missing.shape], item.keyword.span, detail)
            return None
        return program.Statement(entry, given, item.span) if good else None

    def _decimal_comma(self, given: tuple[ast.Argument, ...]) -> Fix[Local] | None:
        """What to write for `2,5`, if that is what stands there: maybe two numbers were meant."""
        span = Local(given[0].span.start, given[-1].span.end)
        text = self._bytes(span)
        if not _DECIMAL_COMMA.fullmatch(text):
            return None
        new = text.replace(b",", b".").decode()
        return Fix(f"Write {new}", span, new)

    def _flag_alone(self, item: ast.Statement) -> Fix[Local] | None:
        """The fix of a flag with an argument that says whether it is meant."""
        span = Local(item.keyword.span.end, item.arguments[-1].span.end)
        said = self._bytes(span).strip().lower()
        if said in _YES:
            return Fix(f"Write {item.keyword.text} alone", span, "", certain=True)
        return Fix(f"Leave {item.keyword.text} out", self._cut(item.span), "") if said in _NO else None

    def _argument(
        self, argument: ast.Argument, expected: language.Argument, entry: language.Statement | None = None
    ) -> bool:
        match argument:
            case ast.Name():
                return self._is_usable(argument, "VECTOR" if expected.shape == "vector" else "NUMBER")
            case ast.Vector() if expected.shape == "vector":
                return self._components(argument)
            case ast.Number() if expected.shape != "vector":
                return _is_known(argument)
            case _:
                found = "a vector" if isinstance(argument, ast.Vector) else "a number"
                self._findings.add(
                    _EXPECTED[expected.shape],
                    argument.span,
                    f"found {found}" + (f"; {entry.keyword} {takes(entry)}" if entry else ""),
                )
                return False

    # --- tables -------------------------------------------------------------------------------------------------

    def _table(self, item: ast.Table, entry: language.Table) -> program.Table:
        if item.bulk is not None:
            return self._bulk_table(item, entry, item.bulk)
        wanted = len(entry.head)
        head, rest = item.entries[:wanted], item.entries[wanted:]
        good = _each(self._argument(a, e) for a, e in zip(head, entry.head, strict=False))
        if len(head) < wanted:
            return self._short(item, entry, entry.head[len(head)])
        width = len(entry.row)
        rows = [rest[i : i + width] for i in range(0, len(rest), width)]
        for row in rows:
            good &= _each(self._argument(a, e) for a, e in zip(row, entry.row, strict=False))
        if rows and len(rows[-1]) < width:
            return self._short(item, entry, entry.row[len(rows[-1])])
        return program.Table(entry, None, 0, head, tuple(rows), item.keyword, item.span, broken=not good)

    def _bulk_table(self, item: ast.Table, entry: language.Table, bulk: Local) -> program.Table:
        head, row = _layout(entry.head), _layout(entry.row)
        data = read_table(self._data, *bulk.within(self._start), head, row)
        if data.stop is not None:
            self._table_stop(entry, data.stop, bulk, item.span.end - 1)
        broken = data.stop is not None
        return program.Table(entry, data, self._start, (), (), item.keyword, item.span, broken)

    def _table_stop(self, entry: language.Table, stop: Stop, bulk: Local, end: int) -> None:
        fault = table_fault(entry, self._data, *bulk.within(self._start))
        if fault is not None and stop.expected not in ("digit", "space", "*/"):
            fix = None if fault.fix is None else moved_fix(fault.fix, self._local)
            if not (fault.uncounted and self._said_count):
                self._findings.add(catalogue.EXPECTED_NUMBER, self._local(fault.span), fault.detail, fix=fix)
            self._said_count = self._said_count or fault.uncounted
            return
        start = min(stop.offset - self._start, end)
        found, fill = _STOPPED.get(stop.expected, (catalogue.MISSING_MARK, stop.expected))
        fix = self._digit_added(start) if stop.expected == "digit" else None
        self._findings.add(found, Local(start, start + 1), layout_of(entry), fill=fill, fix=fix)

    def _digit_added(self, place: int) -> Fix[Local] | None:
        """The fix for a numeral in a table that lacks a digit at a place of the item."""
        at = place + self._start
        before = _NUMERAL_END.search(self._data[max(at - _LONG_NUMERAL, 0) : at])
        after = _NUMERAL.match(self._data, at)
        assert before is not None
        assert after is not None
        text = before[0] + after[0]
        mended = numerals.mend(text)
        start = place - len(before[0])
        return None if mended is None else Fix(f"Write {mended}", Local(start, start + len(text)), mended, certain=True)

    def _short(self, item: ast.Table, entry: language.Table, missing: language.Argument) -> program.Table:
        """A table whose last row is not whole."""
        end = item.span.end
        self._findings.add(_EXPECTED[missing.shape], Local(end - 1, end), layout_of(entry))
        return program.Table(entry, None, 0, (), (), item.keyword, item.span, broken=True)


# What people write after a flag.
_YES = frozenset((b"1", b"on", b"true", b"yes"))
_NO = frozenset((b"0", b"off", b"false", b"no"))

_DECIMAL_COMMA = re.compile(rb"[+-]?[0-9]+,[0-9]+([eE][+-]?[0-9]+)?")
_NUMERAL = re.compile(rb"[^\s<>,{}]*")
_NUMERAL_END = re.compile(rb"[^\s<>,{}]*\Z")
_LONG_NUMERAL = 64  # bytes

# What is reported where a table of numbers stops fitting; elsewhere a punctuation mark is missing.
_STOPPED = {
    "number": (catalogue.EXPECTED_NUMBER, ""),
    "digit": (catalogue.EXPECTED_DIGIT, ""),
    "space": (catalogue.EXPECTED_DIGIT, ""),
    "<": (catalogue.EXPECTED_VECTOR, ""),
    "*/": (catalogue.UNBALANCED_COMMENT, ""),
}


def _overwrites(member: program.Member, block: language.Block) -> bool:
    """Whether a member takes the place of an earlier one with its keyword."""
    if isinstance(member, program.Table):
        return member.entry.keyword == "PROFILE"
    if isinstance(member, program.Block):
        return member.source is not None and _is_one_structure(member.entry)
    return not member.entry.is_flag and block.keyword != "TRANSFORM"


def _is_one_structure(entry: language.Block) -> bool:
    """Whether a block makes the one SURFACE or SOURCE there is: in braces it changes it, by name it replaces it. A
    TRANSFORM that a name replaces is found where transformations are made."""
    return entry.variable and not entry.adds and entry.keyword != "TRANSFORM"


def _is_known(number: ast.Number) -> bool:
    """Whether a number could be read; what is wrong with one that could not has been reported."""
    return not math.isnan(number.value)


def _each(checks: Iterable[bool]) -> bool:
    """Whether all are true, but every one is made, so that every one reports."""
    return sum(not check for check in checks) == 0


def _layout(arguments: tuple[language.Argument, ...]) -> str:
    return "".join("v" if argument.shape == "vector" else "n" for argument in arguments)


def structural_faults(source: Source) -> list[str]:
    """The codes of all that is wrong in the form of a text, names and values aside; none for a sentence of the
    formal grammar."""
    from ..syntax.parse import parse

    findings = Findings()
    syntax = parse(source, findings)
    checker = Checker(source, findings, names=False)
    for item in syntax.items:
        checker.item(item)
    errors = [diagnostic.code for diagnostic in findings.found if diagnostic.severity == "error"]
    return [code for code in errors if code not in _NOT_FORM]


# An empty file, a long name and a huge number are sentences of the grammar all the same.
_NOT_FORM = {catalogue.NAME_TOO_LONG.code, catalogue.EMPTY_FILE.code, catalogue.NUMBER_TOO_LARGE.code}


def check(
    source: Source,
    items: Iterable[ast.TopLevel],
    syntax: Syntax,
    findings: Findings,
    steps: Steps | None = None,
) -> Iterator[program.Item]:
    """All items of a scene in file order, each checked when it is asked for; `items` are those of the `syntax`.

    Of a doubtful item nothing is reported. With the `steps` of a run before, an item is checked only if it or what is
    known of its names has changed.
    """
    checker = Checker(source, findings, lost=syntax.names)
    for item in items:
        before = len(findings.found)
        if steps is None:
            content = checker.item(item)
        else:
            content = steps.do(item.base, item.item, partial(checker.item, item), findings, checker.known)
        if item.start in syntax.doubtful:
            del findings.found[before:]
        elif syntax.broken:
            # What could not be read may have given a variable its value.
            findings.found[before:] = [
                found for found in findings.found[before:] if found.code != catalogue.UNASSIGNED_VARIABLE.code
            ]
        if content is not None:
            yield program.Item(item.start, item.base, content)
    if not syntax.broken:
        checker.report_unused()


_KEYWORDS = LANGUAGE.keywords


def _lost(name: str) -> str:
    """The key of what is known of a name that a broken part of the text may declare or assign to."""
    return f"{name}?"
