"""`python -m tools.release wheels`, `prove`, or `release VERSION`: the distributions, built and proved, in dist/."""

from __future__ import annotations

import argparse
import hashlib
import os
import shutil
import sys
from pathlib import Path

from tools.release import bom, checks
from tools.release.build import build
from tools.release.environment import DIST, WORK, ReleaseError, epoch, run, say
from tools.release.proof import BARE, prove
from tools.version import ROOT

SUMS = "SHA256SUMS"


def wheels() -> None:
    """Wheels and source distributions, proved."""
    for file in build(DIST, WORK):
        say(f"dist/{file.name}")
    prove(DIST)


def release(wanted: str) -> None:
    """Everything that is uploaded, built twice."""
    checks.check(wanted)
    _build_all(DIST, WORK)
    prove(DIST)
    again = WORK / "again"
    shutil.rmtree(again, ignore_errors=True)
    _build_all(again / "dist", again)
    _compare(DIST, again / "dist")
    shutil.rmtree(again)
    bom.write(DIST / bom.file_name(), BARE)
    (DIST / SUMS).write_text(sums(DIST), encoding="utf-8")
    say(_what_to_do(wanted))


def _build_all(dist: Path, work: Path) -> None:
    build(dist, work)
    run("make", "vsix", f"OUT={dist.relative_to(ROOT)}", env={**os.environ, "SOURCE_DATE_EPOCH": str(epoch())})


def _compare(first: Path, second: Path) -> None:
    """Raises ReleaseError where two builds differ."""
    names = [sorted(path.name for path in dist.iterdir()) for dist in (first, second)]
    different = [name for name in names[0] if (first / name).read_bytes() != (second / name).read_bytes()]
    if names[0] != names[1] or different:
        raise ReleaseError(f"a second build differs from the first: {', '.join(different) or names}")
    say(f"A second build has the same bytes: {len(names[0])} files.")


def sums(dist: Path) -> str:
    """The checksums of a folder's files, as `sha256sum --check` reads them."""
    files = sorted(path for path in dist.iterdir() if path.name != SUMS)
    return "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in files)


def _what_to_do(wanted: str) -> str:
    return f"""
{(DIST / SUMS).read_text(encoding="utf-8")}
dist/ holds Mirage3D {wanted}. To publish it:

  git tag -a v{wanted} -m 'Mirage3D {wanted}' && git push origin v{wanted}
  twine upload dist/*.whl dist/*.tar.gz            # to the package index for Python; the parts first is not needed
  npx vsce publish --packagePath dist/*.vsix       # to the marketplace of VS Code; npx ovsx publish for Open VSX

and add all files of dist/ to the release v{wanted} where the repository is hosted, with {SUMS} and the bill of
materials, {bom.file_name()}. The wheels for other systems are made by the same command there."""


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools.release", description=__doc__)
    what = parser.add_subparsers(dest="what", required=True)
    what.add_parser("wheels", help="build the wheels and source distributions, and prove them")
    what.add_parser("prove", help="only prove what is in dist/")
    what.add_parser("release", help="build all that is uploaded").add_argument("version")
    options = parser.parse_args()
    try:
        match options.what:
            case "wheels":
                wheels()
            case "prove":
                prove(DIST)
            case _:
                release(options.version)
    except ReleaseError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
