"""Polygons and terrain (thesis 7.5.5.3): from their tables to triangles with normals, checked, and into the IR."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ...columns.column import POSITION, UNIT, Column, consecutive
from ...columns.rows import Rows
from ...diagnostics import Findings, catalogue
from ...text.span import Placed
from ..transform import Transform, unit
from ..values import Mesh, Record, TableValue
from .box import ball_about, may_meet, reach_of
from .degenerate import COLLINEAR, degenerate, squares
from .primitive import Ball, Fact, Field, Listing, Points, Primitive, Tables

MOST_REPORTED = 20
PIECE = 1 << 15

_NO_NORMALS = np.zeros((0, 3)), np.zeros((0, 3), np.int32)
_BROKEN = Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32), *_NO_NORMALS, np.zeros(0, np.uint32), Placed(0, 0))


def _flat_facets(positions: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.intp]:
    """The rows of facets whose corners lie on a line. Worked in pieces that stay in the processor's cache."""
    x, y, z = (np.ascontiguousarray(column) for column in positions.T)
    found: list[NDArray[np.intp]] = []
    for start in range(0, len(corners), PIECE):
        a, b, c = corners[start : start + PIECE].T.astype(np.intp)
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = ((x.take(i), y.take(i), z.take(i)) for i in (a, b, c))
        u, v = (cx - bx, cy - by, cz - bz), (ax - bx, ay - by, az - bz)
        cross, lengths = squares(u, v)
        # Nearly all are far from flat, which is told without scaling them.
        rows = np.flatnonzero(np.logical_not(cross > 4 * COLLINEAR**2 * lengths))
        if rows.size:
            (ux, uy, uz), (vx, vy, vz) = ([column[rows] for column in edge] for edge in (u, v))
            found.append(rows[degenerate((ux, uy, uz), (vx, vy, vz))] + start)
    return np.concatenate(found) if found else np.zeros(0, np.intp)


def _polygons(record: Record, findings: Findings, *, whole: bool) -> None:
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


def _terrain(record: Record, findings: Findings, *, whole: bool) -> None:
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


# --- in the scene -------------------------------------------------------------------------------------------------

_BOX = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])


def _vertices(record: Record) -> Points:
    """In the primitive's own coordinates; none of a mesh that was not made."""
    return np.zeros((0, 3)) if record.mesh is None else record.mesh.vertices


def _reach(record: Record, transform: Transform) -> float:
    vertices = _vertices(record)
    if len(vertices):
        lowest, highest = vertices.min(axis=0), vertices.max(axis=0)
        vertices = lowest + _BOX * (highest - lowest)
    return reach_of(transform.points(vertices))


def _ball(record: Record, transform: Transform) -> Ball:
    return ball_about(transform.points(_vertices(record)))


def _reaches_into(_record: Record, _transform: Transform, own: Ball, ball: Ball) -> bool:
    return may_meet(own, ball)


# --- in the IR ----------------------------------------------------------------------------------------------------

_TABLES = {
    "meshes": {
        "phong": Column("?", (), "normals are interpolated"),
        **consecutive("vertex", "vertices"),
        **consecutive("facet", "facets"),
    },
    "vertices": {
        "position": Column("f8", (3,), "world position", POSITION),
    },
    "facets": {
        "vertex": Column("i4", (3,), "rows of its three corners in vertices", row_of="vertices"),
        "normal": Column(
            "i4", (3,), "rows of its three corners' normals in normals, or -1", row_of="normals", optional=True
        ),
        "offset": Column("u4", (), "byte of the source where it is written"),
    },
    "normals": {
        "direction": Column("f8", (3,), "unit vector", UNIT),
    },
}


def _lower(rows: Rows, record: Record, transform: Transform) -> int:
    mesh = record.mesh
    if mesh is None:
        return rows.add("meshes", phong=False, first_vertex=0, vertex_count=0, first_facet=0, facet_count=0)
    first_vertex = rows.extend("vertices", position=transform.points(mesh.vertices))
    normal_rows = np.full(mesh.facets.shape, -1, np.int32)
    if len(mesh.normals):
        first_normal = rows.extend("normals", direction=transform.normals(mesh.normals))
        normal_rows = mesh.normal_rows + np.int32(first_normal)
    first_facet = rows.extend(
        "facets",
        vertex=mesh.facets + np.int32(first_vertex),
        normal=normal_rows,
        offset=mesh.offsets + np.uint32(rows.places.absolute(mesh.table).start),
    )
    return rows.add(
        "meshes",
        phong=record.flag("PHONG"),
        first_vertex=first_vertex,
        vertex_count=len(mesh.vertices),
        first_facet=first_facet,
        facet_count=len(mesh.facets),
    )


def _extent(tables: Tables) -> tuple[Points]:
    return (tables["vertices"]["position"],)


def _dump(tables: Tables, row: int, most: int | None) -> Iterator[Field | Listing]:
    mesh = {name: int(column[row]) for name, column in tables["meshes"].items()}
    yield Field("Phong", bool(mesh["phong"]))
    first, count = mesh["first_vertex"], mesh["vertex_count"]
    shown = count if most is None else min(count, most)
    vertices: list[list[float]] = tables["vertices"]["position"][first : first + shown].tolist()
    yield Listing("Number vertices", count, [(vertex, ()) for vertex in vertices])
    facet, count = mesh["first_facet"], mesh["facet_count"]
    shown = count if most is None else min(count, most)
    corners: list[list[int]] = (tables["facets"]["vertex"][facet : facet + shown] - first).tolist()
    normals = tables["facets"]["normal"][facet : facet + shown]
    directions = tables["normals"]["direction"]
    yield Listing(
        "Number facets",
        count,
        [
            (each, directions[normals[number]].tolist() if mesh["phong"] and normals[number, 0] >= 0 else ())
            for number, each in enumerate(corners)
        ],
    )


def _facts(tables: Tables, row: int) -> Sequence[Sequence[Fact]]:
    vertices, facets = (int(tables["meshes"][column][row]) for column in ("vertex_count", "facet_count"))
    return [[Fact("vertices", [vertices]), Fact("facets", [facets])]]


POLYGONS, TERRAIN = (
    Primitive(_TABLES, finish, _lower, _extent, _reach, _ball, _reaches_into, _dump, _facts)
    for finish in (_polygons, _terrain)
)
