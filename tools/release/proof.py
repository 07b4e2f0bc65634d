"""Tries the distributions of a folder as those do who have nothing but them: no compiler, no cargo, no checkout.

Everything raises ReleaseError where something is wrong.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

from packaging.metadata import Metadata

from tools.release.environment import UV, WORK, ReleaseError, output, run, say, tool
from tools.version import DISTRIBUTIONS, ROOT, version

COMPILER = re.compile(r"(.*-)?(cc|c\+\+|gcc|g\+\+|clang|clang\+\+|cpp|ld|ld\..*|as|tcc|c89|c99|zig)(-[\d.]+)?")
"""The names of programs that compile C. Those of Rust begin with cargo or rust."""

MEGABYTE = 1e6

BARE = WORK / "bare"
"""The virtual environment that the proof leaves: mirage3d[plot] as pip installs it."""


def prove(dist: Path) -> None:
    """All of it, the quick things first."""
    wheels = sorted(dist.glob("*.whl"))
    _check_names(dist)
    for wheel in wheels:
        check_contents(wheel)
    for wheel in wheels:
        if not wheel.name.endswith("-none-any.whl"):
            _check_compiled(wheel)
    _check_sdists(dist)
    _check_tool(dist)
    _check_documentation(dist)


# --- the files --------------------------------------------------------------------------------------------------------


def _check_names(dist: Path) -> None:
    for distribution in DISTRIBUTIONS:
        name = f"{distribution.replace('-', '_')}-{version()}"
        for pattern in (f"{name}-*.whl", f"{name}.tar.gz"):
            if not list(dist.glob(pattern)):
                raise ReleaseError(f"{dist}: there is no {pattern}")


def distribution_of(wheel: Path) -> str:
    """The distribution that a wheel is of."""
    return wheel.name.split("-")[0].replace("_", "-")


def check_contents(wheel: Path) -> None:
    """Every tracked file of the distribution's packages is in the wheel, and its metadata is that of this version."""
    folder = ROOT / DISTRIBUTIONS[distribution_of(wheel)]
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
        metadata = next(name for name in names if name.endswith(".dist-info/METADATA"))
        described = Metadata.from_email(archive.read(metadata), validate=True)
    packages = {path.parent.name for path in folder.glob("*/py.typed")}
    listed = output("git", "ls-files", "--cached", "--others", "--exclude-standard", cwd=folder).splitlines()
    wanted = {name for name in listed if name.split("/")[0] in packages and (folder / name).exists()}
    # What stands beside the package in the checkout and is read as a part of it.
    beside = {"m3d-language": {"m3d_language/m3d.lark", "m3d_language/queries/highlights.scm"}}
    if missing := (wanted | beside.get(distribution_of(wheel), set())) - names:
        raise ReleaseError(f"{wheel.name} lacks {', '.join(sorted(missing))}")
    if not any(name.endswith("licenses/LICENSE") for name in names):
        raise ReleaseError(f"{wheel.name} lacks the licence")
    if str(described.version) != version():
        raise ReleaseError(f"{wheel.name} says that it is of version {described.version}")
    for wanted in described.requires_dist or []:
        if wanted.url is not None:
            raise ReleaseError(f"{wheel.name} wants what nobody else has: {wanted}")


def _check_compiled(wheel: Path) -> None:
    """It uses nothing of Python that may change, and no library newer than its name says."""
    run(tool("abi3audit"), "--strict", wheel)
    size = f"{wheel.stat().st_size / MEGABYTE:.2f} MB"
    if sys.platform != "linux":
        say(f"{wheel.name}: {size}")
        return
    shown = output(tool("auditwheel"), "show", wheel)
    glibc = max((tuple(map(int, found.split("."))) for found in re.findall(r"GLIBC_([\d.]+)", shown)), default=())
    libraries = sorted(set(re.findall(r"\blib[\w-]+\.so\.\d+", shown)))
    fits = re.search(r'following platform tag: "(\w+)"', " ".join(shown.split()))
    if fits is None or fits[1] not in wheel.name:
        raise ReleaseError(f"{wheel.name} does not fit its name:\n{shown}")
    say(f"{wheel.name}: {size}, glibc {'.'.join(map(str, glibc))}, {', '.join(libraries)}")


def _check_sdists(dist: Path) -> None:
    """A wheel can be built of each with the ordinary tools, and has the same files."""
    # What cargo has compiled of other crates for the programs of the checkout need not be compiled again.
    environment = {**os.environ, "CARGO_TARGET_DIR": str(ROOT / "renderer/target")}
    for sdist in sorted(dist.glob("*.tar.gz")):
        with tempfile.TemporaryDirectory() as folder:
            run(UV, "build", "--quiet", "--wheel", "--out-dir", folder, sdist, env=environment)
            (built,) = Path(folder).glob("*.whl")
            (shipped,) = (wheel for wheel in dist.glob("*.whl") if distribution_of(wheel) == distribution_of(built))
            if other := _files(built) ^ _files(shipped):
                raise ReleaseError(f"{sdist.name} makes another wheel: {', '.join(sorted(other))}")
        say(f"{sdist.name}: builds")


def _files(wheel: Path) -> set[str]:
    with zipfile.ZipFile(wheel) as archive:
        return {name for name in archive.namelist() if not name.endswith("/")}


# --- an installation --------------------------------------------------------------------------------------------------


def bare_path() -> str:
    """A PATH with the programs of this one but those that compile."""
    folder = WORK / "bin"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for place in map(Path, os.environ["PATH"].split(os.pathsep)):
        for program in place.iterdir() if place.is_dir() else ():
            name = program.name
            if not COMPILER.fullmatch(name) and not name.startswith(("cargo", "rust", "m3d", "mirage3d", "maturin")):
                with_name = folder / name
                if not with_name.is_symlink():
                    with_name.symlink_to(program)
    for name in ("cc", "gcc", "clang", "ld", "cargo", "rustc", "zig", "m3dc"):
        assert shutil.which(name, path=str(folder)) is None, name
    return str(folder)


def _bare_environment() -> dict[str, str]:
    outside = {"VIRTUAL_ENV", "PYTHONPATH", "CC", "CI"}
    return {**{name: text for name, text in os.environ.items() if name not in outside}, "PATH": bare_path()}


def _check_tool(dist: Path) -> None:
    """`uv tool install mirage3d` brings every command, and says how to get what an extra brings."""
    home = WORK / "uv-tool"
    shutil.rmtree(home, ignore_errors=True)
    places = {"UV_TOOL_DIR": str(home / "tools"), "UV_TOOL_BIN_DIR": str(home / "bin")}
    environment = {**_bare_environment(), **places}
    start = time.perf_counter()
    run(UV, "tool", "install", "--quiet", "--find-links", dist, f"mirage3d=={version()}", env=environment)
    seconds = time.perf_counter() - start
    commands = sorted(path.name for path in (home / "bin").iterdir())
    for command in commands:
        run(home / "bin" / command, "--version", env=environment)
    scene = ROOT / "examples/merman.m3d"
    plot = [home / "bin/m3d-plot", "profile", scene, "-o", home / "profile.svg"]
    done = subprocess.run(plot, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 2 or "mirage3d[plot]" not in done.stderr or len(done.stderr.splitlines()) != 1:
        raise ReleaseError(f"m3d-plot without matplotlib does not say how to get it: {done.stderr}")
    say(f"uv tool install mirage3d: {_size(home):.0f} MB, {seconds:.1f} s, {', '.join(commands)}")


def _check_documentation(dist: Path) -> None:
    """The documentation's examples run in an environment of pip's, with figures."""
    shutil.rmtree(BARE, ignore_errors=True)
    environment = _bare_environment()
    run(sys.executable, "-m", "venv", BARE, env=environment)
    pip = [BARE / "bin/python", "-m", "pip", "--quiet", "--disable-pip-version-check", "install"]
    start = time.perf_counter()
    ours = [f"{name}=={version()}" for name in DISTRIBUTIONS]
    run(*pip, "--no-index", "--no-deps", "--find-links", dist, *ours, env=environment)
    run(*pip, "--only-binary", ":all:", f"mirage3d[plot]=={version()}", env=environment)
    seconds = time.perf_counter() - start
    say(f"pip install mirage3d[plot]: {_size(BARE):.0f} MB, {seconds:.1f} s")
    tests = [ROOT / ".venv/bin/python", "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/test_docs.py"]
    run(*tests, env={**environment, "MIRAGE3D_PYTHON": str(BARE / "bin/python")})
    say("The commands of README and the examples of the documentation run there.")


def _size(folder: Path) -> float:
    files = {path.stat().st_ino: path.stat().st_size for path in folder.rglob("*") if path.is_file()}
    return sum(files.values()) / MEGABYTE
