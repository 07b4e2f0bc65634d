"""The native kernel. `m3d_render.render` and `m3d_render.optics` are its public faces."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from m3d_render.rendering import Request
from m3dc.ir import Columns

VERSION: str
EARTH_RADIUS: float
END_NAMES: list[str]
LAYERS: list[tuple[str, int]]

class Outcome:
    pixels: NDArray[np.float32]
    layers: NDArray[np.float32]
    finished_rows: int
    counts: dict[str, int]

class Scene:
    def __new__(cls, header: str, tables: Mapping[str, Columns], finer: int) -> Scene: ...
    @property
    def observer(self) -> tuple[float, float, float] | None: ...
    def sees(self, points: NDArray[np.float64], tolerance: float) -> NDArray[np.bool_]: ...
    def render(
        self,
        request: Request,
        progress: Callable[[int, int], object] | None,
        cancel: Callable[[], object] | None,
        tiles: Callable[[int, int, NDArray[np.float32]], object] | None,
    ) -> Outcome: ...

class Air:
    def __new__(cls, header: str, tables: Mapping[str, Columns], finer: int) -> Air: ...
    def layers(self) -> NDArray[np.float64]: ...
    def paths(
        self, height: float, slopes: NDArray[np.float64], distances: list[float]
    ) -> tuple[NDArray[np.uint8], NDArray[np.float64], NDArray[np.uint32], NDArray[np.float64]]: ...
    def crossings(self, height: float, slope: float) -> NDArray[np.float64]: ...
