"""The snippets of the VS Code extension, and the scene of its walkthrough: each is a right scene, laid out as the
formatter would, and its picture shows what it is about."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import m3d_render
import m3dc
from m3d_language.table import LANGUAGE
from m3dc.format import format

ROOT = Path(__file__).parents[2]
SNIPPETS: dict[str, dict[str, str | list[str]]] = json.loads(
    (ROOT / "vscode-extension/snippets/m3d.json").read_text("utf-8")
)
WALKTHROUGH = ROOT / "vscode-extension/walkthrough"
PLAIN = "SURFACE { COLOR < 0.8, 0, 0 > SPECULAR 0.3 ROUGH 0.2 %s }"
BALL = "SOLID { SPHERE { CENTER < 0, 0, 2 > RADIUS 2 } " + PLAIN + " }"
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


def picture(text: str, *, straight: bool = False) -> NDArray[np.float32]:
    result = m3dc.compile(text)
    assert [diagnostic.message for diagnostic in result.diagnostics] == []
    return m3d_render.render(result.ir, straight=straight, width=160, height=100)


def assert_well_lit(shown: NDArray[np.float32]) -> None:
    """Neither black nor washed out, and not all one colour."""
    assert 0.15 < shown.mean() < 0.85
    assert (shown.min(axis=2) > 0.99).mean() < 0.3
    assert shown.std(axis=(0, 1)).max() > 0.02


def differing(one: NDArray[np.float32], other: NDArray[np.float32]) -> float:
    """The part of the pixels that plainly differ."""
    return float((np.abs(one - other).max(axis=2) > 0.1).mean())


@pytest.mark.parametrize("name", [name for name in SNIPPETS if name.startswith("solid")])
def test_a_scene_of_two_snippets_shows_the_solid(name: str) -> None:
    shown = picture(inserted("scene") + inserted(name))
    assert_well_lit(shown)
    assert differing(shown, picture(inserted("scene"))) > 0.01


@pytest.mark.parametrize("name", [name for name in SNIPPETS if name.startswith("scene")])
def test_every_kind_of_scene_shows_a_ball_on_a_plane(name: str) -> None:
    assert_well_lit(picture(inserted(name) + inserted("solid") + inserted("solid-plane")))


@pytest.mark.parametrize("name", [name for name in SNIPPETS if name.startswith("light")])
def test_a_light_lights_a_plane(name: str) -> None:
    dark = inserted("scene") + inserted("solid-plane")
    shown = picture(dark + inserted(name))
    assert_well_lit(shown)
    assert shown.mean() > picture(dark).mean() + 0.02


@pytest.mark.parametrize("name", [name for name in SNIPPETS if name.startswith("texture")])
def test_a_texture_is_seen_on_a_ball(name: str) -> None:
    shown = picture(inserted("scene") + BALL % inserted(name))
    assert_well_lit(shown)
    assert (np.abs(shown - picture(inserted("scene") + BALL % "")).max(axis=2) > 0.02).mean() > 0.003


def test_the_scene_of_the_walkthrough_shows_a_mirage() -> None:
    text = (WALKTHROUGH / "mirage.m3d").read_text("utf-8")
    assert format(text.encode()).decode() == text
    straight, bent = picture(text, straight=True), picture(text)
    assert_well_lit(straight)
    assert_well_lit(bent)
    assert differing(straight, bent) > 0.1
    assert [balls(text, straight=True), balls(text, straight=False)] == [1, 2]


def balls(text: str, *, straight: bool) -> int:
    """How often one meets the ball, the second solid, on the way down the middle of the picture."""
    rendering = m3d_render.prepare(m3dc.compile(text).ir).render(
        straight=straight, width=160, height=100, aov=["solid"]
    )
    (met,) = np.nonzero(rendering.layers["solid"][:, 80] == 1)
    return 1 + int(np.count_nonzero(np.diff(met) > 1))


def test_the_walkthrough_shows_its_scene() -> None:
    assert (WALKTHROUGH / "mirage.m3d").read_text("utf-8") in (WALKTHROUGH / "scene.md").read_text("utf-8")
