"""The m3d-plot command: figures and tables of scenes."""

from __future__ import annotations

import csv
import io
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from exit_status import exit_status
from pictures import stored
from scene_builder import merman

from m3d_render import plot
from m3d_render.plot.cli import main
from m3dc.ir import SceneIR, m3ir

pytestmark = pytest.mark.slow

SIGNATURES = {".svg": b"<?xml", ".pdf": b"%PDF", ".png": b"\x89PNG"}


@pytest.fixture(scope="module")
def ir():
    return merman(4, 4).build()


@pytest.fixture
def compiled(ir: SceneIR, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    m3ir.write(ir, tmp_path / "merman.m3ir")
    monkeypatch.chdir(tmp_path)
    return "merman.m3ir"


def table(text: str):
    names, *rows = csv.reader(io.StringIO(text))
    return {name: [row[i] for row in rows] for i, name in enumerate(names)}


def numbers(column: list[str]):
    return np.array([float(value) if value else np.nan for value in column])


@pytest.mark.parametrize("suffix", SIGNATURES)
@pytest.mark.parametrize("figure", ["profile", "rays", "transfer"])
def test_every_figure_in_every_format_twice_the_same(compiled: str, figure: str, suffix: str):
    for name in ("first", "second"):
        assert main([figure, compiled, "-o", name + suffix, "--size", "12x8"]) == 0
    first, second = (Path(name + suffix).read_bytes() for name in ("first", "second"))
    assert first.startswith(SIGNATURES[suffix])
    assert first == second


def test_a_picture_has_the_size_that_was_asked_for(compiled: str):
    assert main(["rays", compiled, "-o", "fan.png", "--size", "12x8"]) == 0
    pixels = stored(Path("fan.png"))
    np.testing.assert_allclose(pixels.shape[:2], [8 / 2.54 * 110, 12 / 2.54 * 110], atol=1)
    assert pixels.min() < 40
    assert pixels.max() == 255


def test_the_table_of_a_profile(compiled: str, ir: SceneIR, capsys: pytest.CaptureFixture[str]):
    assert main(["profile", compiled, "--csv", "-"]) == 0
    found, profile = table(capsys.readouterr().out), plot.temperature_profile(ir)
    np.testing.assert_allclose(numbers(found["bottom_m"])[1:], numbers(found["top_m"])[:-1])
    np.testing.assert_allclose(numbers(found["gradient_K_per_m"]), profile.gradient, rtol=1e-9)
    np.testing.assert_allclose(numbers(found["effective_per_m"]), profile.layers.effective, rtol=1e-9)
    assert list(found) == [
        "bottom_m", "top_m", "bottom_C", "top_C", "gradient_K_per_m", "curvature_per_m", "effective_per_m",
    ]  # fmt: skip


def test_the_table_of_a_fan(compiled: str, capsys: pytest.CaptureFixture[str]):
    assert main(["rays", compiled, "--csv=-", "--angles=-4:7:0.5", "--reach=1500"]) == 0
    found = table(capsys.readouterr().out)
    kinds, ends = np.array(found["kind"]), np.array(found["end"])
    assert set(kinds) == {"ray", "crossing", "solid"}
    angle, r, z = (numbers(found[name]) for name in ("angle_arcmin", "r_m", "z_m"))
    rays = kinds == "ray"
    np.testing.assert_allclose(np.unique(angle[rays]), np.arange(-4, 7.1, 0.5), atol=1e-9)
    assert (r[rays] <= 1500).all()
    grounded = rays & (ends == "ground")
    assert grounded.any()
    assert (z[grounded] < 0.05).all()
    wall = kinds == "solid"
    np.testing.assert_allclose(r[wall], 1401)
    assert (z[wall].min(), z[wall].max()) == (0, 1)


def test_the_table_of_a_transfer_characteristic(compiled: str, ir: SceneIR, tmp_path: Path):
    arguments = ["transfer", compiled, "--csv", "t.csv", "--at=1000,1400", "--angles=-4:8:0.1", "-o", "t.svg"]
    assert main(arguments) == 0
    found = table(Path("t.csv").read_text())
    angles = np.radians(np.linspace(-4, 8, 121) / 60)
    expected = plot.transfer_characteristic(ir, [1000, 1400], angles)
    np.testing.assert_allclose(numbers(found["z_m"]).reshape(2, -1), expected.heights, rtol=1e-9)
    assert found["zone"] == [*expected.kinds(0), *expected.kinds(1)]
    missed = np.array(found["zone"]) == "missed"
    assert set(np.array(found["end"])[missed]) == {"ground"}
    assert set(np.array(found["end"])[~missed]) == {""}


def test_zones_are_told_apart_without_colour(compiled: str):
    assert main(["transfer", compiled, "--at=1400", "-o", "t.svg"]) == 0
    text = Path("t.svg").read_text()
    assert "clip-path" in text
    assert text.count("<pattern") >= 3, "hatches of inverted, compressed and missed"


@pytest.mark.parametrize(
    ("arguments", "status", "says"),
    [
        (["rays", "merman.m3ir"], 2, "-o FIGURE"),
        (["rays", "merman.m3ir", "-o", "fan.jpg"], 2, ".svg, .png, .pdf must name the figure's format"),
        (["rays", "merman.m3ir", "-o", "none/fan.svg"], 2, "the folder none does not exist"),
        (["rays", "merman.m3ir", "--csv", "none/fan.csv"], 2, "the folder none does not exist"),
        (["rays", "merman.m3ir", "-o", "fan.svg", "--reach=0"], 2, "farther than 0 m"),
        (["rays", "merman.m3ir", "-o", "fan.svg", "--heights=3:1"], 2, "LOW:HIGH is expected"),
        (["rays", "merman.m3ir", "-o", "fan.svg", "--size=1x900"], 2, "from 2 to 100 cm"),
        (["transfer", "merman.m3ir", "-o", "t.svg", "--angles=4:2:-1"], 2, "must increase"),
        (["transfer", "merman.m3ir", "-o", "t.svg", "--at=1,2,3,4,5,6,7"], 2, "room for 6 distances"),
        (["rays", "merman.m3ir", "--csv=-", "--angles=0:900:0.001"], 2, "take larger steps"),
        (["transfer", "merman.m3ir", "--csv=-", "--angles=0:900:0.001", "--at=" + "9," * 99 + "9"], 2, "larger steps"),
        (["profile", "straight.m3d", "-o", "p.svg"], 1, "no MIRAGE"),
        (["profile", "none.m3d", "-o", "p.svg"], 2, "No such file"),
    ],
)
def test_what_cannot_be_done_is_said(
    compiled: str, capsys: pytest.CaptureFixture[str], arguments: list[str], status: int, says: str
):
    Path("straight.m3d").write_text("SOLID { SPHERE { } }")
    assert exit_status(main, arguments) == status
    assert says in capsys.readouterr().err
    assert not list(Path().glob("*.svg"))


def test_without_matplotlib_the_way_to_it_is_said(compiled: str, tmp_path: Path):
    # A module of its name that cannot be imported stands before the real one.
    (tmp_path / "matplotlib.py").write_text("raise ImportError")
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}

    def run(*arguments: str):
        command = [sys.executable, "-m", "m3d_render.plot.cli", *arguments]
        return subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)

    refused = run("rays", compiled, "-o", "fan.svg")
    assert refused.returncode == 2
    assert 'pip install "mirage3d[plot]"' in refused.stderr
    data = run("rays", compiled, "--csv=-")
    assert (data.returncode, data.stderr) == (0, "")
    assert data.stdout.startswith("kind,number,")
