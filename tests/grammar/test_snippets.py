"""The snippets of the VS Code extension: each is a right scene, laid out as the formatter would."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import m3dc
from m3dc.format import format
from tree_sitter_m3d.table import LANGUAGE

ROOT = Path(__file__).parents[2]
SNIPPETS: dict[str, dict[str, str | list[str]]] = json.loads(
    (ROOT / "vscode-extension/snippets/m3d.json").read_text("utf-8")
)
STOP = re.compile(r"\$\{(\d+):([^}]*)\}")


def inserted(name: str) -> str:
    """What is in the editor after the snippet was chosen."""
    lines = SNIPPETS[name]["body"]
    assert isinstance(lines, list)
    return STOP.sub(r"\2", "\n".join(lines)).replace("\\}", "}").replace("\t", "    ") + "\n"


@pytest.mark.parametrize("name", SNIPPETS)
def test_a_snippet_is_right(name: str) -> None:
    text = inserted(name)
    whole = f"SOLID {{ SPHERE {{ }} SURFACE {{ {text} }} }}" if name.startswith("texture") else text
    errors = [diagnostic.message for diagnostic in m3dc.compile(whole).diagnostics if diagnostic.severity == "error"]
    assert errors == []


@pytest.mark.parametrize("name", [name for name in SNIPPETS if not name.startswith("texture")])
def test_a_snippet_is_laid_out(name: str) -> None:
    assert format(inserted(name).encode()).decode() == inserted(name)


@pytest.mark.parametrize("name", SNIPPETS)
def test_the_stops_are_numbered_as_they_come(name: str) -> None:
    numbers = [int(number) for number, _ in STOP.findall("\n".join(SNIPPETS[name]["body"]))]
    assert numbers == list(range(1, len(numbers) + 1))


def test_there_is_one_for_whatever_a_scene_is_put_together_from() -> None:
    blocks = {keyword for text in map(inserted, SNIPPETS) for keyword in re.findall(r"[A-Z]+\d?", text)}
    expected = {keyword for top in ("SCENE", "SOLID", "LIGHT", "TEXTURE") for keyword in LANGUAGE.blocks[top].holds}
    assert blocks >= expected | {"VARIABLES"}
