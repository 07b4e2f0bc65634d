"""The kernel as WebAssembly gives the same pictures as the native one, to the last bit. `make wasm` builds it."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import m3d_render
import m3dc
from m3dc.ir import m3ir

ROOT = Path(__file__).parents[2]
MODULE = ROOT / "out/wasm/m3d_web.wasm"
WIDTH, HEIGHT = 60, 40

if os.environ.get("CI") != "true":
    if not MODULE.exists():
        pytest.skip("the kernel is not built for WebAssembly: make wasm", allow_module_level=True)
    if shutil.which("node") is None:
        pytest.skip("there is no node", allow_module_level=True)

SCENES = sorted((ROOT / "examples").glob("*.m3d"))


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the pictures of all examples, straight and as the air bends them."""
    folder = tmp_path_factory.mktemp("wasm")
    asked: list[str] = []
    for scene in SCENES:
        m3ir.write(m3dc.compile(scene.read_bytes()).ir, folder / f"{scene.stem}.m3ir")
        asked += [f"{scene.stem} {WIDTH} {HEIGHT} {straight}" for straight in (0, 1)]
    command = ["node", str(Path(__file__).with_name("wasm.mjs")), str(MODULE), str(folder)]
    subprocess.run(command, input="\n".join(asked), text=True, check=True)
    return folder


@pytest.mark.parametrize("straight", [False, True], ids=["bent", "straight"])
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.stem)
def test_the_picture_is_the_native_one(scene: Path, straight: bool, pictures: Path) -> None:
    there = np.fromfile(pictures / f"{scene.stem}-{int(straight)}.f32", np.float32).reshape(HEIGHT, WIDTH, 3)
    ir = m3dc.compile(scene.read_bytes()).ir
    native = m3d_render.render(ir, width=WIDTH, height=HEIGHT, straight=straight)
    np.testing.assert_array_equal(there, native)


def test_the_module_needs_nothing() -> None:
    """It has no imports, and is small enough for a page."""
    script = "const m = new WebAssembly.Module(require('fs').readFileSync(process.argv[1]));"
    script += "console.log(WebAssembly.Module.imports(m).length)"
    done = subprocess.run(["node", "-e", script, str(MODULE)], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "0"
    assert MODULE.stat().st_size < 1_500_000
