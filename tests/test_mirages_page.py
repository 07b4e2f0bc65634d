"""docs/mirages.md shows what its commands make; else `make gallery`."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import OpenImageIO
from doc_script import load

# Another processor's exp or cos may round another way: a step of 8 bits anywhere, and an edge here and there.
STEPS = 2
EDGE_PIXELS = 0.005
MOST_BYTES = 60_000

PAGE = load("mirages")


def pixels(file: Path) -> np.ndarray:
    return OpenImageIO.ImageBuf(str(file)).get_pixels(OpenImageIO.UINT8).astype(int)


def test_every_picture_is_made_by_a_command_of_the_page() -> None:
    shown = set(re.findall(r"\(images/mirages/(.+?)\)", PAGE.PAGE.read_text(encoding="utf-8")))
    assert shown == set(PAGE.commands())
    assert shown == {file.name for file in PAGE.IMAGES.iterdir()}
    assert all(file.stat().st_size < MOST_BYTES for file in PAGE.IMAGES.iterdir())


def test_the_rendered_pictures_are_current(tmp_path: Path) -> None:
    """Figures are left out: another version of matplotlib may set their text otherwise."""
    rendered = [name for name, command in PAGE.commands().items() if "m3d-render" in command]
    PAGE.make(rendered, tmp_path)
    assert len(rendered) > 10
    for name in rendered:
        fresh, kept = pixels(tmp_path / "out" / name), pixels(PAGE.IMAGES / name)
        assert fresh.shape == kept.shape
        differs = np.abs(fresh - kept).max(axis=-1) > STEPS
        assert differs.mean() <= EDGE_PIXELS, (
            f"{name}: {differs.sum()} pixels differ; look at them, then `make gallery`"
        )
