"""The version stands in one place, the root pyproject.toml; `make generate` writes it wherever else it must stand."""

from __future__ import annotations

import subprocess
from importlib import metadata
from pathlib import Path

import pytest

from tools import version


def test_every_file_states_it() -> None:
    stale = [path for path, text in version.texts().items() if path.read_text(encoding="utf-8") != text]
    assert not stale, "run `make generate` and commit the result"


def test_no_file_of_a_part_is_forgotten() -> None:
    """Every tracked manifest either states the project's version or has none of its own."""
    listed = subprocess.run(["git", "ls-files"], cwd=version.ROOT, capture_output=True, text=True, check=False).stdout
    manifests = {"pyproject.toml", "Cargo.toml", "package.json", "tree-sitter.json", "extension.toml"}
    for name in listed.splitlines():
        if Path(name).name in manifests and name != "pyproject.toml" and name not in version.FILES:
            text = (version.ROOT / name).read_text(encoding="utf-8")
            assert not version.TOML.search(text), name
            assert not version.JSON.search(text), name


@pytest.mark.parametrize("distribution", version.DISTRIBUTIONS)
def test_what_is_installed_has_it(distribution: str) -> None:
    assert metadata.version(distribution) == version.version()
