"""Whether two edges from one point span a plane."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

COLLINEAR = 1e-12  # sine of the angle between two edges below which they span none

Columns: TypeAlias = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]


def degenerate(u: Columns, v: Columns) -> NDArray[np.bool_]:
    """Whether edges U, V, given as columns of x, y and z, span no plane: one is zero, or they are parallel."""
    with np.errstate(all="ignore"):
        size = np.maximum.reduce([np.abs(column) for column in (*u, *v)])
        ux, uy, uz = (column / size for column in u)
        vx, vy, vz = (column / size for column in v)
        cross, lengths = squares((ux, uy, uz), (vx, vy, vz))
        return np.logical_not(cross > COLLINEAR**2 * lengths)


def squares(u: Columns, v: Columns) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """|U x V|² and |U|² |V|²."""
    (ux, uy, uz), (vx, vy, vz) = u, v
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    return x * x + y * y + z * z, (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz)
