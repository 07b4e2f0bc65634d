"""Writes the exact version of every Python package into the root pyproject.toml: `make pins`.

They stand there instead of in uv.lock, which also records the address of the registry that each package came from, and
so is not committed. The hand-written constraints above the line MADE limit what a new version may be.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

ROOT = Path(__file__).parent.parent
PROJECT = ROOT / "pyproject.toml"
UV = ROOT / ".venv/bin/uv"

MADE = "    # Below here: every version as it was last tried, written by `make pins`.\n"
END = "]\n"


def with_pins(text: str, pins: list[str]) -> str:
    """The text of pyproject.toml with these pins in place of those it has."""
    start = text.index(MADE) + len(MADE)
    return text[:start] + "".join(f'    "{pin}",\n' for pin in pins) + text[text.index(END, start) :]


def newest() -> list[str]:
    """The newest version of every package that the hand-written constraints allow, as requirements."""
    everything = ("--all-packages", "--all-groups", "--all-extras")
    subprocess.run([UV, "lock", "--quiet", "--upgrade"], cwd=ROOT, check=True)
    export = [UV, "export", "--quiet", "--frozen", "--no-hashes", "--no-header", "--no-annotate", "--no-emit-workspace"]
    done = subprocess.run([*export, *everything], cwd=ROOT, check=True, capture_output=True, text=True)
    return done.stdout.splitlines()


def main() -> None:
    before = PROJECT.read_text(encoding="utf-8")
    PROJECT.write_text(with_pins(before, []), encoding="utf-8")
    try:
        after = with_pins(before, newest())
    except BaseException:
        PROJECT.write_text(before, encoding="utf-8")
        raise
    PROJECT.write_text(after, encoding="utf-8")
    changed = sorted(set(after.splitlines()) ^ set(before.splitlines()))
    print("\n".join(changed) or "All pins are the newest.")


if __name__ == "__main__":
    main()
