"""What the compiler asks of a kind of primitive."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...columns.column import Column
from ...columns.rows import Rows
from ...diagnostics import Findings
from ..transform import Transform
from ..values import Record

Points: TypeAlias = NDArray[np.float64]
Tables: TypeAlias = Mapping[str, Mapping[str, NDArray[Any]]]


class Finish(Protocol):
    """Reports what does not hold of a whole block, and makes what follows from all its members together. `whole` is
    False for a variable that is still being put together."""

    def __call__(self, record: Record, findings: Findings, *, whole: bool) -> None: ...


class Ball(NamedTuple):
    """A ball in the scene: its centre (3) and radius."""

    centre: Points
    radius: float


class Field(NamedTuple):
    """A number, a yes or no, or a point or vector (3) in the dump, under its label."""

    label: str
    value: float | bool | Points


class Listing(NamedTuple):
    """How many things of a kind there are, under a label of the dump; and the first of them.

    Each is its three numbers, and the numbers of lines that belong below it.
    """

    label: str
    total: int
    first: Sequence[tuple[Sequence[float], Sequence[Sequence[float]]]]


class Fact(NamedTuple):
    """Something that an editor shows of a primitive: what it is, and its values; of a count, an int, how many."""

    what: str
    values: Sequence[float | Points]


class Primitive(NamedTuple):
    """A kind of primitive, as functions of its record and the transformation that takes it into the scene; or, once it
    is in the IR, of the tables and its row in the kind's own table."""

    tables: Mapping[str, Mapping[str, Column]]
    """The tables of the IR that it fills. The first is its own, with one row a primitive; kinds can share tables."""

    finish: Finish

    lower: Callable[[Rows, Record, Transform], int]
    """Adds it to the tables; returns its row in its own."""

    extent: Callable[[Tables], Iterable[Points]]
    """Arrays (n, 3) of points between which all of the kind lie; none for what is endless."""

    reach: Callable[[Record, Transform], float]
    """The largest coordinate, without its sign, of any point of it; NaN or infinite if it has none."""

    ball: Callable[[Record, Transform], Ball]
    """A ball about it; of an endless one, a point of it with radius 0."""

    reaches_into: Callable[[Record, Transform, Ball, Ball], bool]
    """Whether it, with the ball about it, may have points within another ball."""

    dump: Callable[[Tables, int, int | None], Iterator[Field | Listing]]
    """What the dump says of one, with at most so many entries of each listing."""

    facts: Callable[[Tables, int], Sequence[Sequence[Fact]]]
    """What an editor says of one, besides its extent: lines of facts."""

    is_endless: bool = False
    """Whether it has no end: no extent, no u and v, and nothing of it is out of a light's reach."""

    @property
    def table(self) -> str:
        """The name of its own table."""
        return next(iter(self.tables))
