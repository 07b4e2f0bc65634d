"""Checks the syntax tree against the language table and the declared names: syntax tree in, checked program out.

Nothing here needs a value: which keyword may stand where, how many arguments of what shape it takes, which names are
declared and with what type. Values out of range are the evaluator's business, for only it knows them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from difflib import get_close_matches

from tree_sitter_m3d import Stop, read_table
from tree_sitter_m3d import table as language
from tree_sitter_m3d.table import LANGUAGE

from . import ast, program
from .diagnostics import Findings, Fix, Related
from .ir import Span
from .source import Source

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
_SHAPE_CODE = {"vector": "M3D0102", "number": "M3D0103", "integer": "M3D0103"}


class Checker:
    """Walks the items of one scene in file order. With `names=False` it checks form alone: that is what the formal
    grammar can tell, which knows no declarations."""

    def __init__(self, source: Source, findings: Findings, *, names: bool = True) -> None:
        self._data = source.data
        self._findings = findings
        self._names = names
        self._base = 0
        self._types: dict[str, str] = {}
        self._declared_at: dict[str, Span] = {}
        self._assigned: set[str] = set()
        self._used: set[str] = set()
        self._once: dict[str, Span] = {}
        self._unknown: set[str] = set()  # numbers and vectors whose last assignment was wrong: no more is said of them

    def item(self, top: ast.TopLevel) -> program.Item | None:
        """One top-level item; None where nothing of it can be used."""
        self._base = self._findings.base = top.start
        content = self._content(top.item)
        return None if content is None else program.Item(top.start, content)

    def _content(self, item: ast.Item) -> tuple[program.Declaration, ...] | program.Assignment | program.Block | None:
        match item:
            case ast.Variables():
                return self._variables(item)
            case ast.Assignment():
                return self._assignment(item)
            case ast.Block() if item.keyword.text in LANGUAGE.top:
                return self._block(item, LANGUAGE.blocks[item.keyword.text], {})
            case _:
                self._findings.add("M3D0107", item.keyword.span, self._misplaced(item.keyword.text))
                return None

    # --- variables ----------------------------------------------------------------------------------------------

    def _variables(self, item: ast.Variables) -> tuple[program.Declaration, ...]:
        if self._names:
            self._only_once("VARIABLES", item.keyword.span, LANGUAGE.variables["once"], self._once)
        declared: list[program.Declaration] = []
        for declaration in item.declarations:
            type_ = declaration.type.text
            if type_ not in LANGUAGE.types:
                near = get_close_matches(type_, LANGUAGE.types, 1, 0.7)
                hint = f"; did you mean {near[0]}?" if near else f"; the types are {', '.join(LANGUAGE.types)}"
                fix = Fix(f"Replace with {near[0]}", declaration.type.span, near[0]) if near else None
                self._findings.add("M3D0109", declaration.type.span, f"{type_} is not a type{hint}", fix=fix)
                continue
            for name in declaration.names:
                if name.text in self._types and self._names:
                    first = self._declared_at[name.text]
                    self._findings.add(
                        "M3D0201",
                        name.span,
                        f"{name.text} is already a {self._types[name.text]}",
                        related=(Related(first, "first declared here"),),
                    )
                    continue
                self._types[name.text] = type_
                self._declared_at[name.text] = self._findings.absolute(name.span)
                declared.append(program.Declaration(name, type_))
        return tuple(declared)

    def _only_once(self, keyword: str, span: Span, message: str, seen: dict[str, Span]) -> bool:
        """Whether this is the first; reports any other."""
        if keyword in seen:
            related = (Related(seen[keyword], "the first one is here"),)
            self._findings.add("M3D0301", span, "only the first one counts", fill=message, related=related)
            return False
        seen[keyword] = self._findings.absolute(span)
        return True

    def _type_of(self, name: ast.Name) -> str | None:
        """The declared type; reports an undeclared name."""
        type_ = self._types.get(name.text)
        if type_ is None:
            near = get_close_matches(name.text, self._types, 1, 0.7)
            if near:
                detail = f"{name.text} is not declared before here; did you mean {near[0]}?"
                fix = Fix(f"Replace with {near[0]}", name.span, near[0])
            else:
                detail, fix = f"{name.text} is not declared in a VARIABLES block before here", None
            self._findings.add("M3D0202", name.span, detail, fix=fix)
        return type_

    def _has_type(self, name: ast.Name, wanted: str) -> bool:
        if not self._names:
            return True
        type_ = self._type_of(name)
        if type_ is None:
            return False
        if type_ != wanted:
            related = (Related(self._declared_at[name.text], "declared here"),)
            detail = f"{name.text} is a {type_}, and a {wanted} is expected"
            self._findings.add("M3D0203", name.span, detail, related=related)
            return False
        if name.text not in self._assigned | self._used:
            related = (Related(self._declared_at[name.text], "declared here"),)
            self._findings.add("M3D0504", name.span, f"{name.text} still has its default value", related=related)
        self._used.add(name.text)
        return True

    def report_unused(self) -> None:
        """Report the variables that nothing has used, after the last item."""
        self._findings.base = 0
        for name, place in self._declared_at.items():
            if name not in self._used:
                self._findings.add("M3D0503", place, f"nothing uses {name}")

    def _assignment(self, item: ast.Assignment) -> program.Assignment | None:
        if not self._names:
            if item.body is not None:
                self._members(item.body, ANY_BODY)
            return None
        target = self._type_of(item.target)
        value = item.value
        self._assigned.add(item.target.text)
        if target in LANGUAGE.basics:
            self._unknown.add(item.target.text)
        block = LANGUAGE.blocks.get(target or "")
        body, broken = (None, _NONE) if item.body is None else self._members(item.body, block or ANY_BODY)
        if target is None:
            return None
        if isinstance(value, ast.Name):
            if value.text == item.target.text:
                self._findings.add("M3D0204", value.span, f"{value.text} already has its own value")
                return None
            if not self._has_type(value, target) or value.text in self._unknown:
                return None
        elif value is not None and not self._fits(value, target):
            return None
        if body is not None and block is None:
            assert item.body is not None
            self._findings.add("M3D0203", item.body.span, f"{item.target.text} is a {target}, not a structure")
            return None
        self._unknown.discard(item.target.text)
        return program.Assignment(item.target, target, value, body, broken, item.span)

    def _fits(self, value: ast.Argument, target: str) -> bool:
        """Whether a constant can be assigned to a variable of the type; checks the names in a vector."""
        if isinstance(value, ast.Vector) and target == "VECTOR":
            return self._components(value)
        if isinstance(value, ast.Number) and target == "NUMBER":
            return _is_known(value)
        found = "a vector" if isinstance(value, ast.Vector) else "a number"
        if target in LANGUAGE.basics:
            self._findings.add(_SHAPE_CODE[target.lower()], value.span, f"found {found}")
        else:
            self._findings.add("M3D0203", value.span, f"found {found}, and a {target} is expected")
        return False

    def _components(self, vector: ast.Vector) -> bool:
        return _each(
            self._is_usable(c, "NUMBER") if isinstance(c, ast.Name) else _is_known(c) for c in vector.components
        )

    def _is_usable(self, name: ast.Name, wanted: str) -> bool:
        """Whether a name can stand for a constant: it has the type, and a value."""
        return self._has_type(name, wanted) and name.text not in self._unknown

    # --- blocks -------------------------------------------------------------------------------------------------

    def _block(self, item: ast.Block, entry: language.Block, seen: dict[str, Span]) -> program.Block | None:
        first = True
        if entry.once is not None and self._names:
            seen = self._once if entry.keyword in LANGUAGE.top else seen
            first = self._only_once(entry.keyword, item.keyword.span, entry.once, seen)
        known = item.name is None or self._has_type(item.name, entry.keyword)
        body, broken = ((), _NONE) if item.body is None else self._members(item.body, entry)
        if not first or not known:
            return None
        return program.Block(entry, item.name, body, broken, item.keyword, item.span)

    def _members(self, body: ast.Body, block: language.Block) -> tuple[tuple[program.Member, ...], frozenset[str]]:
        """The members of a body that are right, and the keywords of those that are not."""
        members: list[program.Member] = []
        broken: set[str] = set()
        seen: dict[str, Span] = {}
        overwritten: dict[str, Span] = {}
        for item in body.items:
            member = self._member(item, block, seen)
            if member is not None:
                members.append(member)
                if _overwrites(member, block):
                    keyword = member.entry.keyword
                    if keyword in overwritten:
                        related = (Related(self._findings.absolute(member.span), "this one counts"),)
                        self._findings.add("M3D0512", overwritten[keyword], fill=keyword, related=related)
                    overwritten[keyword] = member.span
            elif not isinstance(item, ast.Assignment):
                broken.add(item.keyword.text)
        return tuple(members), frozenset(broken)

    def _member(self, item: ast.Item, block: language.Block, seen: dict[str, Span]) -> program.Member | None:
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
                self._invalid(block, item.keyword.span, self._wrong_form(item, block))
        return None

    def _invalid(self, block: language.Block, span: Span, detail: str) -> None:
        if block is ANY_BODY:
            self._findings.add("M3D0107", span, detail)
        else:
            self._findings.add("M3D0106", span, detail, fill=statement_of(block.keyword))

    def _wrong_form(self, item: ast.Statement | ast.Table | ast.Block | ast.Variables, block: language.Block) -> str:
        """Why an item does not belong: wrong keyword, or the right keyword in another form."""
        keyword = item.keyword.text
        if keyword in block.statements:
            return f"{keyword} takes {_takes(block.statements[keyword])} here, not a block"
        if keyword in block.tables or keyword in block.holds:
            return f"{keyword} takes a block in braces here"
        return self._misplaced(keyword)

    def _misplaced(self, keyword: str) -> str:
        if keyword in LANGUAGE.reserved:
            return f"{keyword} is reserved, but has no meaning"
        if keyword in LANGUAGE.top:
            return f"{keyword} stands at the top level of the file"
        parents = LANGUAGE.parents.get(keyword, ())
        return f"{keyword} stands in {', '.join(parents)}" if parents else f"{keyword} can not stand here"

    def _statement(
        self, item: ast.Statement, entry: language.Statement, block: language.Block
    ) -> program.Statement | None:
        wanted, given = entry.arguments, item.arguments
        good = True
        for expected, argument in zip(wanted, given, strict=False):
            good &= self._argument(argument, expected)
        if len(given) > len(wanted):
            self._invalid(block, given[len(wanted)].span, f"{entry.keyword} takes {_takes(entry)}")
            return None
        if len(given) < len(wanted):
            missing = wanted[len(given)]
            detail = f"{entry.keyword} takes {_takes(entry)}; the {missing.name} is missing"
            end = given[-1].span[1] if given else item.keyword.span[1]
            if given and missing.shape != "vector":
                self._findings.add("M3D0101", (end, end), detail, fill=",")
            else:
                self._findings.add(_SHAPE_CODE[missing.shape], item.keyword.span, detail)
            return None
        return program.Statement(entry, given, item.span) if good else None

    def _argument(self, argument: ast.Argument, expected: language.Argument) -> bool:
        match argument:
            case ast.Name():
                return self._is_usable(argument, "VECTOR" if expected.shape == "vector" else "NUMBER")
            case ast.Vector() if expected.shape == "vector":
                return self._components(argument)
            case ast.Number() if expected.shape != "vector":
                return _is_known(argument)
            case _:
                found = "a vector" if isinstance(argument, ast.Vector) else "a number"
                self._findings.add(_SHAPE_CODE[expected.shape], argument.span, f"found {found}")
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

    def _bulk_table(self, item: ast.Table, entry: language.Table, bulk: Span) -> program.Table:
        head, row = _layout(entry.head), _layout(entry.row)
        data = read_table(self._data, bulk[0] + self._base, bulk[1] + self._base, head, row)
        if data.stop is not None:
            self._table_stop(entry, data.stop, item.span[1] - 1)
        broken = data.stop is not None
        return program.Table(entry, data, self._base, (), (), item.keyword, item.span, broken)

    def _table_stop(self, entry: language.Table, stop: Stop, end: int) -> None:
        start = min(stop.offset - self._base, end)
        code, fill = _STOP_CODE.get(stop.expected, ("M3D0101", stop.expected))
        self._findings.add(code, (start, start + 1), _table_detail(entry), fill=fill)

    def _short(self, item: ast.Table, entry: language.Table, missing: language.Argument) -> program.Table:
        """A table whose last row is not whole."""
        end = item.span[1]
        self._findings.add(_SHAPE_CODE[missing.shape], (end - 1, end), _table_detail(entry))
        return program.Table(entry, None, 0, (), (), item.keyword, item.span, broken=True)


# What is reported where a table of numbers stops fitting; elsewhere a punctuation mark is missing.
_STOP_CODE = {
    "number": ("M3D0103", ""),
    "digit": ("M3D0104", ""),
    "space": ("M3D0104", ""),
    "<": ("M3D0102", ""),
    "*/": ("M3D0105", ""),
}


def statement_of(block: str) -> str:
    """What the thesis calls a statement of a block: those of all textures alike."""
    return "TEXTURE Info" if block in LANGUAGE.blocks["TEXTURE"].holds else block


def _overwrites(member: program.Member, block: language.Block) -> bool:
    """Whether a member takes the place of an earlier one with its keyword."""
    if isinstance(member, program.Table):
        return member.entry.keyword == "PROFILE"
    return isinstance(member, program.Statement) and not member.entry.is_flag and block.keyword != "TRANSFORM"


def _is_known(number: ast.Number) -> bool:
    """Whether a number could be read; what is wrong with one that could not has been reported."""
    return not math.isnan(number.value)


def _each(checks: Iterable[bool]) -> bool:
    """Whether all are true, but every one is made, so that every one reports."""
    return sum(not check for check in checks) == 0


def _layout(arguments: tuple[language.Argument, ...]) -> str:
    return "".join("v" if argument.shape == "vector" else "n" for argument in arguments)


def _takes(entry: language.Statement) -> str:
    if entry.is_flag:
        return "no argument"
    return ", ".join(f"a {a.name.replace('_', ' ')} ({a.shape})" for a in entry.arguments)


def _table_detail(entry: language.Table) -> str:
    row = " ".join(f"<{a.name}>" if a.shape == "vector" else a.name for a in entry.row).replace("_", " ")
    head = " ".join(a.name for a in entry.head)
    return f"{entry.keyword} holds {head + ' and then ' if head else ''}rows of {row}"


def structural_faults(source: Source) -> list[str]:
    """The codes of all that is wrong in the form of a text, names and values aside; none for a sentence of the
    formal grammar."""
    from .syntax import parse

    findings = Findings()
    syntax = parse(source, findings)
    checker = Checker(source, findings, names=False)
    for item in syntax.items:
        checker.item(item)
    errors = [diagnostic.code for diagnostic in findings.found if diagnostic.severity == "error"]
    found = [code for code in errors if code not in _NOT_FORM]
    return found or (["M3D0107"] if syntax.faulty else [])


# An empty file, a long name and a huge number are sentences of the grammar all the same.
_NOT_FORM = {"M3D0110", "M3D0112", "M3D0114"}


def check(
    source: Source, items: Iterable[ast.TopLevel], faulty: frozenset[int], findings: Findings
) -> Iterator[program.Item]:
    """All items of a scene in file order, each checked when it is asked for.

    In a faulty item only what is certain is reported: nothing but its names.
    """
    checker = Checker(source, findings)
    for item in items:
        before = len(findings.found)
        result = checker.item(item)
        if item.start in faulty:
            del findings.found[before:]
        if result is not None:
            yield result
    if not faulty:
        checker.report_unused()
    findings.base = 0
