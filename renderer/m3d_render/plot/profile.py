"""The temperature profile of a scene's air, and how the air bends a level ray at each height. Thesis 2.1 and 6.1."""

# matplotlib leaves some types of its own open.
# pyright: reportUnknownMemberType=false
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from m3d_render.optics import EARTH_CURVATURE, AirLayers, air_layers
from m3d_render.rendering import SceneError
from m3dc.ir import SceneIR

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True)
class TemperatureProfile:
    """The points of a PROFILE, `elevation` in m and `temperature` in °C; the layers between them, which end at
    MIRAGE's ELEVATION, with their `gradient` dT/dz in K/m; and the eye's height, m."""

    elevation: NDArray[np.float64]
    temperature: NDArray[np.float64]
    layers: AirLayers
    gradient: NDArray[np.float64]
    eye: float


def temperature_profile(ir: SceneIR) -> TemperatureProfile:
    """The profile of a scene. Raises SceneError where it has no MIRAGE."""
    if ir.scene.mirage is None:
        raise SceneError("the scene has no MIRAGE, and so no temperature profile")
    elevation, temperature = ir["profile"]["elevation"], ir["profile"]["temperature"]
    layers = air_layers(ir)
    gradient = (np.diff(temperature) / np.diff(elevation))[: len(layers.bottom)]
    return TemperatureProfile(elevation, temperature, layers, gradient, ir.scene.view.eye[2])


def table(profile: TemperatureProfile) -> tuple[list[str], list[NDArray[np.float64]]]:
    """Columns of one row a layer."""
    layers, rows = profile.layers, len(profile.gradient)
    names = ["bottom_m", "top_m", "bottom_C", "top_C", "gradient_K_per_m", "curvature_per_m", "effective_per_m"]
    top = np.interp(layers.top, profile.elevation, profile.temperature)
    columns = [layers.bottom, layers.top, profile.temperature[:rows], top, profile.gradient]
    return names, [*columns, layers.curvature, layers.effective]


def draw_profile(profile: TemperatureProfile, axes: Sequence[Axes], heights: tuple[float, float] | None = None) -> None:
    """Draws temperature, its gradient, and the curvature of level rays against height, on three axes side by side.
    `heights` are the lowest and highest shown, m."""
    temperature, gradient, curvature = axes
    layers = profile.layers
    temperature.plot(profile.temperature, profile.elevation, "k.-", markersize=3, linewidth=1)
    temperature.set(xlabel="temperature, °C", ylabel="height, m")
    edges = np.append(layers.bottom, layers.top[-1:])
    gradient.stairs(profile.gradient, edges, orientation="horizontal", color="k", baseline=None)
    gradient.set(xlabel="gradient dT/dz, K/m")
    curvature.stairs(
        1e6 * layers.effective, edges, orientation="horizontal", color="k", baseline=None, label="over a flat earth"
    )
    curvature.stairs(
        1e6 * layers.curvature,
        edges,
        orientation="horizontal",
        color="k",
        baseline=None,
        linestyle=":",
        label="in space",
    )
    curvature.set(xlabel="curvature of a level ray,\n10⁻⁶/m, down is positive")
    curvature.axvline(1e6 * EARTH_CURVATURE, color="0.5", linewidth=0.8, linestyle="-.", label="the earth's, 1/R")
    curvature.legend(loc="upper right", frameon=False)
    for panel in axes:
        panel.axhline(profile.eye, color="0.3", linewidth=0.8, linestyle="--")
        panel.grid(visible=True, linewidth=0.3)
        panel.margins(y=0.01)
    if heights is not None:
        temperature.set(ylim=heights)
    for panel in (gradient, curvature):
        panel.axvline(0, color="0.5", linewidth=0.8)
    temperature.annotate(
        "eye", (0.98, profile.eye), xycoords=("axes fraction", "data"), ha="right", va="bottom", size="small"
    )
