"""Tables of the IR while rows are added to them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..text.places import Places
from .column import Column


class Rows:
    """Tables of the IR while they grow: rows one by one, or columns of many rows at once. `tables` says what columns
    they have; `places`, which byte of the text a place is."""

    def __init__(self, tables: Mapping[str, Mapping[str, Column]], places: Places) -> None:
        self.places = places
        self._columns = tables
        self._rows: dict[str, list[dict[str, Any]]] = {table: [] for table in tables}
        self._chunks: dict[str, list[dict[str, NDArray[Any]]]] = {table: [] for table in tables}
        self._counts = dict.fromkeys(tables, 0)

    def add(self, table: str, **row: Any) -> int:
        """Append a row; returns its number."""
        self._rows[table].append(row)
        self._counts[table] += 1
        return self._counts[table] - 1

    def extend(self, table: str, **columns: NDArray[Any]) -> int:
        """Append many rows, a column each; returns the number of the first."""
        first = self._counts[table]
        self._chunks[table].append(columns)
        self._counts[table] += len(next(iter(columns.values())))
        return first

    def count(self, table: str) -> int:
        """How many rows a table has."""
        return self._counts[table]

    def tables(self) -> dict[str, dict[str, NDArray[Any]]]:
        """All tables as they are now."""
        made: dict[str, dict[str, NDArray[Any]]] = {}
        for table, columns in self._columns.items():
            rows, chunks = self._rows[table], self._chunks[table]
            if chunks:
                made[table] = {
                    name: _joined([np.asarray(chunk[name], column.dtype) for chunk in chunks])
                    for name, column in columns.items()
                }
            else:
                made[table] = {
                    name: np.array([row[name] for row in rows], column.dtype).reshape(len(rows), *column.shape)
                    for name, column in columns.items()
                }
            if "span" in columns:
                made[table]["span"] = self.places.bytes(made[table]["span"])
        return made


def _joined(chunks: list[NDArray[Any]]) -> NDArray[Any]:
    return chunks[0] if len(chunks) == 1 else np.concatenate(chunks)
