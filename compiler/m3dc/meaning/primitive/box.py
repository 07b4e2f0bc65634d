"""What follows from points between which a primitive lies."""

from __future__ import annotations

import math

import numpy as np

from .primitive import Ball, Points


def reach_of(points: Points) -> float:
    """The largest coordinate, without its sign; 0 of no points."""
    return float(np.abs(points).max(initial=0.0))


def ball_about(points: Points) -> Ball:
    """The ball about the middle of their box that holds all; about the origin, of no points."""
    if not len(points):
        return Ball(np.zeros(3), 0.0)
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    return Ball(centre, float(np.sqrt(((points - centre) ** 2).sum(axis=1).max())))


def may_meet(one: Ball, other: Ball) -> bool:
    """Whether two balls have points in common."""
    return math.dist(one.centre, other.centre) < one.radius + other.radius
