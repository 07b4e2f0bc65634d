"""The m3d-rays command."""

from __future__ import annotations

import csv
import io
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scene_builder import SceneBuilder, merman

from m3d_render.optics import trace_crossings, trace_paths
from m3dc.ir import SceneIR, m3ir

pytestmark = pytest.mark.slow


def command(*arguments: object, **options: Any) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, "-m", "m3d_render.rays_cli", *map(str, arguments)]
    return subprocess.run(words, check=False, capture_output=True, text=True, timeout=60, **options)


@pytest.fixture(scope="module")
def ir():
    return merman(4, 4).build()


@pytest.fixture
def compiled(ir: SceneIR, tmp_path: Path):
    m3ir.write(ir, tmp_path / "merman.m3ir")
    return tmp_path / "merman.m3ir"


def rows(text: str):
    table = list(csv.reader(io.StringIO(text)))
    assert table[0] == ["angle_arcmin", "r_m", "z_m", "end"]
    return [(float(angle), float(r), float(z), end) for angle, r, z, end in table[1:]]


def test_at_given_distances(ir: SceneIR, compiled: Path):
    done = command(compiled, "--angles=-2:2:0.5", "--at=100,700,1400,50000")
    assert (done.returncode, done.stderr) == (0, "")
    table = rows(done.stdout)
    angles = np.arange(-2, 2.1, 0.5)
    assert sorted({row[0] for row in table}) == angles.tolist()
    paths = trace_paths(ir, np.radians(angles / 60), at=[100, 700, 1400, 50_000])
    for i, angle in enumerate(angles):
        own = [row for row in table if row[0] == angle]
        reached = paths.heights[i][~np.isnan(paths.heights[i])]
        np.testing.assert_allclose([row[2] for row in own[:-1]], reached, atol=1e-6)
        assert [row[3] for row in own] == [""] * len(reached) + [paths.ends[i]]
        np.testing.assert_allclose(own[-1][1:3], paths.end_points[i], atol=1e-6)


def test_at_every_crossing(ir: SceneIR, compiled: Path, tmp_path: Path):
    table_file = tmp_path / "a.csv"
    done = command(compiled, "--angles=3:-3:-1.5", f"--csv={table_file}")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    table = rows(table_file.read_text())
    for angle in (3, 1.5, 0, -1.5, -3):
        own = [row for row in table if row[0] == angle]
        crossings = trace_crossings(ir, math.radians(angle / 60))
        np.testing.assert_allclose([row[1:3] for row in own], crossings, atol=1e-6)
        assert all(row[3] == "" for row in own[:-1])
        assert own[-1][3] in {"ground", "top", "range", "segments"}


def test_every_way_to_end(tmp_path: Path):
    def ends(angle: float, **mirage: Any):
        scene = SceneBuilder((0, 0, 2), (1, 0, 2)).mirage([(0, 10), (1, 10.1), (3, 12), (5, 10)], **mirage)
        m3ir.write(scene.build(), tmp_path / "a.m3ir")
        done = command(tmp_path / "a.m3ir", f"--angles={angle}:{angle}:1")
        assert done.returncode == 0, done.stderr
        return rows(done.stdout)[-1][3]

    assert ends(-60) == "ground"
    assert ends(60) == "top"
    assert ends(0, distance=100.0) == "range"
    assert ends(60, segments=1) == "segments"


@pytest.mark.parametrize(
    ("arguments", "status", "says"),
    [
        (["--angles=1:2"], 2, "FROM:TO:STEP is expected"),
        (["--angles=1:2:0"], 2, "do not lead"),
        (["--angles=1:2:-1"], 2, "do not lead"),
        (["--angles=1:x:1"], 2, "a number is expected"),
        (["--angles=0:5400:1"], 2, "between -5400 and 5400"),
        (["--angles=0:5000:1e-9"], 2, "more than 1,000,000"),
        (["--angles=0:1:1", "--at=1,-2"], 2, "below 0"),
        (["--angles=0:1:1", "--csv=none/a.csv"], 2, "the folder none does not exist"),
        ([], 2, "--angles"),
    ],
)
def test_what_cannot_be_done_is_said(compiled: Path, tmp_path: Path, arguments: list[str], status: int, says: str):
    done = command(compiled, *arguments, cwd=tmp_path)
    assert done.returncode == status
    assert says in done.stderr
    assert "Traceback" not in done.stderr


def test_a_scene_without_a_mirage_is_status_1(tmp_path: Path):
    (tmp_path / "a.m3d").write_text("SOLID { SPHERE { } }")
    done = command(tmp_path / "a.m3d", "--angles=0:1:1")
    assert done.returncode == 1
    assert "no MIRAGE" in done.stderr
    assert done.stdout == ""
    assert command(tmp_path / "none.m3d", "--angles=0:1:1").returncode == 2
