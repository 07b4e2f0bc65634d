"""The pictures of the documentation are what the examples render to: `make gallery` writes them anew."""

from __future__ import annotations

import pytest
from pictures import assert_current, in_steps, stored

from tools import gallery

EDGE_PIXELS = 0.002


@pytest.mark.parametrize("what", gallery.PICTURES, ids=lambda what: what.name)
def test_picture_is_current(what: gallery.Picture) -> None:
    kept = stored(gallery.IMAGES / f"{what.name}.png")
    assert_current(in_steps(gallery.render(what)), kept, EDGE_PIXELS, what.name)
