"""Transformations: 4x4 matrices that act on row vectors, P' = P M, each with its inverse (thesis 3.6)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]


class Transform(NamedTuple):
    """A matrix and its inverse. The inverse is built along with it, so that it is exact where each step's is."""

    matrix: Matrix
    inverse: Matrix

    def then(self, other: Transform) -> Transform:
        """This transformation followed by another: M = self other."""
        if other is IDENTITY:
            return self
        if self is IDENTITY:
            return other
        return Transform(self.matrix @ other.matrix, other.inverse @ self.inverse)

    def points(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points, shape (..., 3), moved; the same array where nothing moves."""
        if self is IDENTITY:
            return points
        return points @ self.matrix[:3, :3] + self.matrix[3, :3]

    def vectors(self, vectors: NDArray[np.float64]) -> NDArray[np.float64]:
        """Differences of points, shape (..., 3), moved."""
        return vectors @ self.matrix[:3, :3]

    def ways(self, vectors: NDArray[np.float64]) -> NDArray[np.float64]:
        """Where vectors, shape (..., 3), point to once they are moved. Of any length: times a power of two, so that
        nothing overflows."""
        return _near_one(vectors) @ _near_one(self.matrix[:3, :3])

    def normals(self, normals: NDArray[np.float64]) -> NDArray[np.float64]:
        """Unit normals, shape (..., 3), moved: by the transpose of the inverse. They are unit vectors again."""
        return unit(normals @ _near_one(self.inverse[:3, :3]).T)

    def stretches(self) -> NDArray[np.float64]:
        """The factors by which the three rows of the 3x3 part stretch. Safe against over- and underflow."""
        rows = self.matrix[:3, :3]
        largest = float(np.abs(rows).max())
        exponent = 0 if 1e-100 < largest < 1e100 else math.frexp(largest)[1]
        return np.ldexp(np.sqrt((np.ldexp(rows, -exponent) ** 2).sum(axis=1)), exponent)

    def length(self) -> float:
        """The largest of these: what a sphere's radius grows by (7.5.5.2)."""
        return float(self.stretches().max())

    @property
    def is_finite(self) -> bool:
        """Whether all numbers of the matrix and of its inverse are."""
        return bool(np.isfinite(self.matrix).all() and np.isfinite(self.inverse).all())


IDENTITY = Transform(np.eye(4), np.eye(4))


def _affine(linear: Matrix, offset: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Matrix:
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    matrix[3, :3] = offset
    return matrix


def translate(x: float, y: float, z: float) -> Transform:
    """Thesis 3.6.1."""
    return Transform(_affine(np.eye(3), (x, y, z)), _affine(np.eye(3), (-x, -y, -z)))


def scale(x: float, y: float, z: float) -> Transform:
    """Thesis 3.6.2. No factor may be 0."""
    return Transform(_affine(np.diag((x, y, z))), _affine(np.diag((1 / x, 1 / y, 1 / z))))


def cosine_and_sine(degrees: float) -> tuple[float, float]:
    """Exact at the multiples of 90 degrees, where radians would leave a trace of 1e-17."""
    quarter, rest = divmod(degrees, 90.0)
    c, s = (1.0, 0.0) if rest == 0.0 else (math.cos(math.radians(rest)), math.sin(math.radians(rest)))
    for _ in range(int(quarter) % 4):
        c, s = -s, c
    return c + 0.0, s + 0.0


def _rotation(rows: Callable[[float, float], list[list[float]]], degrees: float) -> Transform:
    c, s = cosine_and_sine(degrees)
    matrix = _affine(np.array(rows(c, s)))
    return Transform(matrix, matrix.T.copy())


def rotate_x(degrees: float) -> Transform:
    """From y towards z (thesis 3.6.3)."""
    return _rotation(lambda c, s: [[1, 0, 0], [0, c, s], [0, -s, c]], degrees)


def rotate_y(degrees: float) -> Transform:
    """From z towards x (thesis 3.6.3)."""
    return _rotation(lambda c, s: [[c, 0, -s], [0, 1, 0], [s, 0, c]], degrees)


def rotate_z(degrees: float) -> Transform:
    """From x towards y (thesis 3.6.3)."""
    return _rotation(lambda c, s: [[c, s, 0], [-s, c, 0], [0, 0, 1]], degrees)


def rotate(x: float, y: float, z: float) -> Transform:
    """About x, then y, then z (thesis 7.5.5.2, ROTATE)."""
    return rotate_x(x).then(rotate_y(y)).then(rotate_z(z))


def _on_axis(step: Callable[[float, float, float], Transform], axis: int, rest: float) -> Callable[..., Transform]:
    """A step along or about one axis alone, the other two being at `rest`."""

    def single(amount: float) -> Transform:
        amounts = [rest] * 3
        amounts[axis] = amount
        return step(*amounts)

    return single


# What each statement of a TRANSFORM block does with its numbers; a vector counts as three.
STEPS: dict[str, Callable[..., Transform]] = {
    "TRANSLATE": translate,
    "TRANSX": _on_axis(translate, 0, 0.0),
    "TRANSY": _on_axis(translate, 1, 0.0),
    "TRANSZ": _on_axis(translate, 2, 0.0),
    "SCALE": scale,
    "SCALEX": _on_axis(scale, 0, 1.0),
    "SCALEY": _on_axis(scale, 1, 1.0),
    "SCALEZ": _on_axis(scale, 2, 1.0),
    "ROTATE": rotate,
    "ROTX": rotate_x,
    "ROTY": rotate_y,
    "ROTZ": rotate_z,
}


def _near_one(numbers: NDArray[np.float64]) -> NDArray[np.float64]:
    """The numbers times a power of two, so that the largest is about 1: exact, and safe to be multiplied."""
    return np.ldexp(numbers, -np.frexp(np.abs(numbers).max(initial=0.0))[1])


def unit(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """Vectors, shape (..., 3), of length 1; a zero vector stays zero. Safe against over- and underflow."""
    largest = np.abs(vector).max(axis=-1, keepdims=True)
    scaled = vector / np.where(largest > 0, largest, 1.0)
    norm = np.sqrt((scaled**2).sum(axis=-1, keepdims=True))
    return scaled / np.where(norm > 0, norm, 1.0)


def clean(numbers: NDArray[np.float64]) -> NDArray[np.float64]:
    """Numbers without negative zeros."""
    return numbers + 0.0
