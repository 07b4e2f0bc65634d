"""What a notebook shows of a compiled scene."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

import pytest

import m3dc


def notebook_html(shown: m3dc.Result | m3dc.SceneIR) -> str:
    return shown._repr_html_()  # pyright: ignore[reportPrivateUsage]  the name that notebooks call


def cells(html: str) -> str:
    """The text of HTML, with a line a row."""
    return unescape(re.sub(r"<[^>]+>", " ", html.replace("</tr>", "\n")))


def test_a_scene_shows_what_it_holds(examples: Path) -> None:
    result = m3dc.compile((examples / "merman.m3d").read_bytes(), "merman.m3d")
    text = re.sub(r"[ \u2003]+", " ", cells(notebook_html(result.ir)))
    assert "view from < 1, 0, 2.1 > to < 0, 0, 2.1001 >, 320 x 200 pixels, 1.5° wide" in text
    assert "air 34 points from 0 to 19.7 m, 3.83 to 11.36 °C; rays bent for 25000 m" in text
    assert "holds 6 solids, 1 light, 3 textures" in text
    assert "4 < 0, 0, 0 > PLANE CHECKER" in text
    assert notebook_html(result) == notebook_html(result.ir), "nothing is wrong with it"


def test_a_faulty_scene_shows_its_faults_and_what_was_understood() -> None:
    result = m3dc.compile("SOLID { SPHERE { RADIUS <b> } }\nSOLID { SPHERE { } }\n", "a<b>.m3d")
    html = notebook_html(result)
    assert "<b>.m3d" not in html, "text of the scene is not HTML"
    assert "RADIUS &lt;b&gt;" in html
    text = cells(html)
    assert re.search(r"1:\d+:\s+error\[M3D0\d+\]", text)
    assert "SPHERE" in text


@pytest.mark.parametrize("text", ["", "}", "SCENE { MIRAGE { PROFILE { 1 2 } } }", "\0\0"])
def test_any_text_can_be_shown(text: str) -> None:
    assert "<table>" in notebook_html(m3dc.compile(text))


def test_a_long_scene_is_cut_short() -> None:
    html = notebook_html(m3dc.compile("SOLID { SPHERE { } }\n" * 500))
    assert "and 480 more" in html
    assert len(html) < 20_000
    wrong = notebook_html(m3dc.compile("SOLID { SPHERE { RADIUS -1 } }\n" * 500))
    assert "500 errors" in wrong
    assert len(wrong) < 40_000
