"""The .m3ir file: what is written is read again, NumPy alone can open it, and nothing else is accepted."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import m3dc
from m3dc import m3ir
from m3dc.ir import TABLES, SceneIR


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


def changed(scene: SceneIR, path: Path, change) -> None:
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
