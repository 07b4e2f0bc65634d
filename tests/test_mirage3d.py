"""The command line of 1993: its options, defaults, files and messages."""

from __future__ import annotations

from pathlib import Path
from typing import Unpack

import numpy as np
import pytest
from numpy.typing import NDArray

import m3dc
from m3d_render import RenderOptions, render, wireframe
from m3d_render.picture import to_bytes
from mirage3d.cli import main

SCENE = """SCENE { LOGSCALE 5 SKY { } VIEW { FROM <8,0,1> TO <0,0,1> WIDTH 20 HEIGHT 12 } }
SOLID { SPHERE { RADIUS 2 } }
SOLID { PLANE { } SURFACE { COLOR <1,0,0> } }
"""


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "scene"
    path.write_text(SCENE)
    return path


def planes(height: int, width: int, *names: str) -> NDArray[np.uint8]:
    files = names or ("red.raw", "green.raw", "blue.raw")
    return np.stack([np.fromfile(name, np.uint8).reshape(height, width) for name in files], axis=-1)


def expected(**options: Unpack[RenderOptions]) -> NDArray[np.uint8]:
    return to_bytes(render(m3dc.compile(SCENE).ir, **options))


def test_without_arguments_it_lists_its_commands(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    listing = capsys.readouterr().out
    for command in "rgbDExwhsedlSNW":
        assert f"  -{command}" in listing


def test_the_default_files(scene: Path) -> None:
    assert main(["scene"]) == 0
    np.testing.assert_array_equal(planes(12, 20), expected())


def test_options_in_any_order(scene: Path) -> None:
    assert main(["-w30", "-S", "scene", '-r"r"', "-gg", "-l10", "-bb", "-d1", "-h10"]) == 0
    np.testing.assert_array_equal(
        planes(10, 30, "r", "g", "b"), expected(width=30, height=10, shadows=True, log_scale=10, depth=1)
    )


def test_rows(scene: Path) -> None:
    assert main(["scene", "-s3", "-e7"]) == 0
    np.testing.assert_array_equal(planes(5, 20), expected(width=20, height=12)[3:8])


def test_scaling(scene: Path) -> None:
    assert main(["scene", "-xbuffer"]) == 0
    np.testing.assert_array_equal(planes(12, 20), expected(normalize=True))
    assert not Path("buffer").exists()


def test_wireframe(scene: Path) -> None:
    assert main(["scene", "-W"]) == 0
    np.testing.assert_array_equal(planes(12, 20), to_bytes(wireframe.draw(m3dc.compile(SCENE).ir)))


def test_dump_and_echo(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scene", "-D"]) == 0
    assert "Scene Definition" in capsys.readouterr().out
    assert main(["scene", '-D"debug"', "-E"]) == 0
    assert "    1   SCENE { LOGSCALE 5" in capsys.readouterr().out
    assert "Scene Definition" in Path("debug").read_text()
    assert not Path("red.raw").exists(), "a dump makes no picture"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-w20"], "No input file specified"),
        (["nothing"], "Unable to open input file"),
        (["scene", "-r"], "Missing file name for -r command"),
        (["scene", "-g"], "Missing file name for -g command"),
        (["scene", "-b"], "Missing file name for -b command"),
        (["scene", "-w"], "Missing argument for -w command"),
        (["scene", "-w0"], "Invalid width specified for -w command"),
        (["scene", "-w1024"], "Invalid width specified for -w command"),
        (["scene", "-wide"], "Invalid width specified for -w command"),
        (["scene", "-h"], "Missing argument for -h command"),
        (["scene", "-h0"], "Invalid height specified for -h command"),
        (["scene", "-s"], "Missing argument for -s command"),
        (["scene", "-s-1"], "Invalid starting row specified for -s command"),
        (["scene", "-s9", "-e3"], "Invalid starting row specified for -s command"),
        (["scene", "-e"], "Missing argument for -e command"),
        (["scene", "-e1024"], "Invalid ending row specified for -e command"),
        (["scene", "-d"], "Missing argument for -d command"),
        (["scene", "-d0"], "Invalid depth specified for -d command"),
        (["scene", "-l"], "Missing argument for -l command"),
        (["scene", "-l1"], "Invalid log scale value specified for -l command"),
        (["scene", "-lnan"], "Invalid log scale value specified for -l command"),
        (["scene", "-Dno/such/folder/debug"], "Unable to open debug file"),
        (["scene", "-xno/such/folder/buffer"], "Unable to open buffer file"),
        (["scene", "-rno/such/folder/red"], "Unable to open RED image file for output"),
        (["scene", "-gno/such/folder/green"], "Unable to open GREEN image file for output"),
        (["scene", "-bno/such/folder/blue"], "Unable to open BLUE image file for output"),
        (["scene", "other"], "More than one input file specified"),
        (["scene", "-q"], "Unknown command -q"),
    ],
)
def test_messages_of_1993(arguments: list[str], message: str, scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 2
    assert capsys.readouterr().err.startswith(f"Unrecoverable Error: {message}")
    assert not Path("red.raw").exists()


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("SOLID { SPHERE { CENTER 5 } }", "Syntax Error : Expecting a vector constant or variable"),
        ("SOLID { SPHERE { RADIUS -5.8 } }", "Data Error : Sphere radius must be > 0"),
        ("SOLID { }", "Unrecoverable Error : Adding Solid object with no primitives"),
        ("", "Unrecoverable Error : Empty data file"),
    ],
)
def test_errors_of_a_scene(text: str, shown: str, scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene.write_text(text)
    assert main(["scene"]) == 1
    message = capsys.readouterr().err
    assert shown in message
    line, caret, *_ = message.split("\n")
    assert line == f"1 {text}"
    assert caret.strip() == "^"


def test_wrong_normals_are_an_error_when_asked_for(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    facet = "VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> } SFACETS { 1 0 1 2 <0,0,1> <0,0,1> <0,0,-1> }"
    scene.write_text(f"SCENE {{ SKY {{ }} VIEW {{ WIDTH 4 HEIGHT 4 }} }} SOLID {{ POLYGONS {{ PHONG {facet} }} }}")
    assert main(["scene"]) == 0
    assert "Warning : Normal on wrong side of facet" in capsys.readouterr().err
    assert main(["scene", "-N"]) == 1
    assert "Data Error : Normal on wrong side of facet" in capsys.readouterr().err
