"""Pictures in files."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest
from numpy.typing import NDArray
from pictures import channel_names, read_pixels, stored

import m3d_render
import m3dc
from m3d_render import Picture
from m3d_render.formats import SUFFIXES
from m3d_render.picture import linear, paths, to_bytes


@pytest.fixture
def picture():
    return np.random.default_rng(3).uniform(0, 1, (5, 7, 3)).astype(np.float32)


@pytest.mark.parametrize(("suffix", "step"), [("png", 255), ("tif", 65535), ("exr", None), ("PNG", 255)])
def test_what_is_written_can_be_read(tmp_path: Path, picture: Picture, suffix: str, step: int | None):
    path = tmp_path / f"a b.{suffix}"
    assert m3d_render.write_picture(path, picture, {"Software": "m3d-render test"}) == [path]
    read = OpenImageIO.ImageBuf(str(path))
    assert read.spec().getattribute("Software") == "m3d-render test"
    pixels = read_pixels(read, OpenImageIO.FLOAT)
    pixels = pixels[..., [channel_names(read).index(name) for name in "RGB"]]
    expected = linear(picture) if step is None else np.rint(picture * step) / step
    np.testing.assert_allclose(pixels, expected, atol=1e-6)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_all_formats_mean_the_same_brightness(tmp_path: Path):
    """Each converted to linear light by what its file says it holds."""
    picture = np.linspace(0, 1, 256 * 3, dtype=np.float32).reshape(16, 16, 3)
    found: dict[str, NDArray[np.float32]] = {}
    for suffix in ("png", "tif", "exr"):
        path = tmp_path / f"a.{suffix}"
        m3d_render.write_picture(path, picture)
        read = OpenImageIO.ImageBuf(str(path))
        space = read.spec().getattribute("oiio:ColorSpace")
        light = OpenImageIO.ImageBufAlgo.colorconvert(read, space, "lin_rec709_scene")
        assert not light.has_error, light.geterror()
        found[suffix] = read_pixels(light, OpenImageIO.FLOAT)
    np.testing.assert_allclose(found["exr"], linear(picture), atol=1e-7)
    np.testing.assert_allclose(found["tif"], found["exr"], atol=5e-5)
    np.testing.assert_allclose(found["png"], found["exr"], atol=5e-3)
    assert b"sRGB" in (tmp_path / "a.png").read_bytes()[:200]


@pytest.mark.parametrize("suffix", ["png", "tif", "exr"])
def test_a_picture_holds_no_time_but_the_one_that_is_asked_for(
    tmp_path: Path, picture: Picture, suffix: str, monkeypatch: pytest.MonkeyPatch
):
    def written():
        path = tmp_path / f"a.{suffix}"
        m3d_render.write_picture(path, picture)
        return path.read_bytes(), OpenImageIO.ImageBuf(str(path)).spec().getattribute("DateTime")

    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    assert written()[1] is None
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "760000000")
    content, date = written()
    assert date == "1994:01:31 07:06:40"
    assert written()[0] == content


NOT_UTF8 = os.fsdecode(b"caf\xe9")


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_name_may_be_no_utf8(tmp_path: Path, picture: Picture, suffix: str):
    folder = tmp_path / NOT_UTF8
    folder.mkdir()
    for path in m3d_render.write_picture(folder / f"{NOT_UTF8}{suffix}", picture):
        assert path.stat().st_size


FULL = """
import resource, sys
import numpy as np
from m3d_render.picture import PictureError, write_picture

# Nothing can be written beyond so many bytes, as on a disk that is full.
picture = np.random.default_rng(3).uniform(0, 1, (200, 300, 3)).astype(np.float32)
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), resource.RLIM_INFINITY))
try:
    write_picture(sys.argv[1], picture)
except PictureError as error:
    sys.exit(str(error))
"""


@pytest.mark.slow
@pytest.mark.parametrize("room", [0, 5000, -1])
@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_full_disk_leaves_the_old_file(tmp_path: Path, suffix: str, room: int):
    path = tmp_path / f"a{suffix}"
    olds = paths(path, suffix)
    if room < 0:  # the last byte is missing
        words = [sys.executable, "-c", FULL, str(path), str(2**40)]
        assert subprocess.run(words, check=False).returncode == 0
        room += olds[0].stat().st_size
    for old in olds:
        old.write_text("old")
    done = subprocess.run(
        [sys.executable, "-c", FULL, str(path), str(room)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert str(olds[0]) in done.stderr
    assert done.stderr.count("\n") == 1, done.stderr
    assert {entry.name for entry in tmp_path.iterdir()} == {old.name for old in olds}
    assert {old.read_text() for old in olds} == {"old"}


def test_planar_files(tmp_path: Path, picture: Picture):
    written = m3d_render.write_picture(tmp_path / "scene.v1.raw", picture)
    assert [path.name for path in written] == ["scene.v1.red.raw", "scene.v1.green.raw", "scene.v1.blue.raw"]
    for channel, path in enumerate(written):
        assert path.read_bytes() == to_bytes(picture)[..., channel].tobytes()


def test_eight_bits_are_rounded_and_clipped():
    values = np.array([-1, 0, 0.5 / 255 - 1e-6, 0.5 / 255 + 1e-6, 0.5, 1, 7])
    np.testing.assert_array_equal(to_bytes(values), [0, 0, 0, 1, 128, 255, 255])


@pytest.mark.parametrize("name", ["picture", "picture.jpg", "picture.png.txt"])
def test_an_unknown_suffix_is_refused(tmp_path: Path, picture: Picture, name: str):
    with pytest.raises(m3d_render.PictureError, match="must name the picture's format"):
        m3d_render.write_picture(tmp_path / name, picture)


def test_a_failed_write_leaves_the_old_file(tmp_path: Path, picture: Picture, monkeypatch: pytest.MonkeyPatch):
    path = tmp_path / "old.png"
    path.write_text("old")
    wide = np.zeros((2, 2, 3, 2))
    with pytest.raises(ValueError, match="unpack"):
        m3d_render.write_picture(path, wide)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(m3d_render.PictureError, match="No space left"):
        m3d_render.write_picture(path, picture)
    assert path.read_text() == "old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["old.png"]


def test_a_folder_that_does_not_exist(tmp_path: Path, picture: Picture):
    with pytest.raises(m3d_render.PictureError, match="No such file"):
        m3d_render.write_picture(tmp_path / "none" / "a.exr", picture)


def notebook_png(rendering: m3d_render.Rendering) -> bytes | None:
    return rendering._repr_png_()  # pyright: ignore[reportPrivateUsage]  the name that notebooks call


def test_a_rendering_shows_itself_in_a_notebook(tmp_path: Path):
    scene = m3dc.compile("SCENE { SKY { } VIEW { WIDTH 16 HEIGHT 10 } } SOLID { SPHERE { } }").ir
    rendering = m3d_render.prepare(scene).render()
    shown = notebook_png(rendering)
    assert shown
    (tmp_path / "a.png").write_bytes(shown)
    pixels = stored(tmp_path / "a.png")
    np.testing.assert_array_equal(pixels, to_bytes(rendering.picture))
    assert notebook_png(replace(rendering, picture=rendering.picture[:0])) is None, "there is nothing to see"
