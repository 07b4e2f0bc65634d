"""What `make release` asks before it builds, and that what it packs depends on nothing but what is packed."""

from __future__ import annotations

import hashlib
import io
import os
import tarfile
from pathlib import Path

import pytest

from tools.release import checks
from tools.release.__main__ import sums
from tools.release.build import pack_anew
from tools.release.proof import COMPILER
from tools.version import version

CHANGELOG = """# Changelog

## Unreleased

## 0.3.0 - 2026-12-24

### Added
- Snow.

## 0.2.0 - 2026-12-01

## 0.1.0

- Nothing.
"""


def test_this_version_is_right_wherever_it_stands() -> None:
    assert checks.of_version(version()) == []


@pytest.mark.parametrize("wanted", ["", "next", "v0.1.0", "1", "0.1.0 "])
def test_what_is_no_version(wanted: str) -> None:
    assert "is no version" in checks.of_version(wanted)[0]


def test_another_version_is_said_where_it_must_be_changed() -> None:
    assert checks.of_version("9.9.9") == [f"pyproject.toml says {version()}: change it there, then run `make generate`"]


@pytest.mark.parametrize(
    ("wanted", "says"),
    [
        ("0.3.0", None),
        ("0.2.0", "says nothing below"),
        ("0.1.0", "no heading"),  # without a date
        ("0.4.0", "no heading"),
        ("0.3", "no heading"),
    ],
)
def test_the_changelog_has_the_version(wanted: str, says: str | None) -> None:
    wrong = checks.of_changelog(CHANGELOG, wanted)
    assert not wrong if says is None else says in wrong[0]


def packed(folder: Path, names: list[str], time: int, owner: int) -> Path:
    """A .tar.gz of small files, in this order, changed at this time."""
    archive = folder / f"{time}.tar.gz"
    with tarfile.open(archive, "w:gz") as tar:
        for name in names:
            member = tarfile.TarInfo(name)
            member.size, member.mtime, member.uid, member.uname = len(name), time, owner, f"user{owner}"
            member.mode = 0o664 if owner else 0o600
            tar.addfile(member, io.BytesIO(name.encode()))
    os.utime(archive, (time, time))
    return archive


def test_an_archive_depends_on_names_and_contents_alone(tmp_path: Path) -> None:
    first = packed(tmp_path, ["a/b.py", "a/c.py"], 1_000_000_000, 0)
    second = packed(tmp_path, ["a/c.py", "a/b.py"], 1_700_000_000, 1000)
    made = [tmp_path / "one.tar.gz", tmp_path / "two.tar.gz"]
    for archive, to in zip((first, second), made, strict=True):
        pack_anew(archive, to, 1_600_000_000)
    assert first.read_bytes() != second.read_bytes()
    assert made[0].read_bytes() == made[1].read_bytes()
    with tarfile.open(made[0]) as tar:
        contents = {member.name: tar.extractfile(member) for member in tar}
        assert {name: file and file.read().decode() for name, file in contents.items()} == {
            "a/b.py": "a/b.py",
            "a/c.py": "a/c.py",
        }


def test_checksums(tmp_path: Path) -> None:
    (tmp_path / "b.whl").write_bytes(b"b")
    (tmp_path / "a.tar.gz").write_bytes(b"a")
    (tmp_path / "SHA256SUMS").write_text("old")
    expected = [
        f"{hashlib.sha256(text.encode()).hexdigest()}  {name}" for text, name in (("a", "a.tar.gz"), ("b", "b.whl"))
    ]
    assert sums(tmp_path).splitlines() == expected


@pytest.mark.parametrize(
    "name", ["cc", "gcc", "gcc-12", "x86_64-linux-gnu-gcc-12", "clang++", "ld", "ld.gold", "as", "c99"]
)
def test_a_compiler_is_known_by_its_name(name: str) -> None:
    assert COMPILER.fullmatch(name)


@pytest.mark.parametrize("name", ["bash", "python3", "sha256sum", "less", "pass", "ldd", "ccze", "basename"])
def test_other_programs_are_none(name: str) -> None:
    assert not COMPILER.fullmatch(name)
