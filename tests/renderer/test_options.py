"""Every render option is known wherever options are: on the command line, in Python, in the kernel, in the docs."""

from __future__ import annotations

from pathlib import Path
from typing import cast, get_type_hints

import numpy as np
import pytest
from pictures import stored
from scene_builder import merman

import m3d_render
from m3d_render import RenderOptions, cli
from m3d_render.options import OPTIONS, Real, Switch, Whole
from m3d_render.picture import to_bytes
from m3dc.ir import Globals, m3ir
from tools import render_options

CALLBACKS = {"progress", "cancel", "tiles"}
EXAMPLES: dict[str, tuple[str, object]] = {
    "width": ("30", 30),
    "height": ("20", 20),
    "region": ("2,3,20,30", (2, 3, 20, 30)),
    "rows": ("4:9", (4, 9)),
    "straight": ("", True),
    "shadows": ("", True),
    "depth": ("1", 1),
    "normalize": ("", True),
    "log_scale": ("2.5", 2.5),
    "samples": ("4", 4),
    "refract_reflections": ("", True),
    "threads": ("1", 1),
}
"""A value of each option, as the command line and Python have it, that changes the picture below."""


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("options") / "merman.m3ir"
    m3ir.write(merman(61, 43).build(), path)
    return path


def test_each_has_an_example() -> None:
    assert EXAMPLES.keys() == OPTIONS.keys() == get_type_hints(RenderOptions).keys() - CALLBACKS


@pytest.mark.parametrize("name", OPTIONS)
def test_the_command_line_and_python_ask_for_the_same(name: str, scene: Path, tmp_path: Path) -> None:
    words, value = EXAMPLES[name]
    flag = f"--{name.replace('_', '-')}"
    picture = tmp_path / "a.png"
    assert cli.main([str(scene), "-o", str(picture), flag, *words.split()]) == 0
    ir = m3ir.read(scene)
    expected = m3d_render.render(ir, **cast("RenderOptions", {name: value}))
    np.testing.assert_array_equal(stored(picture), to_bytes(expected))
    assert name == "threads" or not np.array_equal(expected, m3d_render.render(ir))


@pytest.mark.parametrize("name", [name for name, option in OPTIONS.items() if isinstance(option.kind, Whole)])
def test_what_is_out_of_range_is_refused(name: str, scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kind = OPTIONS[name].kind
    assert isinstance(kind, Whole)
    for value in (kind.least - 1, kind.most + 1):
        with pytest.raises(
            m3d_render.SceneError, match=f"{name} must be from {kind.least} to {kind.most}, not {value}"
        ):
            m3d_render.render(m3ir.read(scene), **cast("RenderOptions", {name: value}))
        assert cli.main([str(scene), "-o", "-", f"--{name}={value}"]) == 2
        assert f"{value} is not from {kind.least} to {kind.most}" in capsys.readouterr().err


def test_what_the_scene_decides_is_a_field_of_the_ir() -> None:
    said = {name for name, option in OPTIONS.items() if option.kernel and option.default is None}
    assert said == {"shadows", "depth", "log_scale", "refract_reflections"} & Globals.__annotations__.keys()
    for name, option in OPTIONS.items():
        assert not option.kernel or isinstance(option.kind, (Whole, Real, Switch)), name


@pytest.mark.parametrize("path", render_options.texts(), ids=lambda path: "/".join(path.parts[-4:]))
def test_what_is_made_of_the_list_is_current(path: Path) -> None:
    assert path.read_text(encoding="utf-8") == render_options.texts()[path], "run `make generate` and commit the result"
