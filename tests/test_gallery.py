"""The pictures of the documentation are what the examples render to: `make gallery` writes them anew."""

from __future__ import annotations

import numpy as np
import OpenImageIO
import pytest
from doc_script import load

# Another processor's exp or cos may round another way: a step of 8 bits anywhere, and an edge here and there.
STEPS = 2
EDGE_PIXELS = 0.002


GALLERY = load("gallery")


@pytest.mark.parametrize("what", GALLERY.PICTURES, ids=lambda what: what.name)
def test_picture_is_current(what) -> None:
    stored = OpenImageIO.ImageBuf(str(GALLERY.IMAGES / f"{what.name}.png")).get_pixels(OpenImageIO.UINT8)
    fresh = np.rint(GALLERY.render(what) * 255).astype(int)
    assert fresh.shape == stored.shape
    differs = np.abs(fresh - stored).max(axis=-1) > STEPS
    assert differs.mean() <= EDGE_PIXELS, f"{differs.sum()} pixels differ; look at them, then `make gallery`"
