"""A scene that is being edited: all that is known of its text, found anew after each edit at the cost of what changed.

`compile` gives a result and forgets the rest; an editor asks for the rest: what a number, a name or a block of the tree
is worth at its place (`Analysis.value_of`), and what the blocks around it have made (`Analysis.enclosing`). The answers
come from the run that found the diagnostics; only a matrix in the middle of a TRANSFORM block is computed when asked.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from tree_sitter import Tree

from m3d_language.table import Default

from .compiler import Result, has_errors, in_order, noted
from .diagnostics import Diagnostic, Findings
from .files.collection import paused
from .ir import SceneIR
from .ir.lower import lower
from .meaning import enclosing, program
from .meaning.check import check
from .meaning.evaluate import Evaluator, World, value_at_first
from .meaning.lint import lint
from .meaning.memo import Steps
from .meaning.transform import Transform
from .meaning.values import Record, TableValue, Value
from .syntax import ast
from .syntax.parse import Parsed, parse
from .text.files import Files, files_of
from .text.places import Places
from .text.source import Source
from .text.span import MAIN


class Enclosing(NamedTuple):
    """What the blocks around a node have made.

    `records` are theirs, the outermost first, as the run of the whole item left them; TRANSFORM blocks have none.
    `transform` is the matrix of the innermost record, within a TRANSFORM block that up to the end of the node. `path`
    leads to the node in the checked program; `is_variable` is whether all of it is the value of a variable.
    """

    records: tuple[Record, ...]
    transform: Transform
    path: enclosing.Path
    is_variable: bool

    @property
    def whole(self) -> Record:
        """The record of the top-level item."""
        return self.records[0]

    @property
    def innermost(self) -> Record:
        return self.records[-1]


class _Assigned(NamedTuple):
    """What a variable is worth after the assignment from `start` to `end`, and in its target."""

    start: int
    target_end: int
    end: int
    value: Value


@dataclass(frozen=True, eq=False)
class Analysis:
    """What each stage made of one text.

    Its `source` is the text of MAIN in `files`, and its `tree` the concrete syntax tree of that; `items` are the
    top-level items that could be read, and `program` those of them, in the same order, that are right as far as they
    go; `world.made` has an entry for each of `program`. Places in `items` and `program` count from their item; `places`
    tells where those that the records in `world` keep are in the text.
    """

    files: Files
    source: Source
    tree: Tree
    items: tuple[ast.TopLevel, ...]
    program: tuple[program.Item, ...]
    world: World
    places: Places
    diagnostics: tuple[Diagnostic, ...]

    @cached_property
    def ok(self) -> bool:
        """Whether no diagnostic is an error."""
        return not has_errors(self.diagnostics)

    @cached_property
    def ir(self) -> SceneIR:
        """The scene's IR, as far as it goes; made when it is first asked for."""
        with paused():
            return lower(self.world, self.source.name, self.places)

    @property
    def result(self) -> Result:
        """What `compile` gives for the text."""
        return Result(self.ir, self.diagnostics, self.files)

    # --- asking ---------------------------------------------------------------------------------------------------

    def value_of(self, at: ast.Located) -> Value | None:
        """What a node is worth at its place: an argument its number or vector, a name the variable's value, an
        assignment the value that it gives, a block its record. None where that is not known, because something is
        wrong, nothing was assigned, or the block is a TRANSFORM, which has no record."""
        match at.node:
            case ast.Number() | ast.Name() | ast.Vector():
                return self.value(at.node, at.span[0])
            case ast.Assignment(target=target):
                return self.variable(target.text, at.top.place(target.span)[0])
            case ast.Block():
                here = self.enclosing(at)
                own = here is not None and here.path.owners[-1].span == at.node.span
                return here.innermost if here is not None and own else None
            case _:
                return None

    def statement_value(self, at: ast.Located) -> Default:
        """What a block holds of a statement in it: of several arguments a tuple, of a flag whether it is set. None
        where the statement is wrong, or a later one has replaced it."""
        here = self.enclosing(at)
        if here is None or not isinstance(at.node, ast.Statement):
            return None
        record, keyword = here.innermost, at.node.keyword.text
        return record.values.get(keyword) if record.places.get(keyword) == here.path.place(at.node.span) else None

    def table_value(self, at: ast.Located) -> TableValue | None:
        """What a block holds of a table in it. None where the table is wrong, or a later one has replaced it."""
        here = self.enclosing(at)
        if here is None or not isinstance(at.node, ast.Table):
            return None
        table = here.innermost.tables.get(at.node.keyword.text)
        return table if table is not None and table.span == here.path.place(at.node.span) else None

    def value(self, argument: ast.Argument, offset: int) -> Value | None:
        """What an argument that begins at a byte of the text is worth."""
        match argument:
            case ast.Number():
                return argument.value if math.isfinite(argument.value) else None
            case ast.Name():
                return self.variable(argument.text, offset)
            case ast.Vector():
                values = (self.value(component, offset) for component in argument.components)
                numbers = [float(value) for value in values if isinstance(value, (int, float))]
                return (numbers[0], numbers[1], numbers[2]) if len(numbers) == 3 else None

    def variable(self, name: str, offset: int) -> Value | None:
        """What a variable is worth in the statement at a byte of the text; in the target of an assignment, what it is
        worth after it. None where nothing that could be read was assigned to it before."""
        assigned = self._assigned.get(name, [])
        number = bisect_right(assigned, offset, key=lambda each: each.start)
        for each in reversed(assigned[max(number - 2, 0) : number]):
            if offset >= each.end or offset <= each.target_end:
                return each.value
        return None

    def enclosing(self, at: ast.Located) -> Enclosing | None:
        """What the blocks around a node have made, itself among them. None at top level, and where what is there is
        wrong."""
        number = bisect_right(self.program, at.top.start, key=lambda item: item.start) - 1
        if number < 0 or self.program[number].start != at.top.start:
            return None
        made = self.world.made[number]
        path = enclosing.path_to(self.program[number], at.node.span)
        records = None if path is None else enclosing.records(path, made)
        if path is None or records is None:
            return None
        transform = records[-1].transform
        if path.in_transform:
            evaluator = Evaluator(Findings(), self._variables_before(number))
            transform = evaluator.transform(enclosing.transforming(path)) or transform
        return Enclosing(records, transform, path, made.value is not None)

    @cached_property
    def _assigned(self) -> dict[str, list[_Assigned]]:
        """The values of each variable, in the order of the text."""
        found: dict[str, list[_Assigned]] = {}
        for item, made in zip(self.program, self.world.made, strict=True):
            content = item.content
            if isinstance(content, program.Assignment) and made.value is not None:
                (_, end), (_, target_end) = content.span.within(item.start), content.target.span.within(item.start)
                found.setdefault(content.target.text, []).append(_Assigned(item.start, target_end, end, made.value))
        return found

    def _variables_before(self, number: int) -> dict[str, Value]:
        """The value of every variable before an item of the program."""
        values: dict[str, Value] = {}
        for item, made in zip(self.program[:number], self.world.made, strict=False):
            content = item.content
            if isinstance(content, program.Assignment):
                if made.value is not None:
                    values[content.target.text] = made.value
            elif not isinstance(content, program.Block):
                values |= {each.name.text: value_at_first(each.type, each.name.span.at(item.base)) for each in content}
        return values


class Analyser:
    """Analyses the versions of one scene, one after the other. Not to be shared by threads."""

    def __init__(self) -> None:
        self._parsed = Parsed()
        self._checks = Steps()
        self._runs = Steps()
        self._lints = Steps()

    @paused()
    def analyse(self, scene: Source | Files) -> Analysis:
        """All about a scene: the same, whatever was analysed before. Never raises on any text."""
        files = files_of(scene)
        source = files.read(MAIN)
        findings = Findings()
        self._checks.begin()
        self._runs.begin()
        syntax = parse(source, findings, self._parsed)
        items: list[ast.TopLevel] = []
        checked: list[program.Item] = []
        right = check(source, noted(syntax.items, items), syntax, findings, self._checks)
        world = Evaluator(findings).run(noted(right, checked), syntax.unfinished, self._runs)
        if not has_errors(findings.found):
            self._lints.begin()
            lint(world, checked, findings, self._lints)
        diagnostics = in_order(findings.diagnostics(syntax.places), source)
        return Analysis(files, source, syntax.tree, tuple(items), tuple(checked), world, syntax.places, diagnostics)
