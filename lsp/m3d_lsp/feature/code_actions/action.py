"""What a code action is, and where it is asked for."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple

from lsprotocol import types

from m3dc import Diagnostic
from m3dc.analysis import Analysis
from m3dc.syntax.parse import ast
from m3dc.text.span import Local

from ...snapshot import Snapshot
from ...text import Span

# Text in place of a range of bytes. Edits do not overlap; those that insert at one place do so in their order.
Edit = tuple[Span, str]


class Action(NamedTuple):
    """`edits` make the change; where it takes long to find them, `later` does, once the action is chosen. `mends` are
    the diagnostics that it does away with; `preferred` is whether it certainly is what the author meant, as a certain
    `Fix` is."""

    title: str
    kind: types.CodeActionKind
    edits: list[Edit]
    mends: tuple[Diagnostic, ...] = ()
    preferred: bool = False
    later: Callable[[], list[Edit]] | None = None


class Site:
    """The place at which actions are asked for: a range of bytes, empty for a cursor."""

    def __init__(self, snapshot: Snapshot, span: Span) -> None:
        self.snapshot = snapshot
        self.span = span
        self.data = snapshot.text.data

    @property
    def analysis(self) -> Analysis:
        return self.snapshot.analysis

    @cached_property
    def found(self) -> tuple[Diagnostic, ...]:
        """The diagnostics at the place."""
        start, end = self.span
        return tuple(d for d in self.analysis.diagnostics if d.span.start <= end and d.span.end >= start)

    @cached_property
    def node(self) -> ast.Located | None:
        """The innermost node of the tree that holds the place."""
        return ast.locate(self.analysis.items, self.span)

    @property
    def top(self) -> ast.TopLevel | None:
        """The top-level item that holds the place."""
        return None if self.node is None else self.node.top

    @cached_property
    def path(self) -> tuple[ast.Item, ...]:
        """The items that hold the place, from the top-level one inwards."""
        return () if self.node is None else self.node.path

    @cached_property
    def is_sound(self) -> bool:
        """Whether the top-level item has no error."""
        if self.top is None:
            return False
        start, end = self.real(self.top.item.span)
        errors = (d.span for d in self.analysis.diagnostics if d.severity == "error")
        return not any(error.start < end and error.end > start for error in errors)

    def real(self, span: Local) -> Span:
        """Where a part of the top-level item stands in the text."""
        assert self.top is not None
        return self.top.place(span)

    def text(self, span: Span) -> str:
        """The text in a range of bytes."""
        return self.snapshot.text.part(span)

    def at(self, offset: int) -> Site:
        """The same document at another place."""
        return Site(self.snapshot, (offset, offset))
