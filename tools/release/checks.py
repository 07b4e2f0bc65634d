"""What must be so before a version is released."""

from __future__ import annotations

import re

from tools import version
from tools.release.environment import ReleaseError, output
from tools.version import ROOT


def check(wanted: str) -> None:
    """Raises ReleaseError, which says all that must be done first."""
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    wrong = [*of_version(wanted), *of_changelog(changelog, wanted), *of_tree()]
    if wrong:
        raise ReleaseError(f"{wanted} can not be released:\n" + "\n".join(f"- {each}" for each in wrong))


def of_version(wanted: str) -> list[str]:
    """Whether this is a version, and that of every file."""
    wrong: list[str] = []
    if not re.fullmatch(r"\d+\.\d+\.\d+((a|b|rc)\d+)?", wanted):
        wrong.append(f"'{wanted}' is no version: make release VERSION=0.2.0")
    elif wanted != version.version():
        wrong.append(f"pyproject.toml says {version.version()}: change it there, then run `make generate`")
    stale = [str(path.relative_to(ROOT)) for path, text in version.texts().items() if path.read_text() != text]
    if stale:
        wrong.append(f"another version stands in {', '.join(stale)}: run `make generate`")
    return wrong


def of_changelog(text: str, wanted: str) -> list[str]:
    """Whether it has the version, with its date, and something to say about it."""
    heading = re.search(rf"^## {re.escape(wanted)} - \d{{4}}-\d\d-\d\d\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    if heading is None:
        return [f"CHANGELOG.md has no heading `## {wanted} - YYYY-MM-DD`"]
    return [] if heading[1].strip() else [f"CHANGELOG.md says nothing below {wanted}"]


def of_tree() -> list[str]:
    """Whether what is released is what is committed."""
    changed = output("git", "status", "--porcelain").splitlines()
    return [f"these are not committed: {', '.join(line[3:] for line in changed)}"] if changed else []
