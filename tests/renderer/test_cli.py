"""The m3d-render command: exit status, messages, statistics."""

from __future__ import annotations

import contextlib
import json
import os
import pty
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO
import pytest
from pictures import channel_names, float_pixels, read_pixels
from scene_builder import merman

import m3d_render
from m3d_render.picture import linear
from m3dc.ir import m3ir

pytestmark = pytest.mark.slow

SCENE = "SCENE { VIEW { WIDTH 12 HEIGHT 8 } BACKGROUND <0.2, 0.4, 0.6> }"


def command(*arguments: object, **options: Any) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, "-m", "m3d_render.cli", *map(str, arguments)]
    return subprocess.run(words, check=False, capture_output=True, text=True, timeout=60, **options)


@pytest.fixture
def compiled(tmp_path: Path):
    path = tmp_path / "merman.m3ir"
    m3ir.write(merman(32, 20).build(), path)
    return path


def test_a_compiled_scene_and_its_statistics(compiled: Path, tmp_path: Path):
    done = command(compiled, "-o", tmp_path / "a.png", "--stats", "--threads", "2")
    assert (done.returncode, done.stderr) == (0, "")
    stats = json.loads(done.stdout)
    assert set(stats["seconds"]) == {"load", "build", "trace", "write"}
    assert stats["rays"]["eye"] == stats["rays"]["mirage"] == 640
    assert stats["rays"]["shadow"] == 0
    assert stats["arcs"] > 640
    assert stats["peak_memory"] > 1_000_000
    assert (stats["width"], stats["height"], stats["threads"]) == (32, 20, 2)


@pytest.mark.parametrize("suffix", ["png", "tif", "exr"])
def test_a_picture_says_what_it_is(compiled: Path, tmp_path: Path, suffix: str):
    picture = tmp_path / f"a.{suffix}"
    assert command(compiled, "-o", picture, "--straight", "--rows", "3:9").returncode == 0
    read = OpenImageIO.ImageBuf(str(picture)).spec().getattribute
    assert read("Software").startswith("m3d-render ")
    said = "merman.m3ir; mirage off; from 1 0 2.1; to 0 0 2.1001; fov 1.5; tilt 0; size 32 20; region 3 0 9 31"
    assert read("ImageDescription") == said
    if suffix != "tif":
        assert read("mirage3d:mirage") == "off"
        assert read("mirage3d:region") == "3 0 9 31"


def test_options_change_the_picture(compiled: Path, tmp_path: Path):
    def pixels(*options: str):
        done = command(compiled, "-o", tmp_path / "a.exr", *options)
        assert done.returncode == 0, done.stderr
        return float_pixels(tmp_path / "a.exr")

    plain = pixels()
    assert pixels("--width", "16", "--height", "10").shape == (10, 16, 3)
    for options in (["--straight"], ["--shadows"], ["--log-scale", "3"]):
        assert not np.array_equal(pixels(*options), plain), options


def test_a_source_text(tmp_path: Path):
    source = tmp_path / "scene.m3d"
    source.write_text(SCENE)
    done = command(source, "-o", tmp_path / "a.raw")
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    assert (tmp_path / "a.green.raw").read_bytes() == bytes([102]) * 96
    piped = command("-", "-o", tmp_path / "b.raw", input=SCENE)
    assert piped.returncode == 0, piped.stderr
    assert (tmp_path / "b.blue.raw").read_bytes() == bytes([153]) * 96


def test_hints_are_not_shown(tmp_path: Path):
    scene = tmp_path / "a.m3d"
    moved = "SOLID { SPHERE { } SURFACE { TEXTURE { CHECKER { } } } TRANSFORM { TRANSX 1 } }"
    scene.write_text(f"SCENE {{ SKY {{ }} VIEW {{ WIDTH 4 HEIGHT 4 }} }} {moved}")
    done = command(scene, "-o", tmp_path / "a.png")
    assert (done.returncode, done.stderr) == (0, "")


def test_a_scene_with_errors_is_status_1(tmp_path: Path):
    source = tmp_path / "scene.m3d"
    source.write_text("SCENE { VIEW { FOV <1,2,3> } }")
    done = command(source, "-o", tmp_path / "a.png")
    assert done.returncode == 1
    assert "scene.m3d:1:" in done.stderr
    assert not (tmp_path / "a.png").exists()


def test_a_scene_that_cannot_be_rendered_is_status_1(tmp_path: Path):
    path = tmp_path / "high.m3ir"
    scene = merman(4, 4)
    scene.rows["profile"] = [row for row in scene.rows["profile"] if row["elevation"] < 2]
    m3ir.write(scene.build(), path)
    done = command(path, "-o", tmp_path / "a.png")
    assert done.returncode == 1
    assert "outside of the temperature profile, 0 to 1.9" in done.stderr
    assert "straight rays" in done.stderr
    assert command(path, "-o", tmp_path / "a.png", "--straight").returncode == 0


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["none.m3d", "-o", "a.png"], "none.m3d: No such file or directory"),
        (["none.m3ir", "-o", "a.png"], "none.m3ir: No such file or directory"),
        (["binary.m3ir", "-o", "a.png"], "binary.m3ir: "),
        (["scene.m3d", "-o", "a.jpg"], "one of .png"),
        (["scene.m3d", "-o", "picture"], "no suffix"),
        (["scene.m3d", "-o", "none/a.png"], "the folder none does not exist"),
        (["scene.m3d", "-o", "scene.m3d/a.png"], "is not a folder"),
        (["scene.m3d", "-o", "folder.png"], "in the way"),
        (["folder.png", "-o", "a.png"], "Is a directory"),
        (["scene.m3d"], "-o"),
        (["scene.m3d", "-o", "a.png", "--width", "0"], "not from 1 to 65535"),
        (["scene.m3d", "-o", "a.png", "--height", "x"], "a whole number is expected"),
        (["scene.m3d", "-o", "a.png", "--log-scale", "nan"], "a number is expected"),
        (["scene.m3d", "-o", "a.png", "--depth", "0"], "not from 1"),
        (["scene.m3d", "-o", "a.png", "--nonsense"], "unrecognized"),
        (["scene.m3d", "-o", "a.png", "--aov", "depth"], "only an .exr"),
        (["scene.m3d", "-o", "a.exr", "--aov", "depht"], "'depht' is none of depth, normal"),
        (["scene.m3d", "-o", "a.png", "--rows", "3"], "A:B is expected"),
        (["scene.m3d", "-o", "a.png", "--rows", "5:4"], "no pixel lies between"),
        (["scene.m3d", "-o", "a.png", "--rows", "8:9"], "outside of a picture of 12 columns and 8 rows"),
        (["scene.m3d", "-o", "a.png", "--region", "1,2,3"], "T,L,B,R is expected"),
        (["scene.m3d", "-o", "a.png", "--region", "1,2,3,4", "--rows", "1:2"], "not allowed with"),
        (["scene.m3d", "-o", "a.png", "--samples", "0"], "not from 1"),
        (["binary.m3ir", "--check-normals"], "give the .m3d"),
    ],
)
def test_usage_and_files_are_status_2(tmp_path: Path, arguments: list[str], says: str):
    (tmp_path / "scene.m3d").write_text(SCENE)
    (tmp_path / "binary.m3ir").write_bytes(bytes(range(256)))
    (tmp_path / "folder.png").mkdir()
    before = sorted(entry.name for entry in tmp_path.iterdir())
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path[1:]))}
    done = command(*arguments, cwd=tmp_path, env=environment)
    assert done.returncode == 2, done.stderr
    assert says in done.stderr
    assert "Traceback" not in done.stderr
    assert sorted(entry.name for entry in tmp_path.iterdir()) == before


def test_extra_outputs_are_channels_of_an_exr(compiled: Path, tmp_path: Path):
    picture = tmp_path / "a.exr"
    done = command(compiled, "-o", picture, "--aov", "all", "--region", "2,3,11,20")
    assert done.returncode == 0, done.stderr
    read = OpenImageIO.ImageBuf(str(picture))
    names = {"R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "solid", "primitive", "U", "V"}
    assert set(channel_names(read)) == names | {"path.length", "path.arcs"}
    spec = read.spec()
    assert (spec.x, spec.y, spec.width, spec.height, spec.full_width, spec.full_height) == (3, 2, 18, 10, 32, 20)
    rendering = m3d_render.prepare(m3ir.read(compiled)).render(aov=["path", "position"], region=(2, 3, 11, 20))
    pixels = read_pixels(read, OpenImageIO.FLOAT)
    for name, values in [
        ("B", linear(rendering.picture)[..., 2]),
        ("path.arcs", rendering.layers["path"][..., 1]),
        ("P.Y", rendering.layers["position"][..., 1]),
    ]:
        np.testing.assert_array_equal(pixels[..., channel_names(read).index(name)], values)


def test_rows_of_separate_runs_join(compiled: Path, tmp_path: Path):
    def planes(name: str, *options: str):
        assert command(compiled, "-o", tmp_path / f"{name}.raw", *options).returncode == 0
        return (tmp_path / f"{name}.red.raw").read_bytes()

    assert planes("top", "--rows", "0:6") + planes("foot", "--rows", "7:19") == planes("whole")


MESH = """SOLID {{ POLYGONS {{ PHONG VERTICES {{ 3 <0,0,0> <1,0,0> <0,1,0> }}
SFACETS {{ 1  0 1 2  <0,0,1> <0,0,1> <0,0,{}> }} }} }}"""


@pytest.mark.parametrize(("z", "status"), [(1, 0), (-1, 1)])
def test_normals_are_checked(tmp_path: Path, z: int, status: int):
    done = command("-", "--check-normals", input=MESH.format(z), cwd=tmp_path)
    assert done.returncode == status, done.stderr
    assert ("Normal on wrong side of facet" in done.stderr) == bool(status)
    assert not list(tmp_path.iterdir())


def test_an_interrupt_is_status_130_and_keeps_the_finished_rows(compiled: Path, tmp_path: Path):
    # Slow by its many samples. The interrupt comes once the line of progress says that rows are finished.
    options = ["--width", "400", "--height", "2000", "--samples", "64"]
    whole, part = tmp_path / "whole.exr", tmp_path / "part.exr"
    terminal, end = pty.openpty()
    words = [sys.executable, "-m", "m3d_render.cli", str(compiled), "-o", str(part), *options]
    process = subprocess.Popen(words, stderr=end)
    os.close(end)
    said = ""
    while not re.search(r"[1-9]\d* of 2000 rows", said):
        said += os.read(terminal, 4096).decode()
    process.send_signal(signal.SIGINT)
    with contextlib.suppress(OSError):  # which says that the other end is closed
        while more := os.read(terminal, 4096):
            said += more.decode()
    os.close(terminal)
    assert process.wait() == 130, said
    assert "Traceback" not in said
    rows = re.search(r"part\.exr holds rows 0 to (\d+); rows from (\d+) on", said)
    assert rows, said
    done = int(rows[2])
    assert 0 < done < 2000
    assert command(compiled, "-o", whole, *options, "--rows", f"0:{done - 1}").returncode == 0
    finished = float_pixels(part)
    np.testing.assert_array_equal(float_pixels(whole), finished)
    assert finished.shape == (done, 400, 3)


# The command, with an interrupt as it asks for the thirtieth time whether there was one.
INTERRUPTED = """
import itertools, signal, sys
from m3d_render.cli import main
from m3dc.files.interrupt import Interrupt

look, looks = Interrupt.asked, itertools.count(1)

def asked(self):
    if next(looks) == 30:
        signal.raise_signal(signal.SIGINT)
    return look(self)

Interrupt.asked = asked
sys.exit(main())
"""


def test_an_interrupt_before_a_row_is_finished_leaves_the_old_picture(compiled: Path, tmp_path: Path):
    picture = tmp_path / "a.png"
    picture.write_text("old")
    # A single row takes an hour.
    size = ["--width", "60000", "--height", "2", "--samples", "65536"]
    words = [sys.executable, "-c", INTERRUPTED, str(compiled), "-o", str(picture), *size]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 130, done.stderr
    assert done.stderr.strip() == "m3d-render: interrupted: no row was finished, and no picture written"
    assert picture.read_text() == "old"


def test_the_command_starts_without_what_it_does_not_need():
    code = "import sys, m3d_render.cli; print(sorted({'OpenImageIO', 'pygls', 'pyvista', 'scipy'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
