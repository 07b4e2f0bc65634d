"""The configuration for Emacs, in Emacs: a person opens a scene, is shown a mistake, mends it, asks, renames, lays it
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
from laid_out import LAID_OUT

import m3dc
from m3dc.format import format

HERE = Path(__file__).parent
CONFIGURATION = HERE.parents[1] / "lsp/editors/emacs"

SCENE = """\
VARIABLES { SURFACE red; }
red = { COLOR < 1, 0, 0 > }
SOLID { SPHERE { RADIUS -5 }
SURFACE red }
LIGHT { SOURCE { FROM < 0, 0, 9 > } }
"""


def has_eglot() -> bool:
    if shutil.which("emacs") is None:
        return False
    command = ["emacs", "--batch", "--eval", "(progn (package-initialize) (require 'eglot))"]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


@pytest.fixture(scope="module")
def emacs() -> list[str]:
    """The command that starts Emacs with the mode loaded."""
    if not has_eglot():
        if os.environ.get("CI"):
            pytest.fail("Emacs with Eglot is not installed: apt-get install emacs-nox elpa-eglot")
        pytest.skip("Emacs with Eglot is not installed")
    package = ["emacs", "--batch", "--eval", "(package-initialize)"]
    return [*package, "--directory", str(CONFIGURATION), "--load", "mirage3d"]


@pytest.fixture(scope="module")
def done(emacs: list[str], tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What came of each thing that emacs.el does."""
    folder = tmp_path_factory.mktemp("emacs")
    scene, result = folder / "scene.m3d", folder / "result.json"
    scene.write_text(SCENE, encoding="utf-8")
    server = json.dumps([sys.executable, "-m", "m3d_lsp"])
    ran = subprocess.run(
        [*emacs, "--load", str(HERE / "emacs.el")],
        env={**os.environ, "RESULT": str(result), "SCENE": str(scene), "SERVER": server, "HOME": str(folder)},
        capture_output=True, text=True, timeout=180, check=False, cwd=folder,
    )  # fmt: skip
    assert result.exists(), ran.stderr
    return json.loads(result.read_text(encoding="utf-8"))


def test_diagnostics(done: dict[str, Any]) -> None:
    (expected,) = m3dc.compile(SCENE).diagnostics
    assert done["mode"] == "mirage3d-mode"
    (shown,) = done["diagnostics"]
    assert shown["line"] == 3
    assert expected.message in shown["text"]


def test_hover(done: dict[str, Any]) -> None:
    assert "SPHERE" in done["hover"]


def test_completion(done: dict[str, Any]) -> None:
    assert done["completion"] == ["RADIUS"]


def test_definition(done: dict[str, Any]) -> None:
    assert set(done["definition"]) <= {1, 2}
    assert done["definition"]


def test_rename(done: dict[str, Any]) -> None:
    assert done["renamed"] == SCENE.replace("red", "crimson").replace("-5", "5")


def test_formatting(done: dict[str, Any]) -> None:
    assert done["formatted"] == format(done["renamed"].encode()).decode()


def test_the_dump_follows_the_text_and_a_picture_is_rendered(done: dict[str, Any]) -> None:
    assert done["dump_follows"]
    assert done["rendered"]


# Indents a scene whose lines all begin at the margin, but for those in comments, and again what came of that.
INDENT = """
(with-temp-buffer
  (insert-file-contents (getenv "SCENE"))
  (cl-letf (((symbol-function 'eglot-ensure) #'ignore)) (mirage3d-mode))
  (dotimes (_ 2)
    (let ((inhibit-message t)) (indent-region (point-min) (point-max)))
    (princ (buffer-string))))
"""
TYPE = """
(with-temp-buffer
  (cl-letf (((symbol-function 'eglot-ensure) #'ignore)) (mirage3d-mode))
  (electric-indent-mode 1)
  (dolist (line '("SOLID" "{" "SPHERE { }" "}"))
    (mapc (lambda (each) (setq last-command-event each) (self-insert-command 1)) line)
    (setq last-command-event ?\\n)
    (newline nil t))
  (princ (buffer-string)))
"""


def evaluated(emacs: list[str], folder: Path, text: str, expression: str) -> str:
    scene = folder / "scene.m3d"
    scene.write_text(text, encoding="utf-8")
    ran = subprocess.run(
        [*emacs, "--eval", expression],
        env={**os.environ, "SCENE": str(scene), "HOME": str(folder)},
        capture_output=True, text=True, timeout=60, check=True, cwd=folder,
    )  # fmt: skip
    return ran.stdout


def test_indentation(emacs: list[str], tmp_path: Path) -> None:
    lines = LAID_OUT.splitlines(keepends=True)
    flat = "".join([*lines[:2], *(line.lstrip(" ") for line in lines[2:])])
    assert evaluated(emacs, tmp_path, flat, INDENT) == 2 * LAID_OUT


def test_typing_is_indented(emacs: list[str], tmp_path: Path) -> None:
    assert evaluated(emacs, tmp_path, "", TYPE) == "SOLID\n{\n    SPHERE { }\n}\n"
