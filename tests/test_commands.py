"""Every command, whatever is asked of it and wherever it runs: how it starts and how it ends.

The exit status is 0, 1 or 2, or 128 + N after signal N; what is wrong is one line on standard error, never a traceback.
"""

from __future__ import annotations

import errno
import importlib.metadata
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import IO, Any, NamedTuple

import pytest

pytestmark = pytest.mark.slow

ENTRIES = {entry.name: entry.value for entry in importlib.metadata.entry_points(group="console_scripts")}
NAMES = ("m3dc", "m3dfmt", "m3d-render", "m3d-rays", "m3d-plot", "m3d-view", "mirage3d", "m3d-lsp")
SCENE = """SCENE {
    SKY { }
    VIEW { FROM < 12, 0, 2 > TO < 0, 0, 1 > WIDTH 12 HEIGHT 8 }
    MIRAGE { PROFILE { 0 10  5 11  10 12 } }
}
SOLID { SPHERE { CENTER < 0, 0, 1 > } }
"""
NOT_UTF8 = os.fsdecode(b"caf\xe9.m3d")
LONG = 300 * "x" + ".m3d"


class Reading(NamedTuple):
    """A way of running a command with a scene: `arguments` in which SCENE stands for its name, and the files that
    come of it."""

    arguments: tuple[str, ...]
    writes: tuple[str, ...] = ()


READINGS = {
    "m3dc": Reading(("-o", "out.m3ir", "SCENE"), ("out.m3ir",)),
    "m3dc --check": Reading(("--check", "SCENE")),
    "m3dc --dump": Reading(("--dump", "SCENE")),
    "m3dc --dump=": Reading(("--dump=out.txt", "SCENE"), ("out.txt",)),
    "m3dfmt": Reading(("--check", "SCENE")),
    "m3dfmt --diff": Reading(("--diff", "SCENE")),
    "m3d-render": Reading(("SCENE", "-o", "out.png"), ("out.png",)),
    "m3d-render -o -": Reading(("SCENE", "-o", "-")),
    "m3d-render .exr": Reading(("SCENE", "-o", "out.exr"), ("out.exr",)),
    "m3d-render .raw": Reading(("SCENE", "-o", "out.raw"), ("out.red.raw", "out.green.raw", "out.blue.raw")),
    "m3d-render .svg": Reading(("SCENE", "-o", "out.svg", "--wireframe"), ("out.svg",)),
    "m3d-render --check-normals": Reading(("SCENE", "--check-normals")),
    "m3d-rays": Reading(("SCENE", "--angles", "-2:2:1")),
    "m3d-rays --csv": Reading(("SCENE", "--angles", "-2:2:1", "--csv", "out.csv"), ("out.csv",)),
    "m3d-plot": Reading(("profile", "SCENE", "-o", "out.svg"), ("out.svg",)),
    "m3d-plot --csv": Reading(("rays", "SCENE", "--csv", "-", "--angles", "-2:2:1")),
    "mirage3d": Reading(("SCENE",), ("red.raw", "green.raw", "blue.raw")),
    "mirage3d -D": Reading(("SCENE", "-D")),
}
if find_spec("pyvista") is not None or os.environ.get("CI") == "true":
    READINGS["m3d-view"] = Reading(("SCENE", "--screenshot", "out.png", "--size", "64x40"), ("out.png",))
STATUS = {name: int(name.startswith("m3dfmt")) for name in READINGS}  # the scene is not laid out
PRINTS = ("m3dc --dump", "m3dfmt --diff", "m3d-render -o -", "m3d-rays", "m3d-plot --csv", "mirage3d -D")
WRITES = tuple(name for name, reading in READINGS.items() if reading.writes)
on_reading = pytest.mark.parametrize("name", READINGS)
on_command = pytest.mark.parametrize("command", NAMES)


def words(command: str, arguments: tuple[str, ...] = ()) -> list[str]:
    """Starts a command as its installed script does."""
    module, function = ENTRIES[command].split(":")
    return [sys.executable, "-c", f"import sys; from {module} import {function}; sys.exit({function}())", *arguments]


def run(
    command: str,
    *arguments: str,
    cwd: Path,
    env: dict[str, str] | None = None,
    stdout: IO[bytes] | int = subprocess.PIPE,
) -> subprocess.CompletedProcess[bytes]:
    done = subprocess.run(
        words(command, arguments), cwd=cwd, env=env, stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE,
        timeout=120, check=False,
    )  # fmt: skip
    assert b"Traceback" not in (done.stderr or b""), done.stderr.decode()
    return done


def read(name: str, scene: str, cwd: Path, **how: Any) -> subprocess.CompletedProcess[bytes]:
    command = name.split(" ")[0]
    return run(command, *(scene if word == "SCENE" else word for word in READINGS[name].arguments), cwd=cwd, **how)


def said(done: subprocess.CompletedProcess[bytes]) -> str:
    """What is said on standard error, which is one line."""
    text = done.stderr.decode()
    assert text.count("\n") == 1, text
    return text


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "scene.m3d").write_text(SCENE)
    return tmp_path


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


# --- what is asked of a command ---------------------------------------------------------------------------------------


@on_command
def test_help(command: str, tmp_path: Path) -> None:
    done = run(command, "--help", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, b"")
    text = done.stdout.decode()
    assert text.startswith(f"usage: {command} ")
    assert "xit status: 0 fine" in " ".join(text.split())


@on_command
def test_version(command: str, tmp_path: Path) -> None:
    done = run(command, "--version", cwd=tmp_path)
    owner = {"m3dc": "m3dc", "m3dfmt": "m3dc", "m3d-lsp": "m3d-lsp", "mirage3d": "mirage3d"}
    first, *others = done.stdout.decode().splitlines()
    assert (done.returncode, done.stderr) == (0, b"")
    assert first == f"{command} {importlib.metadata.version(owner.get(command, 'm3d-render'))}"
    assert bool(others) == (command == "mirage3d")


@on_command
@pytest.mark.parametrize("option", ["--help", "--version"])
def test_help_that_can_not_be_written(command: str, option: str, tmp_path: Path) -> None:
    with open("/dev/full", "wb") as full:
        done = run(command, option, cwd=tmp_path, stdout=full)
    assert done.returncode == 2
    assert said(done) == f"{command}: error: cannot write the output: No space left on device\n"


@on_reading
def test_a_scene_is_read(name: str, folder: Path) -> None:
    before = contents(folder)
    done = read(name, "scene.m3d", folder)
    assert done.returncode == (STATUS[name]), done.stderr.decode()
    assert contents(folder).keys() - before.keys() == set(READINGS[name].writes)
    assert contents(folder)["scene.m3d"] == SCENE.encode()


def _loop(folder: Path) -> str:
    (folder / "loop.m3d").symlink_to("loop.m3d")
    return "loop.m3d"


def _unreadable(folder: Path) -> str:
    (folder / "locked.m3d").write_text(SCENE)
    (folder / "locked.m3d").chmod(0)
    return "locked.m3d"


def _folder(folder: Path) -> str:
    (folder / "folder.m3d").mkdir()
    return "folder.m3d"


UNREADABLE: dict[str, tuple[Callable[[Path], str], int]] = {
    "missing": (lambda _: "missing.m3d", errno.ENOENT),
    "a folder": (_folder, errno.EISDIR),
    "a loop of links": (_loop, errno.ELOOP),
    "a long name": (lambda _: LONG, errno.ENAMETOOLONG),
    "under a file": (lambda _: "scene.m3d/a.m3d", errno.ENOTDIR),
    "not allowed": (_unreadable, errno.EACCES),
}


@pytest.mark.parametrize("name", [name for name in READINGS if " " not in name] + ["m3dc --check"])
@pytest.mark.parametrize("why", UNREADABLE)
def test_a_scene_that_can_not_be_read(name: str, why: str, folder: Path) -> None:
    make, number = UNREADABLE[why]
    if number == errno.EACCES and os.geteuid() == 0:
        pytest.skip("root may read anything")
    scene = make(folder)
    before = contents(folder) if number != errno.EACCES else {}
    done = read(name, scene, folder)
    assert done.returncode == 2
    if name.startswith("mirage3d"):
        assert said(done) == f"Unrecoverable Error: Unable to open input file: {scene}\n"
    elif number == errno.EISDIR and name == "m3dc --check":
        assert "there is no .m3d file in this folder" in said(done)
    else:
        assert scene in said(done)
        assert os.strerror(number) in said(done)
    assert not before or contents(folder) == before


@on_reading
def test_a_scene_with_a_name_that_is_no_utf8(name: str, folder: Path) -> None:
    (folder / NOT_UTF8).write_text(SCENE)
    done = read(name, NOT_UTF8, folder)
    assert done.returncode == STATUS[name], done.stderr.decode()


@pytest.mark.parametrize("name", PRINTS)
def test_names_in_a_locale_without_utf8(name: str, folder: Path) -> None:
    (folder / NOT_UTF8).write_text(SCENE)
    ascii = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    assert read(name, NOT_UTF8, folder, env={**os.environ, **ascii}).returncode == STATUS[name]


# --- where the output goes --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", PRINTS)
def test_output_that_can_not_be_written(name: str, folder: Path) -> None:
    with open("/dev/full", "wb") as full:
        done = read(name, "scene.m3d", folder, stdout=full)
    assert done.returncode == 2
    assert "No space left on device" in said(done)


@on_reading
@pytest.mark.parametrize("closed", [">&-", "<&- >&- 2>&-"])
def test_closed_streams(name: str, closed: str, folder: Path) -> None:
    command, arguments = name.split(" ")[0], READINGS[name].arguments
    line = words(command, tuple("scene.m3d" if word == "SCENE" else word for word in arguments))
    done = subprocess.run(
        ["bash", "-c", f'"$@" {closed}', "bash", *line], cwd=folder, capture_output=True, timeout=120, check=False
    )
    assert b"Traceback" not in done.stderr, done.stderr.decode()
    prints = name in (*PRINTS, "m3dfmt", "mirage3d") and ">&-" in closed.replace("2>&-", "")
    assert done.returncode == (2 if prints else STATUS[name]), done.stderr.decode()
    if prints and closed == ">&-":
        assert "Bad file descriptor" in said(done)
    assert contents(folder)["scene.m3d"] == SCENE.encode()


@pytest.mark.parametrize("name", PRINTS)
def test_a_reader_that_has_enough(name: str, folder: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    try:
        done = read(name, "scene.m3d", folder, stdout=writing)
    finally:
        os.close(writing)
    assert (done.returncode, done.stderr) == (2, b"")


@pytest.mark.parametrize("name", WRITES)
def test_a_disk_that_is_full_leaves_the_old_files(name: str, folder: Path) -> None:
    for file in READINGS[name].writes:
        (folder / file).write_text("old")
    before = contents(folder)
    # After what Python itself writes, which is nothing, no file may grow beyond 50 bytes.
    line = words(name.split(" ")[0], tuple("scene.m3d" if w == "SCENE" else w for w in READINGS[name].arguments))
    limited = f"import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (50, resource.RLIM_INFINITY)); {line[2]}"
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [line[0], "-c", limited, *line[3:]], cwd=folder, env=environment, capture_output=True, timeout=120, check=False
    )
    assert done.returncode == 2, done.stderr
    assert "File too large" in said(done) or "no room" in said(done)
    assert contents(folder) == before


@pytest.mark.parametrize("name", WRITES)
def test_what_is_written_never_replaces_the_scene(name: str, folder: Path) -> None:
    """Neither itself, nor through a link, nor another scene."""
    target = READINGS[name].writes[0]
    (folder / "other.m3d").write_text(SCENE)
    arguments = READINGS[name].arguments if not name.startswith("mirage3d") else ("SCENE", f"-r{target}")
    for output in ("scene.m3d", "other.m3d", target):
        if output == target:
            (folder / target).symlink_to("scene.m3d")
        elif name in ("m3d-render .exr", "m3d-render .raw", "m3d-plot", "m3d-view", "m3d-render .svg", "m3d-render"):
            continue  # the suffix names the format, and .m3d names none
        line = tuple("scene.m3d" if word == "SCENE" else word.replace(target, output) for word in arguments)
        done = run(name.split(" ")[0], *line, cwd=folder)
        assert done.returncode == 2
        assert "give another name" in said(done)
        assert contents(folder)["scene.m3d"] == contents(folder)["other.m3d"] == SCENE.encode()


@pytest.mark.parametrize(
    ("command", "arguments", "begins"),
    [
        ("m3dc", ("-o", "OUT", "scene.m3d"), b"PK"),
        ("m3dc", ("--dump=OUT", "scene.m3d"), b"Input File"),
        ("m3d-render", ("scene.m3d", "-o", "OUT"), b"\x89PNG"),
        ("m3d-render", ("scene.m3d", "-o", "OUT", "--format", "exr"), b"v/1\x01"),
        ("m3d-render", ("scene.m3d", "-o", "OUT", "--format", "tif"), b"II*\0"),
        ("m3d-render", ("scene.m3d", "-o", "OUT", "--format", "svg", "--wireframe"), b"<"),
        ("m3d-rays", ("scene.m3d", "--angles", "-1:1:1", "--csv", "OUT"), b"angle_arcmin,"),
        ("m3d-plot", ("profile", "scene.m3d", "--csv", "OUT"), b"bottom_m,"),
    ],
)
def test_standard_output_is_a_file_too(command: str, arguments: tuple[str, ...], begins: bytes, folder: Path) -> None:
    outputs: list[bytes] = []
    for output in ("-", "/dev/stdout", "/dev/fd/1"):
        environment = {**os.environ, "SOURCE_DATE_EPOCH": "0"}
        done = run(
            command,
            *(output if word == "OUT" else word.replace("OUT", output) for word in arguments),
            cwd=folder,
            env=environment,
        )
        assert (done.returncode, done.stderr) == (0, b"")
        assert done.stdout.startswith(begins)
        outputs.append(done.stdout)
    assert outputs[0] == outputs[1] == outputs[2]
    with (folder / "all").open("ab") as file:
        file.write(b"before")
        file.flush()
        run(
            command,
            *("/dev/stdout" if word == "OUT" else word.replace("OUT", "/dev/stdout") for word in arguments),
            cwd=folder,
            env=environment,
            stdout=file,
        )
    assert (folder / "all").read_bytes() == b"before" + outputs[0], "what stood in the file stays"


# --- signals and faults -----------------------------------------------------------------------------------------------

# A command to which a signal comes as it imports a module, which takes it for a failure of its own, as NumPy does.
WAITING = """
import os, sys
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == os.environ["MODULE"]:
            try:
                os.kill(os.getpid(), int(os.environ["NUMBER"]))
            except KeyboardInterrupt:
                pass
            raise ImportError("could not import a module")
sys.meta_path.insert(0, Finder())
"""
LOADED = {
    "m3dc": "numpy",
    "m3dfmt": "numpy",
    "m3d-render": "m3d_render._kernel",
    "m3d-rays": "numpy",
    "m3d-plot": "m3d_render.plot",
    "m3d-view": "m3dc",
    "mirage3d": "m3d_render",
    "m3d-lsp": "pygls",
}


@on_command
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_while_a_command_starts(command: str, number: int, folder: Path) -> None:
    line = words(command)
    reading = READINGS.get(command, Reading(()))
    done = subprocess.run(
        [
            line[0],
            "-c",
            WAITING + line[2],
            *("scene.m3d" if word == "SCENE" else word for word in reading.arguments),
        ],
        cwd=folder,
        env={**os.environ, "MODULE": LOADED[command], "NUMBER": str(int(number))},
        capture_output=True,
        stdin=subprocess.DEVNULL,
        timeout=120,
        check=False,
    )
    assert done.returncode == 128 + number, done.stderr
    assert said(done).startswith(f"{command}: interrupted")
    assert contents(folder).keys() == {"scene.m3d"}


# The command, with something that happens as its file is being written.
FAULTY = """
import os, signal, sys
def happen(*_):
    {what}
os.fsync = happen
"""
FAULTS = {
    "SIGINT": ("os.kill(os.getpid(), signal.SIGINT)", 130, "interrupted"),
    "SIGTERM": ("os.kill(os.getpid(), signal.SIGTERM)", 143, "interrupted"),
    "no memory": ("raise MemoryError", 2, "error: this does not fit in memory"),
    "a fault": ("raise KeyError('of ours')", 2, "internal error: KeyError: 'of ours' (<string>:4)"),
    "a disk": ("raise OSError(5, 'Input/output error')", 2, "Input/output error"),
    "what is no Exception": (
        "raise type('Panic', (BaseException,), {{}})('index out of bounds')".replace("{{}}", "{}"),
        2,
        "internal error: Panic: index out of bounds",
    ),
}


@pytest.mark.parametrize("name", WRITES)
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_while_a_file_is_written(name: str, fault: str, folder: Path) -> None:
    what, status, says = FAULTS[fault]
    for file in READINGS[name].writes:
        (folder / file).write_text("old")
    before = contents(folder)
    line = words(name.split(" ")[0], tuple("scene.m3d" if w == "SCENE" else w for w in READINGS[name].arguments))
    done = subprocess.run(
        [line[0], "-c", FAULTY.replace("{what}", what) + line[2], *line[3:]],
        cwd=folder,
        capture_output=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == status, done.stderr
    assert says in said(done)
    assert contents(folder) == before, "the old files stay, and no other is left"


def test_the_traceback_of_a_fault_can_be_had(folder: Path) -> None:
    line = words("m3dc", ("scene.m3d",))
    done = subprocess.run(
        [line[0], "-c", FAULTY.replace("{what}", "raise KeyError('of ours')") + line[2], *line[3:]],
        cwd=folder,
        env={**os.environ, "MIRAGE3D_TRACEBACK": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "Traceback (most recent call last)" in done.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_ignored_signal_stays_ignored(number: int, folder: Path) -> None:
    line = words("m3dc", ("-o", "out.m3ir", "scene.m3d"))
    what = FAULTY.replace("{what}", f"os.kill(os.getpid(), {int(number)})")
    done = subprocess.run(
        [line[0], "-c", f"import signal; signal.signal({int(number)}, signal.SIG_IGN)\n" + what + line[2], *line[3:]],
        cwd=folder,
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"")
