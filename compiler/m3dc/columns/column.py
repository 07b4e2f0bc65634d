"""One column of a table of the IR: the form in which it is said what the tables hold."""

from __future__ import annotations

import math
from typing import NamedTuple

from m3d_language.table import LANGUAGE


class Within(NamedTuple):
    """The values that a number may have; `infinite` is whether it may be infinite, too."""

    least: float = -math.inf
    most: float = math.inf
    infinite: bool = False


ANY = Within()
SHARE = Within(0.0, 1.0)
NOT_NEGATIVE = Within(0.0)
FARTHEST = float(LANGUAGE.limits["reach"])
POSITION = Within(-FARTHEST, FARTHEST)
UNIT = Within(-1.0 - 1e-9, 1.0 + 1e-9)


class Column(NamedTuple):
    """One column of a table: `dtype`, the shape of one entry, what it means, and what values it may have.

    It may hold numbers of rows of another table, `row_of`; or -1 for none where that is `optional`.
    """

    dtype: str
    shape: tuple[int, ...]
    says: str
    within: Within = ANY
    row_of: str = ""
    optional: bool = False


def consecutive(noun: str, table: str, order: str = "") -> dict[str, Column]:
    """The columns that name consecutive rows of another table."""
    return {
        f"first_{noun}": Column("i4", (), f"its first row in {table}{order}", NOT_NEGATIVE),
        f"{noun}_count": Column("i4", (), f"how many rows of {table} it has", NOT_NEGATIVE, table),
    }


def matrices(of: str) -> dict[str, Column]:
    """The columns of a transformation."""
    return {
        "transform": Column("f8", (4, 4), f"matrix of the {of}"),
        "inverse": Column("f8", (4, 4), "its inverse"),
    }
