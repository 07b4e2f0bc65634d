"""Builds the wheels and source distributions, the same bytes each time and wherever the checkout lies.

On Linux the compiled parts are built by zig, for the C library of 2014 (glibc 2.17, `manylinux2014`), and so run on
every distribution since; elsewhere by the ordinary compilers, for this system.
"""

from __future__ import annotations

import gzip
import os
import platform
import shutil
import sys
import tarfile
from pathlib import Path

from tools.release.environment import TOOLS, UV, epoch, output, run, tool
from tools.version import DISTRIBUTIONS, ROOT

GLIBC = "2.17"
COMPATIBILITY = "manylinux2014"
KERNEL = "m3d-render"


def build(dist: Path, work: Path) -> list[Path]:
    """Builds all distributions into `dist`, a folder that holds nothing else afterwards; returns the files.

    `work` keeps what cargo has compiled, so that a second build is quick.
    """
    for folder in (dist, work / "source", work / "built"):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    source = copied(work / "source")
    for distribution, folder in DISTRIBUTIONS.items():
        made = work / "built" / distribution
        if distribution == KERNEL:
            _build_with_cargo(source / folder, made, work / "target")
        else:
            _build_with_setuptools(source / folder, made)
    for file in (work / "built").glob("*/*.tar.gz"):
        pack_anew(file, dist / file.name, epoch())
    for file in (work / "built").glob("*/*.whl"):
        if sys.platform == "linux" and "-linux_" in file.name:
            _repair(file, dist)
        else:
            shutil.copyfile(file, dist / file.name)
    return sorted(dist.iterdir())


def copied(to: Path) -> Path:
    """A copy of the checkout without what was ever built in it, because setuptools would pack that too."""
    listed = output("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard").split("\0")
    # Not tracked, but what was tried is what should be built.
    for name in {*filter(None, listed), "renderer/Cargo.lock"}:
        if (ROOT / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, to / name)
    return to


def pack_anew(archive: Path, to: Path, time: int) -> None:
    """Writes a .tar.gz whose bytes depend on its files' names and contents alone."""
    with (
        tarfile.open(archive) as old,
        to.open("wb") as file,
        gzip.GzipFile("", "wb", 9, file, mtime=time) as packed,  # "": the archive's name is not in it
        tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as new,
    ):
        for member in sorted(old.getmembers(), key=lambda each: each.name):
            plain = tarfile.TarInfo(member.name)
            plain.type, plain.size, plain.mtime = member.type, member.size, time
            plain.mode = 0o755 if member.isdir() or member.mode & 0o100 else 0o644
            new.addfile(plain, old.extractfile(member))


def _build_with_cargo(source: Path, made: Path, target: Path) -> None:
    options = ["--release", "--strip", "--target-dir", target, "--out", made]
    if sys.platform == "linux":
        options += ["--zig", "--compatibility", COMPATIBILITY]
    run(tool("maturin"), "build", *options, cwd=source, env=_environment(source))
    run(tool("maturin"), "sdist", "--out", made, cwd=source, env=_environment(source))


def _build_with_setuptools(source: Path, made: Path) -> None:
    """The wheel is built of the unpacked source distribution, which therefore has all that it needs."""
    options = ["--quiet", "--no-build-isolation", "--python", TOOLS / "bin/python", "--out-dir", made]
    run(UV, "build", *options, source, env=_environment(source))


def _repair(wheel: Path, dist: Path) -> None:
    options = ["--plat", f"{COMPATIBILITY}_{platform.machine()}", "--wheel-dir", dist]
    run(tool("auditwheel"), "repair", *options, wheel, env=_environment(wheel.parent))


def _environment(source: Path) -> dict[str, str]:
    cargo = os.environ.get("CARGO_HOME", str(Path.home() / ".cargo"))
    rust = [os.environ.get("RUSTFLAGS", ""), f"--remap-path-prefix={source}=.", f"--remap-path-prefix={cargo}=cargo"]
    made = {
        **os.environ,
        "PATH": f"{TOOLS / 'bin'}{os.pathsep}{os.environ['PATH']}",
        "SOURCE_DATE_EPOCH": str(epoch()),
        "RUSTFLAGS": " ".join(rust).strip(),
        "UV_PYTHON_DOWNLOADS": "never",
    }
    if sys.platform == "linux":
        compiler = f"{TOOLS / 'bin/python'} -m ziglang cc -target {platform.machine()}-linux-gnu.{GLIBC} -g0"
        made |= {"CC": compiler, "LDSHARED": f"{compiler} -shared -Wl,-s"}
    return made
