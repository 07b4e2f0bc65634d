"""Whether an IR is what tables.py says it is: every number within its bounds, every row that is named there.

A renderer need not look at what has passed. What `compile` makes without an error passes; of a file nobody knows.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from m3d_language.table import LANGUAGE

from .scene import SceneIR
from .tables import PRIMITIVE_TABLE, TABLES, Column, Columns, PrimitiveKind, Within


def fault(scene: SceneIR) -> str | None:
    """What is wrong in the tables of an IR, in words; None if nothing. They have all columns of the right types."""
    return next(_faults(scene), None)


def _faults(scene: SceneIR) -> Iterator[str]:
    tables = scene.tables
    for table, columns in TABLES.items():
        if len({len(tables[table][name]) for name in columns}) > 1:
            yield f"the columns of {table} differ in length"
    for table, columns in TABLES.items():
        for name, column in columns.items():
            yield from _column_faults(f"{table}.{name}", tables[table][name], column, tables)
    for table, columns in TABLES.items():
        for name in columns:
            if name.startswith("first_"):
                count = f"{name.removeprefix('first_')}_count"
                ends = tables[table][name].astype(np.int64) + tables[table][count]
                row_of = columns[count].row_of
                yield from _beyond(f"{table}.{count}", ends, _length(tables, row_of) + 1, row_of)
    yield from _primitive_faults(tables)
    yield from _scene_faults(scene)


def _column_faults(
    name: str, values: NDArray[np.generic], column: Column, tables: Mapping[str, Columns]
) -> Iterator[str]:
    if not values.size or values.dtype.kind not in "fiu":
        return
    numbers = values.astype(np.float64) if values.dtype.kind in "iu" else values
    least, most = float(numbers.min()), float(numbers.max())  # NaN if there is one
    wrong = not_within(least, column.within) or not_within(most, column.within)
    if wrong:
        yield f"{name} {wrong}"
    if column.row_of and not name.endswith("_count"):
        if least < (-1 if column.optional else 0):
            yield f"{name} is {least:g}"
        yield from _beyond(name, values, _length(tables, column.row_of), column.row_of)


def not_within(number: float, within: Within) -> str | None:
    """What is wrong with a number, as in `WHAT is 3, expected at most 1`; None if nothing."""
    if np.isnan(number) or (np.isinf(number) and not within.infinite):
        return "is not finite"
    if number < within.least:
        return f"is {number:g}, expected {within.least:g} or more"
    if number > within.most:
        return f"is {number:g}, expected at most {within.most:g}"
    return None


def _length(tables: Mapping[str, Columns], table: str) -> int:
    return len(next(iter(tables[table].values())))


def _beyond(name: str, rows: NDArray[np.generic], length: int, table: str) -> Iterator[str]:
    """Rows that are not below a length."""
    if rows.size and int(rows.max()) >= length:
        yield f"{name} names rows of {table} that are not there"


def _primitive_faults(tables: Mapping[str, Columns]) -> Iterator[str]:
    primitives = tables["primitives"]
    for kind, table in PRIMITIVE_TABLE.items():
        rows = primitives["row"][primitives["kind"] == kind]
        yield from _beyond(f"primitives.row of a {PrimitiveKind(kind).name}", rows, _length(tables, table), table)
    owners = (primitives["solid"] >= 0).astype(int) + (primitives["light"] >= 0)
    if (owners != 1).any():
        yield "a row of primitives belongs to no solid or light, or to both"
    if len(tables["surfaces"]["color"]) != len(tables["solids"]["span"]):
        yield "surfaces does not have a row for each solid"


def _scene_faults(scene: SceneIR) -> Iterator[str]:
    said, profile = scene.scene, scene["profile"]["elevation"]
    if said.sky is not None and said.sky.sun >= len(scene["lights"]["kind"]):
        yield "scene.sky.sun names a row of lights that is not there"
    if said.mirage is not None and len(profile) < LANGUAGE.limits["profile_least"]:
        yield "there is a scene.mirage, but no profile"
    if (np.diff(profile) <= 0).any():
        yield "profile.elevation does not increase"
    view = said.view
    if not (view.top <= view.bottom < view.height and view.left <= view.right_edge < view.width):
        yield "scene.view has no pixel between top, left, bottom and right_edge"
