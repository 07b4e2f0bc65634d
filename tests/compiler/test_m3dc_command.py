"""The m3dc command, run as a person runs it: files, exit statuses, messages; and texts that are no scenes."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from m3dc.ir import m3ir

pytestmark = pytest.mark.slow

GOOD = "SCENE { SKY { } } SOLID { SPHERE { RADIUS 2 } }\n"
BAD = "SOLID { SPHERE { RADIUS -2 } }\n"


def m3dc(*arguments: object, text: bytes | None = None, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    command = [
        sys.executable,
        "-c",
        "import sys; from m3dc.commands.m3dc import main; sys.exit(main())",
        *map(str, arguments),
    ]
    done = subprocess.run(command, input=text, capture_output=True, cwd=cwd, timeout=120, check=False)
    return subprocess.CompletedProcess(command, done.returncode, done.stdout.decode(), done.stderr.decode())


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.m3d"
    path.write_text(GOOD)
    return path


def test_the_ir_goes_beside_the_scene(scene: Path) -> None:
    done = m3dc(scene)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert m3ir.read(scene.with_suffix(".m3ir"))["spheres"]["radius"].tolist() == [2]


def test_output_check_and_dump(scene: Path, tmp_path: Path) -> None:
    assert m3dc("-o", tmp_path / "other.m3ir", scene).returncode == 0
    assert m3ir.read(tmp_path / "other.m3ir").source == str(scene)
    (tmp_path / "other.m3ir").unlink()
    assert m3dc("--check", scene).returncode == 0
    assert "Radius ................... : 2.000000" in m3dc("--dump", scene).stdout
    assert m3dc(f"--dump={tmp_path / 'dump.txt'}", scene).stdout == ""
    assert "Scene Definition" in (tmp_path / "dump.txt").read_text()
    assert {path.name for path in tmp_path.iterdir()} == {"scene.m3d", "dump.txt"}


def test_standard_input(tmp_path: Path) -> None:
    assert "Scene Definition" in m3dc("--dump", "-", text=GOOD.encode()).stdout
    assert m3dc("-", text=GOOD.encode(), cwd=tmp_path).returncode == 2


def test_errors_are_shown_with_their_place(scene: Path) -> None:
    scene.write_text(BAD)
    done = m3dc(scene)
    assert done.returncode == 1
    assert done.stdout == ""
    lines = done.stderr.splitlines()
    assert lines[0] == f"{scene}:1:25: error[M3D0401]: Sphere radius must be > 0"
    assert lines[1:3] == ["    1 | SOLID { SPHERE { RADIUS -2 } }", "      |                         ^^"]
    assert not scene.with_suffix(".m3ir").exists()


def test_an_erroneous_scene_leaves_the_old_ir(scene: Path) -> None:
    m3dc(scene)
    before = scene.with_suffix(".m3ir").read_bytes()
    scene.write_text(BAD)
    assert m3dc(scene).returncode == 1
    assert scene.with_suffix(".m3ir").read_bytes() == before


def test_json_messages_count_characters_and_bytes(scene: Path) -> None:
    scene.write_text("/* é */ SOLID { SPHERE { RADIUS -2 } }\n", encoding="utf-8")
    done = m3dc("--message-format", "json", scene)
    assert done.returncode == 1
    assert json.loads(done.stdout) == {
        "file": str(scene),
        "code": "M3D0401",
        "severity": "error",
        "message": "Sphere radius must be > 0: RADIUS is -2, expected more than 0 and at most 1e+20",
        "line": 1,
        "column": 33,
        "end_line": 1,
        "end_column": 35,
        "start_byte": 33,
        "end_byte": 35,
    }


def test_warnings_do_not_fail(scene: Path) -> None:
    scene.write_text("SOLID { SPHERE { } SURFACE { COLOR < 2, 0, 0 > } }")
    done = m3dc(scene)
    assert done.returncode == 0
    assert "warning[M3D0422]" in done.stderr
    assert scene.with_suffix(".m3ir").exists()


def test_codes_choose_what_is_shown(scene: Path) -> None:
    scene.write_text(
        "SCENE { SKY { } }\n"
        "SOLID { SPHERE { RADIUS 2 RADIUS 3 } SURFACE { TEXTURE { WOOD { } } } TRANSFORM { TRANSX 1 } }"
    )

    def codes(*options: str) -> tuple[int, list[str]]:
        done = m3dc("--check", "--message-format", "json", *options, scene)
        return done.returncode, [json.loads(line)["code"] for line in done.stdout.splitlines()]

    assert codes() == (0, ["M3D0512"])
    assert codes("-W", "M3D0507") == (0, ["M3D0512", "M3D0507"])
    assert codes("-W", "all", "--allow", "M3D0512") == (0, ["M3D0507"])
    assert codes("--deny", "all") == (1, ["M3D0512"])
    assert codes("--deny", "M3D0512,M3D0507") == (1, ["M3D0512", "M3D0507"])
    assert codes("--allow", "all") == (0, [])
    assert m3dc("--deny", "M3D9999", scene).returncode == 2


def test_a_denied_warning_writes_nothing(scene: Path) -> None:
    scene.write_text("SOLID { SPHERE { } }")
    assert m3dc("--deny", "M3D0513", scene).returncode == 1
    assert not scene.with_suffix(".m3ir").exists()


def test_explain(tmp_path: Path) -> None:
    done = m3dc("--explain", "m3d0105")
    assert done.returncode == 0
    assert done.stdout.startswith("error[M3D0105]: Unbalanced Comment\n")
    assert m3dc("--explain", "M3D9999").returncode == 2


def test_most_errors(scene: Path) -> None:
    scene.write_text(BAD * 7)
    done = m3dc("--max-errors", 3, scene)
    assert done.stderr.count("error[M3D0401]") == 3
    assert "... and 4 more" in done.stderr
    assert "7 errors" in done.stderr


def test_echo_lists_the_scene_with_its_diagnostics(scene: Path) -> None:
    scene.write_text(f"/* one */\n{BAD}")
    lines = m3dc("--check", "--echo", scene).stdout.splitlines()
    assert lines[:2] == ["    1   /* one */", "    2   SOLID { SPHERE { RADIUS -2 } }"]
    assert lines[2].index("^") == lines[1].index("-2")


def test_colours_on_a_terminal_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    import io

    import m3dc as compiler
    from m3dc.diagnostics.report import print_human

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    text = "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { } } COLOR <2,0,0> ROUGH x } TRANSFORM { TRANSX 1 } }"
    hinted = compiler.compile("SCENE { SKY { } }" + text.replace("ROUGH x", ""))
    assert {d.severity for d in hinted.diagnostics} == {"warning", "hint"}
    for result in (compiler.compile(text), hinted):
        terminal, file = Terminal(), io.StringIO()
        monkeypatch.delenv("NO_COLOR", raising=False)
        monkeypatch.setenv("TERM", "xterm")
        print_human(result.diagnostics, result.files, terminal)
        print_human(result.diagnostics, result.files, file)
        assert re.sub(r"\x1b\[[0-9;]*m", "", terminal.getvalue()) == file.getvalue() != terminal.getvalue()
        monkeypatch.setenv("NO_COLOR", "1")
        quiet = Terminal()
        print_human(result.diagnostics, result.files, quiet)
        assert quiet.getvalue() == file.getvalue()


def test_sarif(scene: Path) -> None:
    scene.write_text("SCENE { }\nSCENE { }")
    done = m3dc("--message-format", "sarif", scene)
    (run,) = json.loads(done.stdout)["runs"]
    (result,) = run["results"]
    assert (result["ruleId"], result["level"]) == ("M3D0301", "error")
    assert result["locations"][0]["physicalLocation"]["region"]["startLine"] == 2
    assert result["relatedLocations"][0]["physicalLocation"]["region"]["startLine"] == 1
    assert run["tool"]["driver"]["rules"][0]["id"] == "M3D0301"


def test_several_scenes_and_folders_are_checked(tmp_path: Path) -> None:
    for name, text in {
        "good.m3d": GOOD,
        "bad.m3d": BAD,
        "deep/er/warned.m3d": "SOLID { SPHERE { } SURFACE { COLOR < 2, 0, 0 > } }",
        "deep/UPPER.M3D": GOOD,
        "deep/no-scene.txt": BAD,
        ".hidden/bad.m3d": BAD,
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)

    def check(*names: str) -> tuple[int, str]:
        done = m3dc("--check", *names, cwd=tmp_path)
        return done.returncode, done.stderr.splitlines()[-1] if done.stderr else ""

    assert check("good.m3d") == (0, "")
    assert check("good.m3d", "deep/UPPER.M3D") == (0, "2 scenes: 2 fine")
    assert check("deep") == (0, "2 scenes: 1 with warnings, 1 fine")
    assert check(".") == (1, "4 scenes: 1 with errors, 1 with warnings, 2 fine")
    assert check("good.m3d", "./good.m3d", "bad.m3d", "none.m3d") == (2, "4 scenes: 1 with errors, 2 fine, 1 not read")
    done = m3dc("--check", "--message-format", "sarif", ".", cwd=tmp_path)
    (run,) = json.loads(done.stdout)["runs"]
    places = [result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] for result in run["results"]]
    assert places == ["bad.m3d", *["deep/er/warned.m3d"] * places.count("deep/er/warned.m3d")]
    assert {path.suffix for path in tmp_path.rglob("*") if path.is_file()} == {".m3d", ".M3D", ".txt"}


@pytest.mark.parametrize(
    ("name", "uri", "shown"),
    [
        ("a b.m3d", "a%20b.m3d", "a b.m3d"),
        ("50%#?.m3d", "50%25%23%3F.m3d", "50%#?.m3d"),
        ("c:d.m3d", "c%3Ad.m3d", "c:d.m3d"),
        ("ä/ö.m3d", "%C3%A4/%C3%B6.m3d", "ä/ö.m3d"),
        (os.fsdecode(b"caf\xe9.m3d"), "caf%E9.m3d", "caf\ufffd.m3d"),
    ],
)
def test_names_for_programs(name: str, uri: str, shown: str, tmp_path: Path) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text(BAD)
    for given, expected in ((name, uri), (str(tmp_path / name), uri)):
        (run,) = json.loads(m3dc("--check", "--message-format", "sarif", given, cwd=tmp_path).stdout)["runs"]
        place = run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]
        assert place == {"uri": expected}
    outside = json.loads(m3dc("--check", "--message-format", "sarif", tmp_path / name).stdout)["runs"][0]["results"][0]
    assert outside["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == f"{tmp_path.as_uri()}/{uri}"
    assert json.loads(m3dc("--check", "--message-format", "json", name, cwd=tmp_path).stdout)["file"] == shown


@pytest.mark.parametrize(
    "arguments",
    [
        (),
        ("--max-errors", "-1", "a.m3d"),
        ("--nonsense", "a.m3d"),
        ("a.m3d", "b.m3d"),
        ("--check", "--dump", "a.m3d"),
        ("missing.m3d",),
        (".",),
    ],
)
def test_usage_and_files_are_status_2(arguments: tuple[str, ...], tmp_path: Path) -> None:
    done = m3dc(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert "m3dc: " in done.stderr
    assert "Traceback" not in done.stderr


def test_a_folder_that_can_not_be_written(scene: Path, tmp_path: Path) -> None:
    done = m3dc("-o", tmp_path / "no" / "such" / "folder" / "x.m3ir", scene)
    assert done.returncode == 2
    assert done.stderr.startswith("m3dc: error: cannot write ")
    assert done.stderr.count("\n") == 1


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_a_read_only_folder_keeps_its_file(scene: Path, tmp_path: Path) -> None:
    folder = tmp_path / "locked"
    folder.mkdir()
    (folder / "x.m3ir").write_bytes(b"old")
    folder.chmod(0o500)
    done = m3dc("-o", folder / "x.m3ir", scene)
    folder.chmod(0o700)
    assert done.returncode == 2
    assert (folder / "x.m3ir").read_bytes() == b"old"


HOSTILE = {
    "empty": (b"", "M3D0112"),
    "blank": (b" \n\t\n", "M3D0112"),
    "only comments": (b"/* nothing /* at all */ */", "M3D0112"),
    "binary": (bytes(range(256)) * 50, "M3D0113"),
    "utf-16": ("SOLID { SPHERE { } }".encode("utf-16"), "M3D0113"),
    "NaN": (b"SOLID { SPHERE { RADIUS NaN } }", "M3D0202"),
    "1e400": (b"SOLID { SPHERE { RADIUS 1e400 } }", "M3D0114"),
    "-1e400 in a table": (b"SCENE { MIRAGE { PROFILE { 0 1 10 2 -1e400 3 } } }", "M3D0114"),
    "nested braces": (b"{" * 10_000, None),
    "nested blocks": (b"SOLID { " + b"SPHERE { " * 10_000 + b"} " * 10_001, "M3D0106"),
    "nested solids": (b"SOLID { " * 10_000 + b"} " * 10_000, None),
    "nested comments": (b"/*" * 10_000 + b"*/" * 10_000 + GOOD.encode(), ""),
    "unclosed comments": (b"/*" * 10_000, "M3D0105"),
    "closing comments": (b"*/" * 10_000, "M3D0105"),
    "one long line": (b"SCENE { SKY { } } " + b"SOLID { SPHERE { } } " * 20_000, ""),
    "a long word": (b"x" * 1_000_000, None),
    "a long number": (b"SOLID { SPHERE { RADIUS " + b"9" * 100_000 + b" } }", "M3D0114"),
    "no end": (b"SOLID { SPHERE { RADIUS", None),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_text_ends_in_a_message(name: str, tmp_path: Path) -> None:
    text, code = HOSTILE[name]
    path = tmp_path / "scene.m3d"
    path.write_bytes(text)
    done = m3dc("--check", "--message-format", "json", path)
    assert "Traceback" not in done.stderr
    codes = [json.loads(line)["code"] for line in done.stdout.splitlines()]
    if code == "":
        assert (done.returncode, codes) == (0, [])
    else:
        assert done.returncode == 1
        assert len(codes) <= 3
        assert code is None or code == codes[0]


@pytest.mark.parametrize("line", [b"SOLID { SPHERE { RADIUS -1 } }\n", b"SOLID { SPHERE { RADUIS 1 } }\n"])
def test_a_text_full_of_errors_is_given_up(line: bytes, tmp_path: Path) -> None:
    path = tmp_path / "scene.m3d"
    path.write_bytes(line * 200_000)
    done = m3dc("--check", "--message-format", "json", "--max-errors", 20_000, path)
    codes = [json.loads(found)["code"] for found in done.stdout.splitlines()]
    assert done.returncode == 1
    assert codes[-1] == "M3D0115"
    assert len(codes) <= 10_001


def test_a_truncated_example_never_crashes(examples: Path) -> None:
    import m3dc as compiler

    text = (examples / "runway.m3d").read_bytes()
    for end in range(0, len(text), 37):
        result = compiler.compile(text[:end])
        assert result.diagnostics, f"cut off at byte {end}"


def test_a_byte_order_mark_is_no_error(scene: Path) -> None:
    scene.write_bytes(b"\xef\xbb\xbf" + GOOD.encode())
    assert m3dc(scene).returncode == 0
