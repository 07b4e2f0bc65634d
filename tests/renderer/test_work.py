"""Long work: the same picture however it is divided, what is shown and kept on the way, and how soon it ends."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Sequence
from typing import Unpack

import numpy as np
import pytest
from scene_builder import merman

import m3d_render
from m3d_render import RenderOptions
from m3dc.ir import Ambient

OPTIONS: list[RenderOptions] = [
    {},
    {"straight": True, "shadows": True},
    {"samples": 3, "shadows": True, "refract_reflections": True},
]


def render(
    scene: m3d_render.Prepared, options: RenderOptions, aov: Sequence[str] = (), **more: Unpack[RenderOptions]
) -> m3d_render.Rendering:
    """A rendering by the options of a case, and more that the test adds."""
    both: RenderOptions = {**options, **more}
    return scene.render(aov=aov, **both)


@pytest.fixture(scope="module")
def scene() -> m3d_render.Prepared:
    """The merman with random light on it."""
    scene = merman(61, 43).set(ambient=Ambient(0.2, (1, 1, 1), 2, 3), shadows=True)
    for surface in scene.rows["surfaces"]:
        surface["fuzz"] = 0.1
    return m3d_render.prepare(scene.build())


@pytest.mark.parametrize("options", OPTIONS)
def test_threads_tiles_and_parts_make_the_same_picture(scene: m3d_render.Prepared, options: RenderOptions):
    aov = ["position", "path", "uv"]
    one = render(scene, options, aov, threads=1)
    expected = [one.picture.tobytes(), *(layer.tobytes() for layer in one.layers.values())]

    def same(rendering: m3d_render.Rendering) -> bool:
        return [rendering.picture.tobytes(), *(layer.tobytes() for layer in rendering.layers.values())] == expected

    assert all(same(render(scene, options, aov, threads=n)) for n in (2, 3, 8))
    assert all(same(render(scene, options, aov, threads=n, tiles=lambda _: None)) for n in (1, 3))
    rng = np.random.default_rng(5)
    cuts = [0, 3, 4, 19, 30, 43]
    parts = [(first, end - 1) for first, end in itertools.pairwise(cuts)]
    order: list[int] = rng.permutation(len(parts)).tolist()
    rendered = {i: render(scene, options, rows=parts[i]).picture for i in order}
    joined = np.concatenate([rendered[i] for i in range(len(parts))])
    assert joined.tobytes() == expected[0]
    pieces = np.empty_like(one.picture)
    for top, left in rng.permutation([(t, le) for t in range(0, 43, 17) for le in range(0, 61, 23)]).tolist():
        piece = render(scene, options, region=(top, left, top + 16, left + 22)).picture
        pieces[top : top + 17, left : left + 23] = piece
    assert pieces.tobytes() == expected[0]


# On the way


def test_tiles_come_from_coarse_to_fine(scene: m3d_render.Prepared):
    tiles: list[m3d_render.Tile] = []
    whole = scene.render(tiles=tiles.append).picture
    canvas = np.full_like(whole, np.nan)
    steps = [tile.step for tile in tiles]
    assert steps == sorted(steps, reverse=True)
    assert set(steps) == {4, 2, 1}
    for tile in tiles:
        rows = min(4, 43 - tile.top)
        expected = whole[tile.top : tile.top + rows : tile.step, :: tile.step]
        assert tile.pixels.tobytes() == expected.tobytes()
        canvas[tile.top : tile.top + rows : tile.step, :: tile.step] = tile.pixels
    assert canvas.tobytes() == whole.tobytes()
    assert sum(tile.step == 4 for tile in tiles) == 11


def test_normalised_tiles_stay_within_their_range(scene: m3d_render.Prepared):
    tiles: list[m3d_render.Tile] = []
    scene.render(tiles=tiles.append, normalize=True)
    assert all(tile.pixels.max() <= 1 for tile in tiles)


def test_progress_rises_to_the_last_row(scene: m3d_render.Prepared):
    def slow(_: m3d_render.Tile) -> None:
        time.sleep(0.002)

    for tiles in (None, slow):
        seen: list[tuple[int, int]] = []
        scene.render(samples=32, progress=lambda done, rows: seen.append((done, rows)), tiles=tiles)  # noqa: B023
        assert seen == sorted(set(seen))
        assert seen[-1] == (43, 43)


SLOW: dict[str, RenderOptions] = {
    "many pixels": {"width": 20_000, "height": 10_000},
    "many samples a pixel": {"samples": 65_536, "rows": (20, 43)},
    "tiles": {"width": 20_000, "height": 10_000, "tiles": lambda _: None},
}


@pytest.mark.parametrize("name", [*SLOW, "much light to sample"])
def test_a_cancelled_rendering_ends(scene: m3d_render.Prepared, name: str):
    """How soon is measured by the row `cancel` of the bench; to the end each of these would take minutes to years."""
    if name not in SLOW:
        slow = merman(40, 30).set(ambient=Ambient(0.2, (1, 1, 1), 1_000_000, 50))
        scene = m3d_render.prepare(slow.build())
    asked = itertools.count(1)
    with pytest.raises(m3d_render.Cancelled) as cancelled:
        render(scene, SLOW.get(name, {}), cancel=lambda: next(asked) == 30)
    assert next(asked) == 31, "it was asked again after it had said yes"
    rendering = cancelled.value.rendering
    assert rendering.region.bottom == rendering.region.top + len(rendering.picture) - 1


def test_a_cancelled_rendering_keeps_its_finished_rows(scene: m3d_render.Prepared):
    asked = threading.Event()

    def progress(done: int, _: int):
        if done >= 5:
            asked.set()

    options: RenderOptions = {"samples": 300}
    with pytest.raises(m3d_render.Cancelled) as cancelled:
        render(scene, options, ["depth"], progress=progress, cancel=asked.is_set)
    kept = cancelled.value.rendering
    rows = len(kept.picture)
    assert 3 <= rows < 43
    again = render(scene, options, ["depth"], rows=(0, rows - 1))
    assert kept.picture.tobytes() == again.picture.tobytes()
    assert kept.layers["depth"].tobytes() == again.layers["depth"].tobytes()


def test_an_error_in_a_callback_is_the_callers(scene: m3d_render.Prepared):
    def fail(*_: object) -> float:
        return 1 / 0

    each: list[RenderOptions] = [{"progress": fail}, {"cancel": fail}, {"tiles": fail}]
    for options in each:
        with pytest.raises(ZeroDivisionError):
            render(scene, options, width=2000, height=1500)
