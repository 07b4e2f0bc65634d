"""`python -m fuzz`: see the package's description. Exit status 1 when something failed; its input is in out/fuzz/.

Each target runs in a process of its own: a case that ends it, or that takes too long or too much memory, is a failure.
"""

from __future__ import annotations

import argparse
import importlib
import os
import pickle
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from types import ModuleType

from . import TARGETS, Failure, outcome

OUT = Path("out/fuzz")

# A target that has not ended so long after its time is stuck in one case.
GRACE_SECONDS = 60.0
MOST_MEMORY = 6 << 30


def main() -> int:
    options = _parser().parse_args()
    targets: list[str] = options.targets or list(TARGETS)
    if options.child:
        return _child(targets[0], options, Path(options.child))
    if options.input:
        return _again(targets[0], options.input.read_bytes())
    failed = 0
    for target in targets:
        print(f"{target}: {options.seconds:g} s from seed {options.seed}", flush=True)
        for failure in _run(target, options):
            failed += 1
            _save(target, failure)
    return 1 if failed else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m fuzz", description="Try input that nobody would think of.")
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=f"of {', '.join(TARGETS)}; all of them if none")
    parser.add_argument("--seconds", type=float, default=120.0, help="how long for each target (%(default)g)")
    parser.add_argument("--seed", type=int, default=1, help="of the first case (%(default)s)")
    parser.add_argument("--cases", type=int, help="end after so many")
    parser.add_argument("--input", type=Path, metavar="FILE", help="try this input alone")
    parser.add_argument("--child", help=argparse.SUPPRESS)
    return parser


def _target(name: str) -> ModuleType:
    return importlib.import_module(f"{__package__}.{name}")


def _child(target: str, options: argparse.Namespace, found: Path) -> int:
    """Run one target in this process and leave what failed in a file."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    found.write_bytes(pickle.dumps(_target(target).run(options.seconds, options.seed, options.cases)))
    return 0


def _run(target: str, options: argparse.Namespace) -> list[Failure]:
    with tempfile.TemporaryDirectory() as folder:
        found, current = Path(folder, "found"), Path(folder, "current")
        command = [sys.executable, "-m", "fuzz", target, "--seconds", str(options.seconds), "--seed", str(options.seed)]
        command += ["--child", str(found)]
        if options.cases is not None:
            command += ["--cases", str(options.cases)]
        environment = {**os.environ, "FUZZ_CURRENT_CASE": str(current), "PYTHONFAULTHANDLER": "1"}
        try:
            done = subprocess.run(command, env=environment, timeout=options.seconds + GRACE_SECONDS, check=False)
            what = f"it ended the process, status {done.returncode}"
        except subprocess.TimeoutExpired:
            what = f"it did not end within {GRACE_SECONDS:g} s"
        if found.exists():
            return pickle.loads(found.read_bytes())
        seed, _, data = current.read_bytes().partition(b"\n") if current.exists() else (b"%d" % options.seed, b"", b"")
        return [Failure(int(seed), data, what)]


def _again(target: str, data: bytes) -> int:
    what = outcome(_target(target).check, data)
    print(what or "nothing is wrong")
    return 1 if what else 0


def _save(target: str, failure: Failure) -> None:
    OUT.mkdir(parents=True, exist_ok=True)
    path = OUT / f"{target}-{failure.seed}{getattr(_target(target), 'SUFFIX', '')}"
    path.write_bytes(failure.input)
    print(f"{target}: seed {failure.seed}, {path}\n{failure.what}\n", flush=True)


if __name__ == "__main__":
    sys.exit(main())
