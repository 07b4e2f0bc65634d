"""From the tables of POLYGONS and TERRAIN to triangles with normals, checked (thesis 7.5.5.3)."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..diagnostics import Findings, catalogue
from ..text.span import Placed
from .transform import unit
from .values import Mesh, Record, TableValue

MOST_REPORTED = 20
PIECE = 1 << 15
COLLINEAR = 1e-12  # sine of the angle between two edges below which a facet has no plane

_NO_NORMALS = np.zeros((0, 3)), np.zeros((0, 3), np.int32)
_BROKEN = Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32), *_NO_NORMALS, np.zeros(0, np.uint32), Placed(0, 0))


Columns: TypeAlias = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]


def degenerate(u: Columns, v: Columns) -> NDArray[np.bool_]:
    """Whether edges U, V, given as columns of x, y and z, span no plane: one is zero, or they are parallel."""
    with np.errstate(all="ignore"):
        size = np.maximum.reduce([np.abs(column) for column in (*u, *v)])
        ux, uy, uz = (column / size for column in u)
        vx, vy, vz = (column / size for column in v)
        cross, lengths = _squares((ux, uy, uz), (vx, vy, vz))
        return np.logical_not(cross > COLLINEAR**2 * lengths)


def _squares(u: Columns, v: Columns) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """|U x V|² and |U|² |V|²."""
    (ux, uy, uz), (vx, vy, vz) = u, v
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    return x * x + y * y + z * z, (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz)


def _flat_facets(positions: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.intp]:
    """The rows of facets whose corners lie on a line. Worked in pieces that stay in the processor's cache."""
    x, y, z = (np.ascontiguousarray(column) for column in positions.T)
    found: list[NDArray[np.intp]] = []
    for start in range(0, len(corners), PIECE):
        a, b, c = corners[start : start + PIECE].T.astype(np.intp)
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = ((x.take(i), y.take(i), z.take(i)) for i in (a, b, c))
        u, v = (cx - bx, cy - by, cz - bz), (ax - bx, ay - by, az - bz)
        cross, lengths = _squares(u, v)
        # Nearly all are far from flat, which is told without scaling them.
        rows = np.flatnonzero(np.logical_not(cross > 4 * COLLINEAR**2 * lengths))
        if rows.size:
            (ux, uy, uz), (vx, vy, vz) = ([column[rows] for column in edge] for edge in (u, v))
            found.append(rows[degenerate((ux, uy, uz), (vx, vy, vz))] + start)
    return np.concatenate(found) if found else np.zeros(0, np.intp)


def polygons(record: Record, findings: Findings, *, whole: bool) -> None:
    """Make the mesh of a POLYGONS record from its tables; where it has not both, say so if it must be `whole`."""
    facets = record.tables.get("FACETS") or record.tables.get("SFACETS")
    vertices = record.tables.get("VERTICES")
    if record.mesh is not None or record.broken:
        return
    if facets is None or vertices is None:
        if whole:
            missing = "FACETS" if vertices is not None else "VERTICES"
            findings.add_at(catalogue.NO_TABLE, record.span, f"POLYGONS needs a {missing} table", fill=missing)
        return
    sound = _counted(vertices, vertices.head[0], "VERTICES", findings)
    sound &= _counted(facets, facets.head[0], "FACETS", findings)
    if sound and vertices.head[0] < 3:
        findings.add_at(catalogue.TOO_FEW_VERTICES, vertices.span, "at least 3 vertices make a facet")
        sound = False
    if sound and facets.head[0] < 1:
        findings.add_at(catalogue.TOO_FEW_ROWS, facets.span, "at least one facet must be there")
        sound = False
    record.mesh = (_faceted(vertices, facets, findings) if sound else None) or _BROKEN


def _counted(table: TableValue, count: int, keyword: str, findings: Findings) -> bool:
    """Whether a table has as many rows as it says."""
    rows = len(table.rows)
    if rows > count:
        findings.add_at(
            catalogue.MORE_ROWS_THAN_SPECIFIED,
            table.place(max(count, 0)),
            f"{count} specified, {rows} found",
            fill=keyword,
        )
    elif rows < count:
        end = table.span.end
        findings.add_at(
            catalogue.FEWER_ROWS_THAN_SPECIFIED, Placed(end - 1, end), f"{count} specified, {rows} found", fill=keyword
        )
    return rows == count


def _faceted(vertices: TableValue, facets: TableValue, findings: Findings) -> Mesh | None:
    positions = vertices.rows
    indices = facets.rows[:, :3]
    last = len(positions) - 1
    if not (indices.min() > -1 and indices.max() < last + 1):
        undefined = np.flatnonzero(((indices <= -1) | (indices >= last + 1)).any(axis=1))
        for row in undefined[:MOST_REPORTED].tolist():
            shown = " ".join(f"{i:g}" for i in indices[row])
            detail = f"facet {row} uses {shown}; vertices are numbered 0 to {last}"
            findings.add_at(catalogue.UNDEFINED_VERTEX, facets.place(row), detail)
        return None
    corners = indices.astype(np.int32)
    flat = _flat_facets(positions, corners)
    if flat.size:
        for row in flat[:MOST_REPORTED].tolist():
            detail = f"the corners of facet {row} lie on a line; three points not on a line make a triangle"
            findings.add_at(catalogue.INVALID_VERTICES, facets.place(row), detail)
        return None
    normals, normal_rows = _NO_NORMALS
    if facets.rows.shape[1] > 3:
        normals = facets.rows[:, 3:].reshape(-1, 3)
        zero = ~normals.any(axis=1)
        if zero.any():
            row = int(np.flatnonzero(zero)[0]) // 3
            findings.add_at(catalogue.ZERO_NORMAL, facets.place(row), f"a normal of facet {row} is zero")
            return None
        normals = unit(normals)
        normal_rows = np.arange(len(normals), dtype=np.int32).reshape(-1, 3)
    return Mesh(positions, corners, normals, normal_rows, facets.offsets, facets.span)


def terrain(record: Record, findings: Findings, *, whole: bool) -> None:
    """Make the mesh of a TERRAIN record: two facets a cell, and normals by the gradient of the grid."""
    table = record.tables.get("VERTICES")
    if record.mesh is not None or record.broken:
        return
    if table is None:
        if whole:
            findings.add_at(catalogue.NO_TABLE, record.span, "TERRAIN needs a VERTICES table", fill="VERTICES")
        return
    rows, columns = table.head
    record.mesh = _BROKEN
    if rows < 2 or columns < 2:
        findings.add_at(
            catalogue.TOO_FEW_ROWS, table.span, f"a grid has at least 2 rows and 2 columns, not {rows} and {columns}"
        )
        return
    if not _counted(table, rows * columns, "VERTICES", findings):
        return
    record.mesh = _grid(table, rows, columns, findings) or _BROKEN


def _grid(table: TableValue, rows: int, columns: int, findings: Findings) -> Mesh | None:
    grid = table.rows.reshape(rows, columns, 3)
    # Each cell: a the near corner, b the next along the rows (x), d along the columns (y), c opposite a.
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    halves = np.stack([np.cross(q - p, r - q) for p, q, r in ((a, b, c), (a, c, d), (b, c, d), (a, b, d))])
    # The grid lies on the xy plane, or else on one of the other two: where no cell is folded when seen along the axis.
    seen = [_folded(halves[..., axis]) for axis in (2, 0, 1)]
    folded, upwards = next((view for view in seen if not view[0].any()), seen[0])
    if folded.any():
        row, column = (int(i) for i in np.argwhere(folded)[0])
        detail = f"the cell at row {row + 1}, column {column + 1} folds over another"
        findings.add_at(catalogue.OVERLAPPING_CELLS, table.place(row * columns + column), detail)
        return None
    number = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    na, nb, nc, nd = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    if upwards < 0:
        nb, nd = nd, nb
    facets = np.stack([np.stack([na, nb, nc], -1), np.stack([na, nc, nd], -1)], axis=2).reshape(-1, 3)
    normals = unit(np.cross(_along(grid, 0), _along(grid, 1)) * upwards).reshape(-1, 3)
    offsets = np.repeat(table.offsets[na.ravel()], 2)
    return Mesh(grid.reshape(-1, 3), facets, normals, facets, offsets, table.span)


def _folded(areas: NDArray[np.float64]) -> tuple[NDArray[np.bool_], float]:
    """Which cells turn over or have no area, of the signed areas (4, rows, columns) of their halves; and the sign of
    those that do not."""
    upwards = float(np.sign(areas.sum())) or 1.0
    return np.logical_not((areas * upwards > 0).all(axis=0)), upwards


def _along(grid: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """Central differences of the points along one axis of the grid; one-sided at its edges."""
    return np.gradient(grid, axis=axis)
