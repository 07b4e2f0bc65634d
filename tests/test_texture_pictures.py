"""docs/textures.md and its pictures are what the kernel's comments and textures make; else `make gallery`."""

from __future__ import annotations

import numpy as np
import OpenImageIO
import pytest
from doc_script import load

import m3dc
from tree_sitter_m3d.table import LANGUAGE

# Another processor's exp or cos may round another way: a step or two of 8 bits anywhere, and an edge here and there.
STEPS = 2
EDGE_PIXELS = 0.005
MOST_BYTES = 40_000


PICTURES = load("texture_pictures")


def stored(name: str) -> np.ndarray:
    return OpenImageIO.ImageBuf(str(PICTURES.IMAGES / name)).get_pixels(OpenImageIO.UINT8).astype(int)


def check(fresh: np.ndarray, name: str) -> None:
    kept = stored(name)
    fresh = np.rint(fresh * 255).astype(int)
    assert fresh.shape == kept.shape
    differs = np.abs(fresh - kept).max(axis=-1) > STEPS
    assert differs.mean() <= EDGE_PIXELS, f"{differs.sum()} pixels differ; look at them, then `make gallery`"


@pytest.mark.parametrize("example", PICTURES.EXAMPLES, ids=lambda example: example.keyword)
def test_picture_is_current(example) -> None:
    check(PICTURES.render(example), example.image)
    assert (PICTURES.IMAGES / example.image).stat().st_size < MOST_BYTES


def test_the_contact_sheet_is_current() -> None:
    check(PICTURES.contact_sheet([stored(example.image) / 255 for example in PICTURES.EXAMPLES]), PICTURES.SHEET)


def test_the_page_is_current() -> None:
    assert PICTURES.PAGE.read_text(encoding="utf-8") == PICTURES.page()


def test_every_texture_has_a_picture_and_a_scene_without_complaints() -> None:
    assert {example.keyword for example in PICTURES.EXAMPLES} == set(LANGUAGE.blocks["TEXTURE"].holds)
    for example in PICTURES.EXAMPLES:
        assert m3dc.compile(PICTURES.scene(example)).diagnostics == ()
