"""What is installed is whole: every command, its metadata, its types, and the files that it reads."""

from __future__ import annotations

import platform
import runpy
import sys
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from packaging.metadata import Metadata
from packaging.requirements import Requirement

from mirage3d.cli import main
from tools.version import DISTRIBUTIONS, ROOT, version

PARTS = [name for name in DISTRIBUTIONS if name != "mirage3d"]
PACKAGES = {"m3d-language": "m3d_language", "m3d-render": "m3d_render", "m3d-lsp": "m3d_lsp"}
on_distribution = pytest.mark.parametrize("distribution", DISTRIBUTIONS)


def commands(distribution: str) -> dict[str, str]:
    entries = metadata.distribution(distribution).entry_points.select(group="console_scripts")
    return {entry.name: entry.value for entry in entries}


def requirements(distribution: str) -> list[Requirement]:
    return [Requirement(text) for text in metadata.requires(distribution) or []]


def test_the_whole_declares_every_command_of_its_parts() -> None:
    """As they do: where both are installed, each writes the same script."""
    declared = {name: value for part in PARTS for name, value in commands(part).items()}
    assert commands("mirage3d") == {**declared, "mirage3d": "mirage3d.__main__:run"}


@on_distribution
def test_every_command_can_be_called(distribution: str) -> None:
    for entry in metadata.distribution(distribution).entry_points:
        assert callable(entry.load()), entry


def test_the_whole_brings_every_part_and_the_extras_of_its_parts() -> None:
    wanted = requirements("mirage3d")
    assert {each.name for each in wanted if each.marker is None} >= {*PARTS}
    extras = metadata.metadata("mirage3d").get_all("Provides-Extra") or []
    assert sorted(extras) == sorted(metadata.metadata("m3d-render").get_all("Provides-Extra") or [])


@on_distribution
def test_parts_of_one_release_belong_together(distribution: str) -> None:
    """And what others publish may become newer, though not so new that nobody has tried it."""
    for wanted in requirements(distribution):
        operators = {each.operator for each in wanted.specifier}
        if wanted.name in DISTRIBUTIONS:
            assert str(wanted.specifier) == f"=={version()}"
        else:
            assert ">=" in operators, wanted
            assert "==" not in operators, wanted


@on_distribution
def test_metadata_is_valid(distribution: str) -> None:
    text = metadata.distribution(distribution).read_text("METADATA")
    assert text is not None
    described = Metadata.from_email(text, validate=True)
    assert described.license_expression == "MIT"
    assert described.license_files == ["LICENSE"]
    assert described.summary
    assert described.description


@on_distribution
def test_types_are_shipped(distribution: str) -> None:
    package = find_spec(PACKAGES.get(distribution, distribution))
    assert package is not None
    assert package.origin is not None
    assert (Path(package.origin).parent / "py.typed").exists()
    listed = (ROOT / DISTRIBUTIONS[distribution] / "pyproject.toml").read_text(encoding="utf-8")
    assert "py.typed" in listed, "it is in the wheel, too"


def test_mirage3d_says_all_versions(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    said = dict(line.split(" ", 1) for line in capsys.readouterr().out.splitlines())
    assert {name: said.pop(name) for name in DISTRIBUTIONS} == dict.fromkeys(DISTRIBUTIONS, version())
    assert said == {"numpy": np.__version__, "python": platform.python_version(), "platform": platform.platform()}


@pytest.mark.parametrize("folder", ["compiler", "renderer", "lsp", "suite"])
def test_pip_finds_the_other_parts_of_a_checkout(folder: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the metadata that it reads before it builds; a source distribution alone has no other parts."""
    described = """Requires-Dist: m3dc==0.1.0
Requires-Dist: m3d-render[plot]==0.1.0 ; extra == 'plot'
Requires-Dist: m3dc-other==0.1.0
Requires-Dist: numpy>=2.2,<3
"""

    def prepare(to: str, settings: object) -> str:
        (Path(to) / "METADATA").write_text(described)
        return "."

    maturin, setuptools = ModuleType("maturin"), ModuleType("setuptools")
    backend = SimpleNamespace(prepare_metadata_for_build_wheel=prepare)
    vars(maturin).update(vars(backend))
    vars(setuptools).update(build_meta=backend)
    monkeypatch.setitem(sys.modules, "maturin", maturin)
    monkeypatch.setitem(sys.modules, "setuptools", setuptools)
    for place in (ROOT / folder, tmp_path):
        monkeypatch.chdir(place)
        hooks = runpy.run_path(str(ROOT / folder / "build_backend.py"))
        hooks["prepare_metadata_for_build_wheel"](str(tmp_path))
        found = (tmp_path / "METADATA").read_text()
        if place == tmp_path:
            assert found == described
        else:
            first, second, *rest = found.splitlines()
            assert first.strip() == f"Requires-Dist: m3dc @ {(ROOT / 'compiler').as_uri()}"
            renderer = (ROOT / "renderer").as_uri()
            assert second == f"Requires-Dist: m3d-render[plot] @ {renderer}  ; extra == 'plot'"
            assert rest == described.splitlines()[2:]
