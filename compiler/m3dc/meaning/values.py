"""What variables and members hold while a scene is evaluated: numbers, vectors, and records for structures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias, overload

import numpy as np
from numpy.typing import NDArray

from m3d_language.table import LANGUAGE, Default

from ..text.span import Placed
from .transform import IDENTITY, Transform

Vector: TypeAlias = tuple[float, float, float]
Value: TypeAlias = "float | Vector | Record"


def spelled(number: float) -> str:
    """A number as a scene has it, in as few digits as tell it from all others."""
    short = f"{number:g}"
    return short if float(short) == number else repr(number)


class TableValue(NamedTuple):
    """The numbers of a table: `rows` (n, width) as written; `offsets` (n) is how far after the beginning of `span`
    each row starts."""

    head: tuple[int, ...]
    rows: NDArray[np.float64]
    offsets: NDArray[np.uint32 | np.int64]
    span: Placed

    def place(self, row: int) -> Placed:
        """Where a row begins."""
        at = self.span.start + int(self.offsets[row])
        return Placed(at, at + 1)


class Mesh(NamedTuple):
    """Triangular facets between vertices, in the primitive's own coordinates.

    `facets` (m, 3) are rows of `vertices` (n, 3); `normals` (k, 3) unit vectors at the corners that `normal_rows`
    (m, 3) name, both empty for flat facets; `offsets` (m) is how far after the beginning of the `table` each
    facet is written.
    """

    vertices: NDArray[np.float64]
    facets: NDArray[np.int32]
    normals: NDArray[np.float64]
    normal_rows: NDArray[np.int32]
    offsets: NDArray[np.uint32 | np.int64]
    table: Placed

    def place(self, facet: int) -> Placed:
        """Where a facet is written."""
        at = self.table.start + int(self.offsets[facet])
        return Placed(at, at + 1)


class Parts(Sequence["Record"]):
    """Parts of a record: those it was copied with, which are shared, and those that were added. What is added one by
    one, each time to a copy, takes no more memory than is written."""

    __slots__ = ("_added", "_before", "_length")

    def __init__(self, before: Sequence[Record], added: tuple[Record, ...]) -> None:
        self._before = before
        self._added = added
        self._length = len(before) + len(added)

    def __len__(self) -> int:
        return self._length

    def __iter__(self) -> Iterator[Record]:
        later: list[tuple[Record, ...]] = []
        parts: Sequence[Record] = self
        while isinstance(parts, Parts):
            later.append(parts._added)
            parts = parts._before
        yield from parts
        for added in reversed(later):
            yield from added

    @overload
    def __getitem__(self, index: int) -> Record: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Record]: ...
    def __getitem__(self, index: int | slice) -> Record | Sequence[Record]:
        if isinstance(index, int) and -len(self._added) <= index < 0:
            return self._added[index]
        return tuple(self)[index]


class Record:
    """The value of a block: its members so far, and where it stands, as places among all items.

    `values` are the statements' arguments by keyword (a flag is a bool), `places` where each was last written;
    `nested` are the blocks there is one of (SURFACE, VIEW, ...), `parts` those there are many of (primitives,
    textures, waves); `transform` is the product of all TRANSFORM blocks, or, for a TRANSFORM, its own. `broken` are
    the keywords of members that were wrong, of which no more is to be said; `idle` those of statements that had no
    effect when they were written (effects.py); `mesh` is what VERTICES and FACETS make.
    """

    __slots__ = (
        "block",
        "broken",
        "idle",
        "mesh",
        "nested",
        "parts",
        "places",
        "span",
        "tables",
        "transform",
        "values",
    )

    def __init__(self, block: str, span: Placed) -> None:
        self.block = block
        self.span = span
        self.values: dict[str, Default] = dict(_DEFAULTS[block])
        self.places: dict[str, Placed] = {}
        self.nested: dict[str, Record] = {}
        self.parts: Sequence[Record] = ()
        self.tables: dict[str, TableValue] = {}
        self.transform: Transform = IDENTITY
        self.broken: frozenset[str] = frozenset()
        self.idle: frozenset[str] = frozenset()
        self.mesh: Mesh | None = None

    def copy(self, span: Placed) -> Record:
        """An independent copy, as an assignment makes: a later change to the original does not reach it."""
        new = Record.__new__(Record)
        new.block = self.block
        new.span = span
        new.values = dict(self.values)
        new.places = dict(self.places)
        new.nested = {keyword: record.copy(record.span) for keyword, record in self.nested.items()}
        new.parts = self.parts  # never changed once they are part of something
        new.tables = dict(self.tables)
        new.transform = self.transform
        new.broken = self.broken
        new.idle = self.idle
        new.mesh = self.mesh
        return new

    def number(self, keyword: str) -> float:
        value = self.values[keyword]
        assert isinstance(value, (int, float))
        return float(value)

    def integer(self, keyword: str) -> int:
        return int(self.number(keyword))

    def flag(self, keyword: str) -> bool:
        return bool(self.values.get(keyword, False))

    def vector(self, keyword: str) -> Vector:
        value = self.values[keyword]
        assert isinstance(value, tuple)
        x, y, z = value
        return float(x), float(y), float(z)

    def place(self, keyword: str) -> Placed:
        """Where a member was written, or the whole record where it was not."""
        return self.places.get(keyword, self.span)

    def member(self, block: str) -> Record:
        """The nested block, with its default values where the scene has none."""
        return self.nested.get(block) or Record(block, self.span)


_DEFAULTS: dict[str, dict[str, Default]] = {
    keyword: {s.keyword: s.default for s in block.statements.values() if s.default is not None}
    for keyword, block in LANGUAGE.blocks.items()
}
