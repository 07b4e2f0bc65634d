"""Renders the pictures of the documentation: `make gallery`.

They are also what tests/test_gallery.py compares with: a picture that changes is looked at before it is
committed.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

import m3d_render
import m3dc
from m3dc.ir import with_square_pixels

ROOT = Path(__file__).parent.parent
IMAGES = ROOT / "docs" / "images"


class Picture(NamedTuple):
    """A picture of the gallery: the example it shows and how."""

    name: str
    example: str
    straight: bool = False


PICTURES = (
    Picture("merman-straight", "merman", straight=True),
    Picture("merman-mirage", "merman"),
    Picture("runway-straight", "runway", straight=True),
    Picture("runway-mirage", "runway"),
    Picture("wheel", "wheel"),
    Picture("two-balls", "two-balls"),
    Picture("cylinder-and-cone", "cylinder-and-cone"),
    Picture("terrain", "terrain"),
)


def render(what: Picture) -> np.ndarray:
    """The picture as an array (H, W, 3) of values 0..1. Its pixels are square, as a page shows them: where the scene
    has an ASPECT there are more rows, so that balls look round."""
    source = (ROOT / "examples" / f"{what.example}.m3d").read_bytes()
    result = m3dc.compile(source, f"{what.example}.m3d")
    view = result.ir.scene.view
    height = round(view.height * view.aspect)
    return m3d_render.render(with_square_pixels(result.ir), straight=what.straight, height=height)


def main() -> None:
    IMAGES.mkdir(exist_ok=True)
    for what in PICTURES:
        path = IMAGES / f"{what.name}.png"
        m3d_render.write_picture(path, render(what))
        print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
