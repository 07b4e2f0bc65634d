"""The native kernel. `m3d_render.render` and `m3d_render.optics` are its public faces."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import SceneIR

VERSION: str
TEXTURE_KINDS: list[int]

class Scene:
    def __new__(cls, ir: SceneIR, finer: int) -> Scene: ...
    @property
    def observer(self) -> tuple[float, float, float] | None: ...
    def render(
        self,
        *,
        width: int,
        height: int,
        left: int,
        top: int,
        columns: int,
        rows: int,
        straight: bool,
        shadows: bool,
        depth: int,
        log_scale: float,
        threads: int,
        progress: Callable[[int, int], object] | None,
        cancel: Callable[[], object] | None,
    ) -> tuple[NDArray[np.float32], dict[str, int]] | None: ...

def trace_paths(
    ir: SceneIR, height: float, slopes: list[float], distances: list[float], finer: int
) -> tuple[list[str], NDArray[np.float64], list[int], NDArray[np.float64]]: ...
def trace_crossings(ir: SceneIR, height: float, slope: float, finer: int) -> NDArray[np.float64]: ...
