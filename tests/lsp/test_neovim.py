"""The configuration for Neovim, in Neovim: a person opens a scene, is shown a mistake, mends it, asks, renames, lays it
out, and renders it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import m3dc
from m3dc.format import format

HERE = Path(__file__).parent
CONFIGURATION = HERE.parents[1] / "lsp/editors/neovim"

SCENE = """\
VARIABLES { SURFACE red; }
red = { COLOR < 1, 0, 0 > }
SOLID { SPHERE { RADIUS -5 }
SURFACE red }
LIGHT { SOURCE { FROM < 0, 0, 9 > } }
"""


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What came of each thing that neovim.lua does."""
    if shutil.which("nvim") is None:
        if os.environ.get("CI"):
            pytest.fail("nvim is not installed: apt-get install neovim")
        pytest.skip("nvim is not installed")
    folder = tmp_path_factory.mktemp("neovim")
    scene, result = folder / "scene.m3d", folder / "result.json"
    scene.write_text(SCENE, encoding="utf-8")
    command = json.dumps([sys.executable, "-m", "m3d_lsp"])
    ran = subprocess.run(
        [
            "nvim", "--clean", "--headless",
            "--cmd", f"lua vim.g.mirage3d = {{ command = vim.fn.json_decode({command!r}) }}",
            "--cmd", f"set runtimepath^={CONFIGURATION}",
            "-c", f"luafile {HERE / 'neovim.lua'}", "-c", "qall!", str(scene),
        ],
        env={**os.environ, "RESULT": str(result), "HOME": str(folder), "XDG_STATE_HOME": str(folder)},
        capture_output=True, text=True, timeout=180, check=False, cwd=folder,
    )  # fmt: skip
    assert result.exists(), ran.stderr
    return json.loads(result.read_text(encoding="utf-8"))


def test_diagnostics(done: dict[str, Any]) -> None:
    (expected,) = m3dc.compile(SCENE).diagnostics
    (shown,) = done["diagnostics"]
    assert (shown["line"], shown["column"]) == (2, SCENE.splitlines()[2].index("-5"))
    assert shown["message"] == expected.message


def test_hover(done: dict[str, Any]) -> None:
    assert "SPHERE" in done["hover"]


def test_completion(done: dict[str, Any]) -> None:
    assert "RADIUS" in done["completion"]
    assert "SOLID" not in done["completion"]


def test_definition(done: dict[str, Any]) -> None:
    assert done["definition"][0] in (1, 2)


def test_rename(done: dict[str, Any]) -> None:
    assert done["renamed"] == SCENE.replace("red", "crimson").replace("-5", "5").rstrip("\n")


def test_formatting(done: dict[str, Any]) -> None:
    assert done["formatted"] == format((done["renamed"] + "\n").encode()).decode().rstrip("\n")


def test_the_dump_follows_the_text_and_a_picture_is_rendered(done: dict[str, Any]) -> None:
    assert done["dump_follows"]
    assert done["rendered"]
