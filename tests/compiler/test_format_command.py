"""The m3dfmt command, run as a person runs it: files, exit statuses, messages."""

from __future__ import annotations

import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from m3dc.commands import m3dfmt as format_cli

pytestmark = pytest.mark.slow

UNTIDY = "SOLID{SPHERE{RADIUS 2}}\n"
TIDY = "SOLID { SPHERE { RADIUS 2 } }\n"
BROKEN = "x=1\nSOLID { SPHERE { RADIUS }\n"


def m3dfmt(*arguments: object, text: str | None = None, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    program = "import sys; from m3dc.commands.m3dfmt import main; sys.exit(main())"
    command = [sys.executable, "-c", program, *map(str, arguments)]
    return subprocess.run(command, input=text, capture_output=True, cwd=cwd, timeout=120, check=False, text=True)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "untidy.m3d").write_text(UNTIDY)
    (tmp_path / "tidy.m3d").write_text(TIDY)
    (tmp_path / "broken.m3d").write_text(BROKEN)
    return tmp_path


def contents(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.iterdir()}


def test_files_are_rewritten_in_place(folder: Path) -> None:
    (folder / "untidy.m3d").chmod(0o640)
    before = (folder / "tidy.m3d").stat()
    done = m3dfmt("untidy.m3d", "tidy.m3d", cwd=folder)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert contents(folder) == {"untidy.m3d": TIDY, "tidy.m3d": TIDY, "broken.m3d": BROKEN}
    assert stat.S_IMODE((folder / "untidy.m3d").stat().st_mode) == 0o640
    assert (folder / "tidy.m3d").stat().st_ino == before.st_ino


def test_a_link_stays_a_link(folder: Path) -> None:
    (folder / "link.m3d").symlink_to("untidy.m3d")
    assert m3dfmt("link.m3d", cwd=folder).returncode == 0
    assert (folder / "link.m3d").is_symlink()
    assert (folder / "untidy.m3d").read_text() == TIDY


def test_check_lists_what_would_change(folder: Path) -> None:
    before = contents(folder)
    done = m3dfmt("--check", "untidy.m3d", "tidy.m3d", cwd=folder)
    assert (done.returncode, done.stdout, done.stderr) == (1, "untidy.m3d\n", "")
    assert m3dfmt("--check", "tidy.m3d", cwd=folder).returncode == 0
    assert contents(folder) == before


@pytest.mark.skipif(shutil.which("patch") is None, reason="patch is not installed")
def test_diff_is_one_that_patch_takes(folder: Path) -> None:
    lines = [f"x{i} = {i}" for i in range(40)]
    lines[5], lines[9], lines[30], lines[39] = "x5=5", "", "SOLID {\n PLANE { }\n\n }", "x   = 9"
    (folder / "untidy.m3d").write_text("\n".join(lines))
    done = m3dfmt("--diff", "untidy.m3d", "tidy.m3d", cwd=folder)
    assert (done.returncode, done.stderr) == (1, "")
    assert done.stdout.startswith("--- untidy.m3d\n+++ untidy.m3d\n@@ -")
    assert (folder / "untidy.m3d").read_text() == "\n".join(lines)
    subprocess.run(["patch", "-p0", "--fuzz=0"], input=done.stdout, text=True, cwd=folder, check=True)
    assert m3dfmt("--check", "untidy.m3d", cwd=folder).returncode == 0


def test_diff_shows_lines_about_a_change(folder: Path) -> None:
    (folder / "untidy.m3d").write_text("a = 1\n\nb = 1\n\nc = 1\n\nd=1\n\ne = 1")
    done = m3dfmt("--diff", "untidy.m3d", cwd=folder)
    assert done.stdout.splitlines()[2:] == [
        "@@ -4,6 +4,6 @@",
        " ",
        " c = 1",
        " ",
        "-d=1",
        "+d = 1",
        " ",
        "-e = 1",
        "\\ No newline at end of file",
        "+e = 1",
    ]
    done = m3dfmt("--diff", "tidy.m3d", cwd=folder)
    assert (done.returncode, done.stdout) == (0, "")


def test_standard_input_goes_to_standard_output(folder: Path) -> None:
    done = m3dfmt("-", text=UNTIDY)
    assert (done.returncode, done.stdout, done.stderr) == (0, TIDY, "")
    assert m3dfmt("-", text=TIDY).stdout == TIDY
    assert m3dfmt("--check", "-", text=UNTIDY).returncode == 1
    assert m3dfmt("--check", "-", text=TIDY).returncode == 0
    assert m3dfmt("--diff", "-", text=UNTIDY).stdout.endswith(f"-{UNTIDY}+{TIDY}")


@pytest.mark.parametrize("how", [(), ("--check",), ("--diff",)])
def test_a_scene_with_syntax_errors_is_left_alone(how: tuple[str, ...], folder: Path) -> None:
    done = m3dfmt(*how, "broken.m3d", "tidy.m3d", cwd=folder)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("broken.m3d:2: ")
    assert done.stderr.count("\n") == 1
    assert contents(folder)["broken.m3d"] == BROKEN
    done = m3dfmt(*how, "-", text=BROKEN)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("-:2: ")


def test_one_bad_file_does_not_stop_the_others(folder: Path) -> None:
    done = m3dfmt("missing.m3d", "broken.m3d", "untidy.m3d", cwd=folder)
    assert done.returncode == 2
    assert (folder / "untidy.m3d").read_text() == TIDY
    assert done.stderr.splitlines()[0] == "m3dfmt: error: cannot read missing.m3d: No such file or directory"


@pytest.mark.parametrize(
    "arguments", [(), ("--nonsense", "tidy.m3d"), ("--check", "--diff", "tidy.m3d"), (".",), ("\0",)]
)
def test_usage_and_files_are_status_2(arguments: tuple[str, ...], folder: Path) -> None:
    if arguments == ("\0",):
        assert format_cli.main(["\0"]) == 2
        return
    done = m3dfmt(*arguments, cwd=folder)
    assert done.returncode == 2
    assert "m3dfmt: " in done.stderr
    assert "Traceback" not in done.stderr


def test_a_failed_write_leaves_the_old_file(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    path = folder / "untidy.m3d"
    assert format_cli.main([str(path)]) == 2
    says = f"m3dfmt: error: cannot write {path}: No space left on device; nothing was changed\n"
    assert capsys.readouterr().err == says
    assert contents(folder) == {"untidy.m3d": UNTIDY, "tidy.m3d": TIDY, "broken.m3d": BROKEN}


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full")
def test_output_that_can_not_be_written() -> None:
    program = "import sys; from m3dc.commands.m3dfmt import main; sys.exit(main())"
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [sys.executable, "-c", program, "-"],
            input=UNTIDY.encode(),
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr == b"m3dfmt: error: cannot write the output: No space left on device\n"


def test_the_commands_of_the_page_run(tmp_path: Path, examples: Path) -> None:
    page = (examples.parent / "docs/formatting.md").read_text(encoding="utf-8")
    lines = [line for line in page.splitlines() if line.startswith("m3dfmt ")]
    assert len(lines) >= 4
    shutil.copytree(examples, tmp_path / "examples")
    start = "from m3dc_command import m3dfmt; exit(m3dfmt())"
    (tmp_path / "m3dfmt").write_text(f'#!/bin/sh\nexec "{sys.executable}" -c "{start}" "$@"\n')
    (tmp_path / "m3dfmt").chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    for line in lines:
        subprocess.run(line, shell=True, cwd=tmp_path, env=environment, check=True, capture_output=True)
