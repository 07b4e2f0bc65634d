"""The curves of eye rays, against an independent integration of the equation of the ray."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest
from array_types import Floats
from scene_builder import MERMAN_PROFILE, Profile, SceneBuilder
from scipy.integrate import solve_ivp

import m3d_render
import m3dc
from m3d_render import SceneError
from m3d_render.optics import air_layers, trace_crossings, trace_paths

EPSILON, BETA, GRAVITY, EARTH, SEA_LEVEL = 226e-6, 3.48e-3, 9.80665, 6_371_000.0, 101_325.0
EYE = 2.1
Truth: TypeAlias = tuple[Floats, Floats, list[bool]]

DISTANCES = (500.0, 1000.0, 1400.0)


@dataclass(frozen=True)
class Leaving:
    """An event of `solve_ivp`, which ends there: a ray that passes a height downward (-1) or upward (1)."""

    height: float
    direction: float
    terminal: bool = True

    def __call__(self, _: float, y: Floats) -> float:
        return y[0] - self.height


class Air:
    """Pressure, temperature and curvature at every height: the continuous atmosphere, not layers."""

    def __init__(self, profile: Profile):
        self.z = np.array([z for z, _ in profile])
        self.t = np.array([celsius + 273.15 for _, celsius in profile])
        self.gradient = np.diff(self.t) / np.diff(self.z)
        self.p = [SEA_LEVEL]
        for i, gradient in enumerate(self.gradient):
            self.p.append(self._from(i, gradient, self.z[i + 1]))

    def _from(self, i: int, gradient: float, z: float):
        t = self.t[i] + gradient * (z - self.z[i])
        if gradient == 0:
            return self.p[i] * math.exp(-BETA * GRAVITY * (z - self.z[i]) / self.t[i])
        return self.p[i] * (t / self.t[i]) ** (-BETA * GRAVITY / gradient)

    def bend(self, interval: int, z: float):
        """z'' = -(κ - 1/R) in an interval of the profile."""
        gradient = self.gradient[interval]
        t = self.t[interval] + gradient * (z - self.z[interval])
        p = self._from(interval, gradient, z)
        eta = 1 + EPSILON * BETA * p / t
        kappa = EPSILON * BETA * p * (gradient + BETA * GRAVITY) / (eta * t * t)
        return 1 / EARTH - kappa

    def heights(self, angle: float, at: Sequence[float]):
        """Heights at distances, NaN beyond the end, and whether the ray ended at the ground."""
        interval = int(np.searchsorted(self.z, EYE)) - 1
        r, z, slope = 0.0, EYE, math.tan(angle)
        found = np.full(len(at), np.nan)
        while r < max(at):
            low, high = self.z[interval], self.z[interval + 1]

            step = solve_ivp(
                lambda _, y, i=interval: [y[1], self.bend(i, y[0])], (r, max(at)), [z, slope], method="DOP853",
                rtol=1e-12, atol=1e-13, events=[Leaving(low, -1), Leaving(high, 1)], dense_output=True, max_step=50.0,
            )  # fmt: skip
            assert step.sol is not None
            assert step.t_events is not None
            for k, distance in enumerate(at):
                if r <= distance <= step.t[-1]:
                    found[k] = step.sol(distance)[0]
            r, (z, slope) = step.t[-1], step.y[:, -1]
            if step.t_events[0].size:
                z, interval = low, interval - 1
            elif step.t_events[1].size:
                z, interval = high, interval + 1
            if interval < 0:
                return found, True
            if interval >= len(self.gradient):
                return found, False
        return found, False


def merman_air():
    return SceneBuilder(eye=(0, 0, EYE), target=(-1, 0, EYE)).mirage(MERMAN_PROFILE, segments=300).build()


@pytest.fixture(scope="module")
def truth():
    air = Air(MERMAN_PROFILE)
    minutes = np.arange(-10, 10.01, 0.5)
    angles = np.radians(minutes / 60)
    solved = [air.heights(angle, DISTANCES) for angle in angles]
    return angles, np.array([heights for heights, _ in solved]), [ground for _, ground in solved]


@pytest.mark.parametrize(("finer", "millimetres"), [(1, 0.5), (8, 0.05)])
def test_heights_agree_with_a_high_order_solution(truth: Truth, finer: int, millimetres: float):
    angles, heights, grounded = truth
    paths = trace_paths(merman_air(), angles, at=DISTANCES, finer=finer)
    np.testing.assert_array_equal(np.isnan(paths.heights), np.isnan(heights))
    worst = np.nanmax(np.abs(paths.heights - heights))
    assert worst < millimetres * 1e-3, f"{worst * 1e3:.3f} mm"
    ground_before = [
        end == "ground" and x < max(DISTANCES) for end, (x, _) in zip(paths.ends, paths.end_points, strict=True)
    ]
    assert ground_before == grounded
    assert any(grounded)
    assert not all(grounded)


def test_layers_have_the_curvature_of_the_air_in_their_middle():
    air, layers = Air(MERMAN_PROFILE), air_layers(merman_air())
    np.testing.assert_array_equal(layers.bottom, air.z[:-1])
    np.testing.assert_array_equal(layers.top, air.z[1:])
    bends = [air.bend(i, (low + high) / 2) for i, (low, high) in enumerate(zip(layers.bottom, layers.top, strict=True))]
    np.testing.assert_allclose(layers.effective, np.negative(bends), rtol=1e-9)
    np.testing.assert_allclose(layers.curvature - layers.effective, 1 / EARTH, rtol=1e-9)


def test_crossings_follow_the_path():
    ir = merman_air()
    points = trace_crossings(ir, math.radians(-0.05))
    np.testing.assert_array_equal(points[0], [0.0, EYE])
    assert np.all(np.diff(points[:, 0]) > 0)
    heights = trace_paths(ir, [math.radians(-0.05)], at=points[:, 0]).heights[0]
    np.testing.assert_array_equal(heights, points[:, 1])
    boundaries = {z for z, _ in MERMAN_PROFILE}
    assert all(z in boundaries for z in points[1:, 1])


def test_why_paths_end():
    ir = merman_air()
    ends = trace_paths(ir, np.radians([-1, 1, 0])).ends.tolist()
    assert ends[:2] == ["ground", "top"]
    low = SceneBuilder(eye=(0, 0, EYE), target=(-1, 0, EYE)).mirage(MERMAN_PROFILE, elevation=3.0, distance=80.0)
    steep, level = trace_paths(low.build(), np.radians([1, 0.01])).end_points
    assert steep[1] == 3.0
    assert level[0] == 80.0
    few = SceneBuilder(eye=(0, 0, EYE), target=(-1, 0, EYE)).mirage(MERMAN_PROFILE, segments=3)
    paths = trace_paths(few.build(), [math.radians(-1)])
    assert (paths.ends.tolist(), paths.arcs.tolist()) == (["segments"], [3])


def test_what_cannot_be_traced_is_said():
    with pytest.raises(SceneError, match="no MIRAGE"):
        trace_paths(SceneBuilder().build(), [0.0])
    with pytest.raises(SceneError, match="outside of the temperature profile"):
        trace_paths(merman_air(), [0.0], eye_height=20.0)
    for angle in (math.nan, math.inf):
        with pytest.raises(SceneError, match="an angle is no finite number"):
            trace_paths(merman_air(), [0.0, angle])
        with pytest.raises(SceneError, match="an angle is no finite number"):
            trace_crossings(merman_air(), angle)
    for finer in (0, -1, 10_001, 10**12):
        with pytest.raises(SceneError, match="finer must be from 1 to 10000"):
            trace_paths(merman_air(), [0.0], finer=finer)
    with pytest.raises(SceneError, match=r"above -273\.15"):
        trace_paths(SceneBuilder(eye=(0, 0, 1)).mirage([(0, 0), (2, -300), (4, 0)]).build(), [0.0])


# Level rays


SCENES = Path(__file__).parent / "scenes"


def test_a_level_ray_on_a_boundary_is_where_its_neighbours_are():
    """The eye is at 30 m, where an inversion begins: below it rays bend up, above it down."""
    ir = m3dc.compile((SCENES / "level-on-a-boundary.m3d").read_bytes()).ir
    minutes = [1e-4, 1e-6, 1e-9, 0.0, -1e-9, -1e-6, -1e-4]
    paths = trace_paths(ir, np.radians(minutes) / 60, at=[1000, 50_000])
    np.testing.assert_allclose(paths.heights, 30.0, atol=1e-6)
    assert paths.ends[1:-1].tolist() == ["range"] * 5
    assert paths.end_points[3].tolist() == [150_000, 30]
    rows = m3d_render.render(ir).argmax(axis=2)[46:55]
    assert (rows == rows[0]).all()
    assert rows[0].any() or rows[0, 0] == 0


def with_an_air_of(*profile: tuple[float, float]):
    return SceneBuilder(eye=(0, 0, 30), target=(1000, 0, 30), fov=0.5, width=5, height=5).mirage(
        profile, segments=100_000, distance=40_000
    )


@pytest.mark.parametrize(
    "profile",
    [
        [(-40, 8.5), (30, 8), (38, 9.5), (400, 7.2)],  # held
        [(-40, 8.5), (30, 8), (400, 0)],  # up on both sides
        [(-40, -8.5), (30, 8), (400, 80)],  # down on both sides
    ],
)
@pytest.mark.parametrize("make", ["box", "ball", "floor", "plate", "plane"])
def test_a_level_ray_on_a_boundary_meets_what_its_neighbours_meet(profile: Profile, make: str):
    depths: list[float] = []
    for moved in (0.0, 1e-7, -1e-7):
        scene = with_an_air_of(*profile)
        row = scene.solid()
        if make == "ball":
            scene.sphere((20_000, 0, 30), 5, row)
        elif make == "plane":
            scene.plane([(20_000, 0, 0), (20_000, 1, 0), (20_000, 0, 1)], row)
        elif make == "plate":
            scene.rectangle([(20_000, -9, 40), (20_000, -9, 20), (20_000, 9, 20)], row)
        else:
            # A box whose top, or bottom, is at the boundary.
            low, high = (30, 60) if make == "floor" else (0, 30)
            corners = [(x, y, z) for x in (20_000, 20_500) for y in (-900, 900) for z in (low, high)]
            quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
            scene.mesh(corners, [half for a, b, c, d in quads for half in ((a, b, c), (a, c, d))], row)
        view = scene.scene.view
        scene.set(view=view._replace(eye=(0.0, 0.0, 30 + moved)))
        depths.append(m3d_render.prepare(scene.build()).render(aov=["depth"]).layers["depth"][2, 2].item())
    level, above, below = depths
    assert level in (pytest.approx(above, abs=0.5), pytest.approx(below, abs=0.5)), depths
