"""The whole way from text to IR: `compile`, a pure function."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from .check import check
from .collection import paused
from .diagnostics import Diagnostic, Findings
from .directives import without_allowed
from .evaluate import Evaluator
from .ir import SceneIR
from .lint import lint
from .lower import lower
from .places import Places
from .source import Source
from .syntax import parse


class Result(NamedTuple):
    """What compiling gave: the IR as far as it goes, and all diagnostics in the order of the text."""

    ir: SceneIR
    diagnostics: tuple[Diagnostic, ...]
    source: Source

    @property
    def ok(self) -> bool:
        """Whether the IR is complete: no diagnostic is an error."""
        return not has_errors(self.diagnostics)

    def _repr_html_(self) -> str:
        from .notebook import result_html  # here, because only notebooks ask

        return result_html(self)


@paused()
def compile(source: str | bytes | Source, name: str = "") -> Result:
    """Compile a scene. Never raises on any text; `name` is what to call it in the IR and in messages."""
    if not isinstance(source, Source):
        source = Source(source.encode() if isinstance(source, str) else source, name)
    findings = Findings()
    syntax = parse(source, findings)
    program = check(source, syntax.items, syntax.faulty, findings)
    world = Evaluator(findings).run(program, syntax.faulty)
    ir = lower(world, source.name, Places())
    if not has_errors(findings.found):
        lint(world, findings)
    return Result(ir, in_order(findings.found, source), source)


def has_errors(diagnostics: Sequence[Diagnostic]) -> bool:
    """Whether a diagnostic is an error."""
    return any(diagnostic.severity == "error" for diagnostic in diagnostics)


def in_order(diagnostics: Iterable[Diagnostic], source: Source) -> tuple[Diagnostic, ...]:
    """Each diagnostic once, in the order of the text, but for those that the text allows."""
    found = sorted(dict.fromkeys(diagnostics), key=lambda diagnostic: diagnostic.span)
    return tuple(without_allowed(found, source))
