"""The whole way from text to IR: `compile`, a pure function."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple, TypeVar

from .diagnostics import Diagnostic, Finding, Findings, catalogue
from .diagnostics.directives import without_allowed, wrong_directives
from .files.collection import paused
from .ir import SceneIR
from .ir.lower import lower
from .meaning.check import check
from .meaning.evaluate import Evaluator
from .meaning.lint import lint
from .meaning.program import Item
from .syntax.parse import parse
from .text.files import Files, files_of
from .text.source import Source
from .text.span import MAIN

T = TypeVar("T")


class Result(NamedTuple):
    """What compiling gave: the IR as far as it goes, and all diagnostics in the order of the text; `files` has the text
    that each stands in."""

    ir: SceneIR
    diagnostics: tuple[Diagnostic, ...]
    files: Files

    @property
    def source(self) -> Source:
        """The text of the scene."""
        return self.files.read(MAIN)

    @property
    def ok(self) -> bool:
        """Whether the IR is complete: no diagnostic is an error."""
        return not has_errors(self.diagnostics)

    def _repr_html_(self) -> str:
        from .notebook import result_html  # here, because only notebooks ask

        return result_html(self.diagnostics, self.files, self.ir)


@paused()
def compile(source: str | bytes | Source | Files, name: str = "") -> Result:
    """Compile a scene: a text, or MAIN of some files. Never raises on any text; `name` is what to call the text in the
    IR and in messages."""
    files = files_of(source, name)
    source = files.read(MAIN)
    findings = Findings()
    syntax = parse(source, findings)
    program: list[Item] = []
    world = Evaluator(findings).run(noted(check(source, syntax.items, syntax, findings), program), syntax.unfinished)
    ir = lower(world, source.name, syntax.places)
    if not has_errors(findings.found):
        lint(world, program, findings)
    return Result(ir, in_order(findings.diagnostics(syntax.places), source), files)


def noted(things: Iterable[T], notes: list[T]) -> Iterator[T]:
    """The same things; each is added to the notes as it passes."""
    for thing in things:
        notes.append(thing)
        yield thing


def has_errors(diagnostics: Sequence[Finding[Any]]) -> bool:
    """Whether a diagnostic is an error."""
    return any(diagnostic.severity == "error" for diagnostic in diagnostics)


def in_order(diagnostics: Iterable[Diagnostic], source: Source) -> tuple[Diagnostic, ...]:
    """Each diagnostic once, in the order of the text, but for those that the text allows."""
    found = sorted(dict.fromkeys([*diagnostics, *wrong_directives(source)]), key=lambda diagnostic: diagnostic.span)
    return tuple(without_allowed(_with_cause(found), source))


def _with_cause(found: list[Diagnostic]) -> list[Diagnostic]:
    """The diagnostics, where a variable without a value is out of range with both in one."""
    unassigned = {d.span: d for d in found if d.code == catalogue.UNASSIGNED_VARIABLE.code}
    wrong = {d.span for d in found if d.code == catalogue.OUT_OF_RANGE.code} & unassigned.keys()
    if not wrong:
        return found
    whole: list[Diagnostic] = []
    for diagnostic in found:
        if diagnostic.span not in wrong:
            whole.append(diagnostic)
        elif diagnostic.code != catalogue.UNASSIGNED_VARIABLE.code:
            cause = unassigned[diagnostic.span]
            detail = f"{diagnostic.detail}; {cause.detail}"
            whole.append(diagnostic._replace(detail=detail, related=(*diagnostic.related, *cause.related)))
    return whole
