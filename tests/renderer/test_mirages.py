"""The scenes of mirages show what they are named after."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import m3dc
from m3d_render import plot, prepare
from m3d_render.optics import EARTH_CURVATURE, trace_paths
from m3dc.ir import SceneIR

MINUTES = np.pi / 180 / 60


def scene(examples: Path, name: str):
    result = m3dc.compile((examples / f"{name}.m3d").read_bytes(), name)
    assert result.diagnostics == ()
    return result.ir


def images(ir: SceneIR, distance: float, height: float):
    """The images of one height at a distance, from the lowest: upright (+1) or upside down (-1)."""
    seen = plot.transfer_characteristic(ir, [distance]).heights[0]
    apart = seen - height
    return np.sign(np.diff(seen))[apart[:-1] * apart[1:] < 0].tolist()


def test_the_hot_road_turns_over_what_stands_on_it(examples: Path):
    ir = scene(examples, "hot-road")
    assert images(ir, 600, 1.0) == [-1, 1]
    assert images(ir, 600, 3.0) == [1], "too high for a second image"
    assert images(ir, 600, 0.03) == [], "below the vanishing line"
    # The car's lamps are the solid of 600 m that is nearest; they are seen twice, the lower pair in the pool.
    lamps = 6
    solid = prepare(ir).render(aov=["solid"]).layers["solid"]
    rows = np.flatnonzero((solid == lamps).any(axis=1))
    assert (np.diff(rows) > 1).sum() == 1
    assert len(rows) > 8


def test_the_fata_morgana_has_three_images(examples: Path):
    ir = scene(examples, "fata-morgana")
    assert images(ir, 18_000, 12.0) == [1, -1, 1]
    assert images(ir, 12_000, 8.0) == [1]
    # The middle one is the highest: the coast of 9 m becomes a wall.
    zones = plot.transfer_characteristic(ir, [18_000.0]).zones(0)
    heights = {zone.kind: zone.high - zone.low for zone in sorted(zones, key=lambda zone: zone.high - zone.low)}
    assert heights["inverted"] > 5 * MINUTES


def test_the_novaya_zemlya_duct_carries_light_around_the_earth(examples: Path):
    ir = scene(examples, "novaya-zemlya")
    paths = trace_paths(ir, np.arange(-4, 4.1, 0.5) * MINUTES, at=[200_000])
    assert set(paths.ends) == {"range"}
    assert (paths.heights < 30).all()
    assert np.degrees(200_000 * EARTH_CURVATURE) > 1.75
    # The sun, 32 by 32 arcminutes, is seen half as high as wide; 480 pixels are 90 arcminutes.
    primitive = prepare(ir).render(aov=["primitive"]).layers["primitive"]
    sun = 1
    rows, columns = np.nonzero(primitive == sun)
    assert np.ptp(columns) * 90 / 480 == pytest.approx(32, abs=1)
    assert np.ptp(rows) * 90 / 480 < 12


@pytest.mark.parametrize(("distance", "elevation"), [("3", 7), ("2.68", 6.2), ("2.6", 6), ("1.4", 3)])
def test_the_pilot_comes_in(examples: Path, distance: str, elevation: float):
    command = [sys.executable, str(examples / "approach.py"), distance, "--fov", "7", "--level"]
    result = m3dc.compile(subprocess.run(command, capture_output=True, check=True).stdout)
    assert result.diagnostics == ()
    view = result.ir.scene.view
    assert view.eye == (1000 * float(distance), 0, elevation)
    assert (view.target, view.fov) == ((0, 0, elevation), 7)


def test_the_pilot_sees_images_only_from_within_the_thermocline(examples: Path):
    runway = (examples / "runway.m3d").read_text()

    def from_height(eye: float, height: float):
        text = runway.replace(
            "FROM < 3000, 0, 7 > TO < 0, 0, 0 > FOV 14", f"FROM < 3000, 0, {eye} > TO < 0, 0, {eye} > FOV 1"
        )
        return images(m3dc.compile(text).ir, 3000, height)

    assert from_height(7, 0.2) == [1]
    assert from_height(6.2, 0.2) == [1, -1, 1]
    assert from_height(5, 2.0) == [1, -1, 1]
