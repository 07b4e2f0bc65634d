"""docs/mirages.md shows what its commands make; else `make gallery`."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pictures import assert_current, stored

from tools import mirages_page

EDGE_PIXELS = 0.005
MOST_BYTES = 60_000


def test_every_picture_is_made_by_a_command_of_the_page() -> None:
    shown = set(re.findall(r"\(images/mirages/(.+?)\)", mirages_page.PAGE.read_text(encoding="utf-8")))
    assert shown == set(mirages_page.commands())
    assert shown == {file.name for file in mirages_page.IMAGES.iterdir()}
    assert all(file.stat().st_size < MOST_BYTES for file in mirages_page.IMAGES.iterdir())


@pytest.mark.slow
def test_the_rendered_pictures_are_current(tmp_path: Path) -> None:
    """Figures are left out: another version of matplotlib may set their text otherwise."""
    rendered = [name for name, command in mirages_page.commands().items() if "m3d-render" in command]
    mirages_page.make(rendered, tmp_path)
    assert len(rendered) > 10
    for name in rendered:
        assert_current(stored(tmp_path / "out" / name), stored(mirages_page.IMAGES / name), EDGE_PIXELS, name)
