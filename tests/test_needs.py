"""What a build needs is asked for before it starts."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tools.version import version

ROOT = Path(__file__).parent.parent
TOOLS = ("sh", "make", "sed", "dirname", "test", "echo", "uname", "ls")
SAYS = {
    "python3": "python3, 3.11 or newer, is missing",
    "cc": "A C compiler is missing",
    "cargo": "cargo 1.90 or newer is missing",
}


def without(missing: set[str], folder: Path, cargo: str = "cargo 1.95.0 (2026)") -> dict[str, str]:
    """An environment with everything that is needed but some programs."""
    for name in TOOLS:
        found = shutil.which(name)
        if found is not None:
            (folder / name).symlink_to(found)
    programs = {"python3": 'exec "$REAL" "$@"', "cc": "exit 0", "cargo": f"echo '{cargo}'"}
    for name, does in programs.items():
        if name not in missing:
            (folder / name).write_text(f"#!/bin/sh\n{does}\n")
            (folder / name).chmod(0o755)
    return {"PATH": str(folder), "REAL": os.path.realpath(sys.executable), "HOME": os.environ.get("HOME", "")}


def needs(environment: dict[str, str], *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(words, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=60, check=False)


@pytest.mark.parametrize("missing", [{"python3"}, {"cc"}, {"cargo"}, {"python3", "cc", "cargo"}])
def test_what_is_missing_is_said_with_what_brings_it(missing: set[str], tmp_path: Path) -> None:
    done = needs(without(missing, tmp_path), "sh", "tools/needs.sh")
    assert done.returncode == 1
    for name, says in SAYS.items():
        assert (says in done.stderr) == (name in missing)
    for system in ("Debian, Ubuntu:", "Fedora:", "macOS:", "Windows:"):
        assert done.stderr.count(system) == len(missing)


def test_an_old_cargo_is_not_enough(tmp_path: Path) -> None:
    done = needs(without(set(), tmp_path, "cargo 1.63.0 (fd9c4297c 2022-07-01)"), "sh", "tools/needs.sh")
    assert done.returncode == 1
    assert "cargo 1.90 or newer is missing (this is 1.63)" in done.stderr


def test_nothing_is_said_where_all_is_there(tmp_path: Path) -> None:
    done = needs(without(set(), tmp_path), "sh", "tools/needs.sh")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_the_demo_asks_first(tmp_path: Path) -> None:
    done = needs(without({"cargo"}, tmp_path), "make", "demo")
    assert done.returncode == 2
    assert "cargo 1.90 or newer is missing" in done.stderr
    assert done.stdout == "", "nothing else was begun"


def test_wheels_need_only_python(tmp_path: Path) -> None:
    done = needs(without({"cc", "cargo"}, tmp_path), "sh", "tools/needs.sh", "python")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_the_demo_does_without_wheels_for_other_machines(tmp_path: Path) -> None:
    """A wheel for another machine is said to be one, and then the demo asks for what a build needs."""
    checkout, programs = tmp_path / "checkout", tmp_path / "bin"
    programs.mkdir()
    for name in ("Makefile", "pyproject.toml", "renderer/Cargo.toml", "tools/demo.sh", "tools/needs.sh"):
        (checkout / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, checkout / name)
    (checkout / "dist").mkdir()
    (checkout / f"dist/m3d_render-{version()}-cp311-abi3-macosx_4_2_arm64.whl").touch()
    done = subprocess.run(
        ["make", "demo"], cwd=checkout, env=without({"cargo"}, programs), capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert "They are not for this machine" in done.stdout
    assert "cargo 1.90 or newer is missing" in done.stderr
