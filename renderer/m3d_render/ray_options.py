"""Angles and distances of rays, as command lines take them."""

from __future__ import annotations

import argparse
import math

import numpy as np
from numpy.typing import NDArray

from m3d_render import command

MOST_ANGLES = 1_000_000
QUARTER_TURN = 90 * 60
"""Arcminutes to the zenith."""


def angles(text: str) -> NDArray[np.float64]:
    """All angles above the horizontal from FROM to TO, in arcminutes."""
    parts = text.split(":")
    if len(parts) != 3:
        raise argparse.ArgumentTypeError(f"FROM:TO:STEP is expected, not '{text}'")
    start, stop, step = (command.number(part) for part in parts)
    if max(abs(start), abs(stop)) >= QUARTER_TURN:
        raise argparse.ArgumentTypeError(f"angles must lie between -{QUARTER_TURN} and {QUARTER_TURN} arcminutes")
    if step == 0 or (stop - start) / step < 0:
        raise argparse.ArgumentTypeError(f"steps of {step:g} do not lead from {start:g} to {stop:g}")
    # A last step that misses TO by rounding alone is still meant.
    steps = (stop - start) / step * (1 + 1e-12) + 1e-9
    if steps >= MOST_ANGLES:
        raise argparse.ArgumentTypeError(f"these are more than {MOST_ANGLES:,} angles")
    return np.array([start + step * i for i in range(math.floor(steps) + 1)], dtype=np.float64)


def distances(text: str) -> list[float]:
    """Horizontal distances in metres, with commas between them."""
    found = [command.number(part) for part in text.split(",")]
    if min(found) < 0:
        raise argparse.ArgumentTypeError("distances must not be below 0")
    return found
