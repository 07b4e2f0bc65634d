"""A scene that is being edited: all that is known of its text, found anew after each edit at the cost of what changed.

`compile` gives a result and forgets the rest; an editor asks for the rest.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from tree_sitter import Tree

from .compiler import Result, has_errors, in_order, noted
from .diagnostics import Diagnostic, Findings
from .files.collection import paused
from .ir import SceneIR
from .ir.lower import lower
from .meaning import program
from .meaning.check import check
from .meaning.evaluate import Evaluator, World
from .meaning.lint import lint
from .meaning.memo import Steps
from .syntax import ast
from .syntax.parse import Parsed, parse
from .text.places import Places
from .text.source import Source


@dataclass(frozen=True, eq=False)
class Analysis:
    """What each stage made of one text.

    Its `tree` is the concrete syntax tree of the text; `items` are the top-level items that could be read, and
    `program` those of them, in the same order, that are right as far as they go; `world.made` has an entry for each of
    `program`. Places in `items` and `program` count from their item; `places` tells where those that records in
    `world` keep are in the text.
    """

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
        return Result(self.ir, self.diagnostics, self.source)


class Analyser:
    """Analyses the versions of one scene, one after the other. Not to be shared by threads."""

    def __init__(self) -> None:
        self._parsed = Parsed()
        self._checks = Steps()
        self._runs = Steps()
        self._lints = Steps()

    @paused()
    def analyse(self, source: Source) -> Analysis:
        """All about a text: the same, whatever was analysed before. Never raises on any text."""
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
        return Analysis(source, syntax.tree, tuple(items), tuple(checked), world, syntax.places, diagnostics)
