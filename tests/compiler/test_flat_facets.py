"""Facets whose corners lie on a line are refused, and no others, at any size and wherever they stand in a table."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

import m3dc

coordinates = st.integers(-9, 9)
points = st.tuples(coordinates, coordinates, coordinates)
triangles = st.tuples(points, points, points)


def lies_on_a_line(triangle: tuple[tuple[int, int, int], ...]) -> bool:
    """Exactly, in whole numbers."""
    a, b, c = triangle
    (ux, uy, uz), (vx, vy, vz) = ([p - q for p, q in zip(point, b, strict=True)] for point in (c, a))
    return uy * vz == uz * vy and uz * vx == ux * vz and ux * vy == uy * vx


@given(st.lists(triangles, min_size=1, max_size=12), st.sampled_from([-300, -160, -110, -60, -9, 0, 9, 19]))
def test_facets_on_a_line_are_found_at_any_size(facets: list[tuple[tuple[int, int, int], ...]], power: int) -> None:
    vertices = "\n".join(f"< {', '.join(f'{x}e{power}' for x in point)} >" for triangle in facets for point in triangle)
    corners = "\n".join(f"{3 * i} {3 * i + 1} {3 * i + 2}" for i in range(len(facets)))
    count = len(facets)
    result = m3dc.compile(
        f"SOLID {{ POLYGONS {{ VERTICES {{ {3 * count} {vertices} }} FACETS {{ {count} {corners} }} }} }}"
    )
    flat = [i for i, triangle in enumerate(facets) if lies_on_a_line(triangle)]
    said = [d.detail for d in result.diagnostics if d.code == "M3D0403"]
    assert said == [f"the corners of facet {i} lie on a line; three points not on a line make a triangle" for i in flat]
