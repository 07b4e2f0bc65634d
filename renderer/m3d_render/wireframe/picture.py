"""The wireframe picture of a scene, as values."""

from __future__ import annotations

from typing import Unpack

import numpy as np
from numpy.typing import NDArray

from m3d_render.wireframe.drawing import Options, project
from m3d_render.wireframe.raster import Paper, raster
from m3dc.ir import SceneIR


def draw(
    ir: SceneIR,
    width: int | None = None,
    height: int | None = None,
    *,
    paper: Paper = "black",
    **options: Unpack[Options],
) -> NDArray[np.float32]:
    """The wireframe picture of a scene: rows x columns x 3, 0..1. `options` are those of `project`."""
    return raster(project(ir, width, height, **options), paper)
