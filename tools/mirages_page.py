"""Makes the figures of docs/mirages.md by the commands that stand in it: part of `make gallery`.

Each command writes out/NAME.png, and the page shows images/mirages/NAME.png. tests/test_mirages_page.py checks that.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "mirages.md"
IMAGES = ROOT / "docs" / "images" / "mirages"
COMMAND = re.compile(r"^(?:m3d-|python ).* -o out/([\w.-]+\.png)\b.*$", re.MULTILINE)


def commands() -> dict[str, str]:
    """The page's commands by the names of the files they write."""
    return {match[1]: match[0] for match in COMMAND.finditer(PAGE.read_text(encoding="utf-8"))}


def make(names: list[str], folder: Path) -> None:
    """Runs the commands of some files in an empty folder; they are in its folder `out` then."""
    (folder / "examples").symlink_to(ROOT / "examples")
    (folder / "out").mkdir()
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    for name in names:
        command = f"set -o pipefail; {commands()[name]}"
        subprocess.run(["bash", "-c", command], cwd=folder, env=environment, check=True)


def main() -> None:
    IMAGES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        make(list(commands()), Path(folder))
        for name in commands():
            (IMAGES / name).write_bytes((Path(folder) / "out" / name).read_bytes())
    print(PAGE.relative_to(ROOT))


if __name__ == "__main__":
    main()
