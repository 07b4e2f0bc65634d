"""The .m3ir file: what is written is read again, NumPy alone can open it, and nothing else is accepted."""

from __future__ import annotations

import json
import tracemalloc
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest
from numpy.typing import NDArray

import m3dc
from m3dc.ir import TABLES, SceneIR, m3ir

Arrays: TypeAlias = dict[str, NDArray[Any]]
Change: TypeAlias = Callable[[Any, Arrays], object]
"""Damages the header or the arrays of a file."""


@pytest.fixture
def scene(examples: Path) -> SceneIR:
    return m3dc.compile((examples / "merman.m3d").read_bytes(), "merman.m3d").ir


def assert_same(left: SceneIR, right: SceneIR) -> None:
    assert left.scene == right.scene
    assert type(left.scene.view) is type(right.scene.view)
    assert left.source == right.source
    for table, columns in TABLES.items():
        for column, description in columns.items():
            values = right[table][column]
            assert values.dtype == np.dtype(description.dtype)
            assert values.shape[1:] == description.shape
            np.testing.assert_array_equal(left[table][column], values)


@pytest.mark.parametrize("name", ["merman", "runway", "wheel", "two-balls", "cylinder-and-cone", "terrain"])
def test_written_and_read(name: str, examples: Path, tmp_path: Path) -> None:
    ir = m3dc.compile((examples / f"{name}.m3d").read_bytes(), name).ir
    m3ir.write(ir, tmp_path / "a.m3ir")
    assert_same(ir, m3ir.read(tmp_path / "a.m3ir"))


def test_numpy_alone_opens_it(scene: SceneIR, tmp_path: Path) -> None:
    m3ir.write(scene, tmp_path / "a.m3ir")
    with np.load(tmp_path / "a.m3ir", allow_pickle=False) as archive:
        header = json.loads(archive["header"].tobytes())
        assert header["format"] == "m3ir"
        assert header["scene"]["view"]["fov"] == 1.5
        assert archive["spheres.radius"].tolist() == [2, 2, 3, 2]


def refusal(path: Path) -> str:
    with pytest.raises(m3ir.FormatError) as caught:
        m3ir.read(path)
    return str(caught.value)


def test_other_files_are_refused(scene: SceneIR, tmp_path: Path) -> None:
    path = tmp_path / "a.m3ir"
    for content in (b"", b"SCENE { }", b"PK\x03\x04", bytes(range(256)) * 40):
        path.write_bytes(content)
        assert "not an .m3ir file" in refusal(path)
    np.savez(path.with_suffix(".npz"), x=np.zeros(3))
    assert "not an .m3ir file" in refusal(path.with_suffix(".npz"))


def test_a_damaged_file_is_refused(scene: SceneIR, tmp_path: Path) -> None:
    path = tmp_path / "a.m3ir"
    m3ir.write(scene, path)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    refusal(path)
    middle = len(whole) // 2
    path.write_bytes(whole[:middle] + b"\xff" * 400 + whole[middle + 400 :])
    refusal(path)


def changed(scene: SceneIR, path: Path, change: Change) -> None:
    m3ir.write(scene, path)
    with np.load(path) as archive:
        arrays = dict(archive)
    header = json.loads(arrays["header"].tobytes())
    change(header, arrays)
    arrays["header"] = np.frombuffer(json.dumps(header).encode(), np.uint8)
    with path.open("wb") as file:
        np.savez(file, **arrays)


def test_another_version_is_refused_by_its_number(scene: SceneIR, tmp_path: Path) -> None:
    path = tmp_path / "a.m3ir"
    changed(scene, path, lambda header, _: header.update(version=99))
    assert "99" in refusal(path)
    assert "compile the scene again" in refusal(path)


def test_missing_and_misshapen_columns_are_named(scene: SceneIR, tmp_path: Path) -> None:
    path = tmp_path / "a.m3ir"
    changed(scene, path, lambda _, arrays: arrays.pop("spheres.radius"))
    assert "spheres.radius is missing" in refusal(path)
    changed(scene, path, lambda _, arrays: arrays.update({"spheres.radius": np.zeros((4, 2))}))
    assert "spheres.radius has the wrong type or shape" in refusal(path)
    changed(scene, path, lambda _, arrays: arrays.update({"spheres.radius": np.zeros(3)}))
    assert "columns of spheres differ" in refusal(path)


def put(*keys: str, value: object) -> Change:
    """A change of the header: the member that the keys lead to."""

    def change(header: Any, _arrays: Arrays) -> None:
        for key in keys[:-1]:
            header = header[key]
        header[keys[-1]] = value

    return change


def without(key: str, of: tuple[str, ...] = ()) -> Change:
    """A change of the header: a member of what the keys `of` lead to is taken out."""

    def change(header: Any, _arrays: Arrays) -> None:
        for name in of:
            header = header[name]
        header.pop(key)

    return change


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (put("version", value="2"), "version is not a whole number"),
        (put("version", value=10**400), "its format version is 1000"),
        (put("scene", "view", "bott\x00m", value=3), "there is no scene.view.bott?m"),
        (put("source", value=3), "source is not a text"),
        (put("scene", value=[]), "scene is not an object"),
        (put("scene", "log_scale", value=float("inf")), "scene.log_scale is not a finite number"),
        (put("scene", "log_scale", value=10**400), "scene.log_scale is not a finite number"),
        (put("scene", "view", "fov", value=float("nan")), "scene.view.fov is not a finite number"),
        (put("scene", "view", "width", value=3.5), "scene.view.width is not a whole number"),
        (put("scene", "view", "width", value=True), "scene.view.width is not a whole number"),
        (put("scene", "view", "width", value=10**9), "scene.view.width is 1e+09, expected at most 65535"),
        (put("scene", "view", "eye", value=[1, 2]), "scene.view.eye is not 3 numbers"),
        (put("scene", "shadows", value=1), "scene.shadows is not true or false"),
        (put("scene", "sky", "sun", value=7), "scene.sky.sun names a row of lights that is not there"),
        (put("scene", "view", "bottom", value=64000), "no pixel between"),
        (put("scene", "sky", "moon", value=1), "there is no scene.sky.moon"),
        (without("up", of=("scene", "view")), "scene.view.up is missing"),
        (without("scene"), "scene is not an object"),
    ],
)
def test_a_header_is_looked_at(scene: SceneIR, tmp_path: Path, change: Change, says: str) -> None:
    path = tmp_path / "a.m3ir"
    changed(scene, path, change)
    assert says in refusal(path)


@pytest.mark.parametrize(
    ("column", "value", "says"),
    [
        ("spheres.radius", np.inf, "spheres.radius is not finite"),
        ("spheres.radius", -1, "spheres.radius is -1, expected 0 or more"),
        ("spheres.center", 1e31, "expected at most 1e+30"),
        ("surfaces.color", 2, "expected at most 1"),
        ("primitives.kind", 99, "expected at most 5"),
        ("primitives.row", 99, "names rows of spheres that are not there"),
        ("primitives.solid", 99, "names rows of solids that are not there"),
        ("primitives.solid", -1, "belongs to no solid or light"),
        ("primitives.light", -2, "primitives.light is -2"),
        ("solids.primitive_count", 2**31 - 1, "names rows of primitives that are not there"),
        ("profile.elevation", 9.0, "profile.elevation does not increase"),
    ],
)
def test_columns_are_looked_at(scene: SceneIR, tmp_path: Path, column: str, value: float, says: str) -> None:
    def change(_header: Any, arrays: Arrays) -> None:
        values = arrays[column].copy()
        values[:2] = value
        arrays[column] = values

    path = tmp_path / "a.m3ir"
    changed(scene, path, change)
    assert says in refusal(path)


def test_a_byte_that_is_neither_true_nor_false(scene: SceneIR, tmp_path: Path) -> None:
    path = tmp_path / "a.m3ir"
    odd = np.full(len(scene["lights"]["sun"]), 7, np.uint8).view(np.bool_)
    changed(scene, path, lambda _, arrays: arrays.update({"lights.sun": odd}))
    assert "lights.sun holds what is neither true nor false" in refusal(path)


def test_a_small_file_takes_little_memory(scene: SceneIR, tmp_path: Path) -> None:
    path = tmp_path / "a.m3ir"
    m3ir.write(scene, path)
    with np.load(path) as archive:
        arrays = dict(archive)
    arrays["vertices.position"] = np.zeros((10_000_000, 3))
    with path.open("wb") as file:
        np.savez_compressed(file, **arrays)
    tracemalloc.start()
    assert "it is compressed" in refusal(path)
    # An array that says it is a terabyte.
    m3ir.write(scene, path)
    data, rows = path.read_bytes(), len(scene["primitives"]["row"])
    longer = data.replace(b"'shape': (%d, 4, 4)" % rows, b"'shape': (%d, 4, 4)" % 10**9)
    assert longer != data
    with zipfile.ZipFile(path) as whole, zipfile.ZipFile(tmp_path / "b.m3ir", "w") as archive:
        for name in whole.namelist():
            text = whole.read(name).replace(b"(%d, 4, 4), }         " % rows, b"(%d, 4, 4), }" % 10**9)
            archive.writestr(name, text)
    assert "is not as long as it says" in refusal(tmp_path / "b.m3ir")
    assert tracemalloc.get_traced_memory()[1] < 10 * len(data) + 1_000_000
    tracemalloc.stop()


def test_what_is_read_may_be_written_to(scene: SceneIR, tmp_path: Path) -> None:
    m3ir.write(scene, tmp_path / "a.m3ir")
    m3ir.read(tmp_path / "a.m3ir")["spheres"]["radius"][0] = 3


def test_a_failed_write_leaves_the_old_file(scene: SceneIR, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.m3ir"
    path.write_bytes(b"old")

    def fails(*_args: object, **_kwargs: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez", fails)
    with pytest.raises(OSError, match="No space"):
        m3ir.write(scene, path)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]
