"""Pictures in files."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest

import m3d_render
import m3dc
from m3d_render.picture import to_bytes


@pytest.fixture
def picture():
    return np.random.default_rng(3).uniform(0, 1, (5, 7, 3)).astype(np.float32)


@pytest.mark.parametrize(("suffix", "step"), [("png", 255), ("tif", 65535), ("exr", None), ("PNG", 255)])
def test_what_is_written_can_be_read(tmp_path, picture, suffix, step):
    path = tmp_path / f"a b.{suffix}"
    assert m3d_render.write_picture(path, picture, {"Software": "m3d-render test"}) == [path]
    read = OpenImageIO.ImageBuf(str(path))
    assert read.spec().getattribute("Software") == "m3d-render test"
    pixels = read.get_pixels(OpenImageIO.FLOAT)
    pixels = pixels[..., [read.spec().channelnames.index(name) for name in "RGB"]]
    expected = picture if step is None else np.rint(picture * step) / step
    np.testing.assert_allclose(pixels, expected, atol=1e-6)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_planar_files(tmp_path, picture):
    written = m3d_render.write_picture(tmp_path / "scene.v1.raw", picture)
    assert [path.name for path in written] == ["scene.v1.red.raw", "scene.v1.green.raw", "scene.v1.blue.raw"]
    for channel, path in enumerate(written):
        assert path.read_bytes() == to_bytes(picture)[..., channel].tobytes()


def test_eight_bits_are_rounded_and_clipped():
    values = np.array([-1, 0, 0.5 / 255 - 1e-6, 0.5 / 255 + 1e-6, 0.5, 1, 7])
    np.testing.assert_array_equal(to_bytes(values), [0, 0, 0, 1, 128, 255, 255])


@pytest.mark.parametrize("name", ["picture", "picture.jpg", "picture.png.txt"])
def test_an_unknown_suffix_is_refused(tmp_path, picture, name):
    with pytest.raises(m3d_render.PictureError, match="must name the picture's format"):
        m3d_render.write_picture(tmp_path / name, picture)


def test_a_failed_write_leaves_the_old_file(tmp_path, picture, monkeypatch):
    path = tmp_path / "old.png"
    path.write_text("old")
    wide = np.zeros((2, 2, 3, 2))
    with pytest.raises(ValueError, match="unpack"):
        m3d_render.write_picture(path, wide)
    monkeypatch.setattr(Path, "replace", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(m3d_render.PictureError, match="No space left"):
        m3d_render.write_picture(path, picture)
    assert path.read_text() == "old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["old.png"]


def test_a_folder_that_does_not_exist(tmp_path, picture):
    with pytest.raises(m3d_render.PictureError, match="No such file"):
        m3d_render.write_picture(tmp_path / "none" / "a.exr", picture)


def test_a_rendering_shows_itself_in_a_notebook(tmp_path):
    scene = m3dc.compile("SCENE { SKY { } VIEW { WIDTH 16 HEIGHT 10 } } SOLID { SPHERE { } }").ir
    rendering = m3d_render.prepare(scene).render()
    (tmp_path / "a.png").write_bytes(rendering._repr_png_())
    pixels = OpenImageIO.ImageBuf(str(tmp_path / "a.png")).get_pixels(OpenImageIO.UINT8)
    np.testing.assert_array_equal(pixels, to_bytes(rendering.picture))
    assert replace(rendering, picture=rendering.picture[:0])._repr_png_() is None, "there is nothing to see"
