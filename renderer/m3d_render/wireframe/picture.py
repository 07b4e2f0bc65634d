"""The wireframe picture of a scene, as values."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from m3d_render.wireframe.drawing import Hidden, project
from m3d_render.wireframe.raster import Paper, raster
from m3dc.ir import SceneIR


def draw(
    ir: SceneIR,
    width: int | None = None,
    height: int | None = None,
    *,
    from_above: bool = False,
    hidden: Hidden = "show",
    show: Iterable[str] = (),
    paper: Paper = "black",
) -> NDArray[np.float32]:
    """The wireframe picture of a scene: rows x columns x 3, 0..1. Options as of `project`."""
    return raster(project(ir, width, height, from_above=from_above, hidden=hidden, show=show), paper)
