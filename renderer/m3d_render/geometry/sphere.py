"""Spheres."""

from __future__ import annotations

import math

import numpy as np

from m3d_render.geometry.shape import Lines, Points, Roundness, Rows, Section, Shape, Triangles, closed, no_segments
from m3d_render.geometry.view_plane import ViewPlane
from m3dc.ir import SceneIR

FINEST = 48
"""Sides of a sphere's equator as triangles, where there are not many spheres."""

COARSEST = 8

_MOST_TRIANGLES = 2_000_000  # of all spheres together, while they are finer than the coarsest
_SECTION_STEPS = 96


def sides(count: int) -> int:
    """Of how many sides the equator of each of so many spheres is made; it has half as many parallels."""
    affordable = math.sqrt(_MOST_TRIANGLES / max(count, 1))
    return int(np.clip(affordable // 4 * 4, COARSEST, FINEST))


def _triangles(ir: SceneIR, primitives: Rows, rows: Rows) -> tuple[Triangles, ...]:
    directions, corners = _unit_sphere(sides(len(rows)))
    spheres = ir["spheres"]
    pole, equator = spheres["pole"][rows], spheres["equator"][rows]
    axes = np.stack([equator, np.cross(pole, equator), pole], axis=1)
    normals = directions @ axes
    points = spheres["center"][rows][:, None] + spheres["radius"][rows][:, None, None] * normals
    faces = len(directions) * np.arange(len(rows))[:, None, None] + corners
    of = np.repeat(primitives, len(corners))
    return (Triangles(points.reshape(-1, 3), faces.reshape(-1, 3), of, normals.reshape(-1, 3)),)


def _unit_sphere(sides: int) -> tuple[Points, Rows]:
    """A sphere about the origin: its north pole, its south pole, and the parallels between, from the north."""
    latitude = np.linspace(math.pi / 2, -math.pi / 2, sides // 2 + 1)[1:-1, None]
    longitude = np.linspace(0, 2 * math.pi, sides, endpoint=False)
    x, y = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)
    rings = np.stack([x, y, np.broadcast_to(np.sin(latitude), x.shape)], axis=-1).reshape(-1, 3)
    points = np.concatenate([[[0, 0, 1], [0, 0, -1]], rings])
    ring = 2 + np.arange(len(rings)).reshape(-1, sides)
    beside = np.roll(ring, -1, axis=1)
    north = np.stack([np.zeros(sides, np.int64), ring[0], beside[0]], axis=-1)
    south = np.stack([np.ones(sides, np.int64), beside[-1], ring[-1]], axis=-1)
    upper = np.stack([ring[:-1], ring[1:], beside[:-1]], axis=-1).reshape(-1, 3)
    lower = np.stack([beside[:-1], ring[1:], beside[1:]], axis=-1).reshape(-1, 3)
    return points, np.concatenate([north, upper, lower, south])


def _outline(ir: SceneIR, row: int, roundness: Roundness) -> Lines:
    """The equator, two parallels and four meridians."""
    spheres = ir["spheres"]
    centre, radius = spheres["center"][row], float(spheres["radius"][row])
    pole, x = spheres["pole"][row], spheres["equator"][row]
    y = np.cross(pole, x)
    angle = np.linspace(0, 2 * math.pi, roundness(centre, radius), endpoint=False)[:, None]
    circles: list[Points] = []
    for latitude in (-math.pi / 4, 0.0, math.pi / 4):
        around = np.cos(angle) * x + np.sin(angle) * y
        circles.append(centre + radius * (math.cos(latitude) * around + math.sin(latitude) * pole))
    for longitude in np.linspace(0, math.pi, 4, endpoint=False):
        side = math.cos(longitude) * x + math.sin(longitude) * y
        circles.append(centre + radius * (np.cos(angle) * side + np.sin(angle) * pole))
    starts, ends = zip(*(closed(circle) for circle in circles), strict=True)
    return np.concatenate(starts), np.concatenate(ends)


def _section(ir: SceneIR, row: int, plane: ViewPlane) -> Section:
    center, radius = ir["spheres"]["center"][row], float(ir["spheres"]["radius"][row])
    aside = float((center - plane.eye) @ plane.normal)
    if abs(aside) >= radius:
        return Section(no_segments())
    angle = np.linspace(0, 2 * math.pi, _SECTION_STEPS + 1)
    points = math.sqrt(radius**2 - aside**2) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points += plane.to_plane(center)
    return Section(np.stack([points[:-1], points[1:]], axis=1), filled=True)


SPHERE = Shape(_triangles, _outline, _section, is_curved=True)
