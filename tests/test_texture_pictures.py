"""docs/textures.md and its pictures are what the kernel's comments and textures make; else `make gallery`."""

from __future__ import annotations

import pytest
from pictures import assert_current, in_steps, stored

import m3dc
from m3d_language.table import LANGUAGE
from tools import texture_pictures

EDGE_PIXELS = 0.005
MOST_BYTES = 40_000


@pytest.mark.parametrize("example", texture_pictures.EXAMPLES, ids=lambda example: example.keyword)
def test_picture_is_current(example: texture_pictures.Example) -> None:
    kept = stored(texture_pictures.IMAGES / example.image)
    assert_current(in_steps(texture_pictures.render(example)), kept, EDGE_PIXELS)
    assert (texture_pictures.IMAGES / example.image).stat().st_size < MOST_BYTES


def test_the_contact_sheet_is_current() -> None:
    pictures = [stored(texture_pictures.IMAGES / example.image) / 255 for example in texture_pictures.EXAMPLES]
    kept = stored(texture_pictures.IMAGES / texture_pictures.SHEET)
    assert_current(in_steps(texture_pictures.contact_sheet(pictures)), kept, EDGE_PIXELS)


def test_the_page_is_current() -> None:
    assert texture_pictures.PAGE.read_text(encoding="utf-8") == texture_pictures.page()


def test_every_texture_has_a_picture_and_a_scene_without_complaints() -> None:
    assert {example.keyword for example in texture_pictures.EXAMPLES} == set(LANGUAGE.blocks["TEXTURE"].holds)
    for example in texture_pictures.EXAMPLES:
        assert m3dc.compile(texture_pictures.scene(example)).diagnostics == ()
