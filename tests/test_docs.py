"""The examples of the documentation work: scenes compile, commands run, Python runs, messages are what is printed."""

from __future__ import annotations

import io
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import m3dc
from m3dc.diagnostics.report import print_human
from m3dc.ir import m3ir

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", ROOT / "suite/README.md", *sorted((ROOT / "docs").glob("*.md"))]
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMANDS = {"m3dc", "m3dfmt", "m3d-render", "m3d-rays", "m3d-plot", "mirage3d"}
PYTHON = os.environ.get("MIRAGE3D_PYTHON", sys.executable)
"""What runs the commands and the Python; `make wheels` names that of an environment into which it installed wheels."""
HAS_PYVISTA = "from importlib.util import find_spec; exit(find_spec('pyvista') is None)"
if subprocess.run([PYTHON, "-c", HAS_PYVISTA], check=False).returncode == 0 or os.environ.get("CI") == "true":
    COMMANDS.add("m3d-view")
EXAMPLE_SCRIPT = "python examples/"


def blocks(language: str) -> list[tuple[str, str]]:
    return [
        (f"{page.name}-{number}", text)
        for page in PAGES
        for number, (name, text) in enumerate(FENCE.findall(page.read_text(encoding="utf-8")))
        if name == language
    ]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder like a checkout after `make demo`."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    (tmp_path / "out").mkdir()
    m3ir.write(m3dc.compile((ROOT / "examples/merman.m3d").read_bytes()).ir, tmp_path / "out/merman.m3ir")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def ids(block: tuple[str, str]) -> str:
    return block[0]


@pytest.mark.parametrize("block", blocks("m3d"), ids=ids)
def test_scenes_compile(block: tuple[str, str]) -> None:
    assert m3dc.compile(block[1]).diagnostics == ()


@pytest.mark.parametrize("block", blocks("python"), ids=ids)
def test_python_runs(block: tuple[str, str], folder: Path) -> None:
    done = subprocess.run([PYTHON, "-c", block[1]], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def commands() -> list[str]:
    pages = [block for block in blocks("") if not block[0].startswith("README")]
    lines = [line.split("#")[0].strip() for _, text in pages for line in text.splitlines()]
    return [line for line in lines if line.split(" ")[0] in COMMANDS or line.startswith(EXAMPLE_SCRIPT)]


def run(line: str, folder: Path) -> None:
    path = f"{Path(PYTHON).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", line],
        cwd=folder,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, f"{line}\n{done.stderr}"


def test_commands_run(folder: Path) -> None:
    assert commands()
    for line in commands():
        run(line, folder)


def test_the_readmes_commands_run_in_order_and_write_into_out(folder: Path) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    fences = FENCE.findall(readme)
    (folder / "first.m3d").write_text(next(text for name, text in fences if name == "m3d"))

    def outside() -> set[Path]:
        return {path for path in folder.rglob("*") if path.is_file() and path.parent != folder / "out"}

    before = outside()
    lines = [line.split("#")[0].strip() for name, text in fences if not name for line in text.splitlines()]
    ran: set[str] = set()
    for line in lines:
        if (word := line.split(" ")[0]) in COMMANDS:
            run(line, folder)
            assert outside() == before, line
            ran.add(word)
    assert ran == COMMANDS


def test_the_readmes_error_is_what_is_printed() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (shown,) = (text for _, text in FENCE.findall(readme) if text.startswith("first.m3d:"))
    (scene,) = (text for name, text in FENCE.findall(readme) if name == "m3d")
    result = m3dc.compile(scene.replace("ZENITH", "ZENIT"), "first.m3d")
    printed = io.StringIO()
    print_human(result.diagnostics, result.files, printed)
    assert printed.getvalue().startswith(shown)


def test_links_lead_somewhere() -> None:
    for page in [*PAGES, ROOT / "ARCHITECTURE.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md"]:
        for link in re.findall(r"\]\(([^)#]+)", page.read_text(encoding="utf-8")):
            if not link.startswith("http"):
                assert (page.parent / link).exists(), f"{page.name}: {link}"
