"""Previews: pictures of a document as it stands, made in a process of their own, and what their pixels are."""

from __future__ import annotations

import asyncio
import base64
import os
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from editor import Editor, Scene, position
from lsprotocol import types
from numpy.typing import NDArray
from own_requests import edit, process_of, start_server, to_range
from pygls.exceptions import JsonRpcInvalidParams

import m3d_render
import m3dc
from m3d_lsp.preview.requests import filling
from m3d_render import optics
from m3d_render.picture import to_bytes

pytestmark = pytest.mark.asyncio(loop_scope="session")

TILE = "m3d/preview/tile"
ENDLESS = 60_000  # samples a pixel: more than any test waits for

BALLS = """\
VARIABLES { SPHERE round; }
$4round = { RADIUS 1 }
SCENE { VIEW { FROM < 10, 0, 3 > TO < 0, 0, 1 > WIDTH 101 HEIGHT 81 } LOGSCALE 4 }
$[SOLID { $0SPHERE { CENTER < 0, -2, 1 > } SURFACE { COLOR < 1, 0, 0 > } }$]
SOLID { $2SPHERE round { CENTER < 0, 2, 1 > } SURFACE { COLOR < 0, 0, 1 > } }
LIGHT { $1SOURCE { FROM < 9, 9, 9 > } }
"""


class View:
    """A preview as a client shows it: the tiles put together."""

    def __init__(self, editor: Editor, scene: Scene, name: str, optics: str = "mirage") -> None:
        self._client = editor.client
        self._scene = scene
        self._params = {"textDocument": {"uri": scene.uri}, "optics": optics}
        self.name = name

    async def ask(self, what: str, **params: Any) -> Any:
        return await self.start(what, **params)

    def start(self, what: str, number: str | None = None, **params: Any) -> asyncio.Future[Any]:
        """The answer, which is not waited for; `number` is the request's own."""
        given = {"preview": self.name, **params}
        if what in ("render", "save"):
            given |= self._params
        return asyncio.wrap_future(self._client.protocol.send_request(f"m3d/preview/{what}", given, msg_id=number))

    async def at(self, mark: str) -> Any:
        """The mask of what is at a mark."""
        place = self._scene.places[mark]
        return await self.ask("mask", position={"line": place.line, "character": place.character})

    @property
    def tiles(self) -> list[Any]:
        return [tile for tile in self._client.notified.get(TILE, []) if tile.preview == self.name]

    def picture(self) -> NDArray[np.uint8]:
        """What the tiles show, the last on top."""
        last = self.tiles[-1]
        shown = np.zeros((last.height, last.width, 3), np.uint8)
        for tile in self.tiles:
            pixels = np.frombuffer(base64.b64decode(tile.pixels), np.uint8).reshape(tile.rows, tile.columns, 3)
            squares = pixels.repeat(tile.step, axis=0).repeat(tile.step, axis=1)
            below = tile.top + len(squares)
            shown[tile.top : below] = squares[: tile.height - tile.top, : tile.width]
        return shown


async def until(condition: Callable[[], bool]) -> None:
    async with asyncio.timeout(20):
        while not condition():
            await asyncio.sleep(0.01)


async def test_a_preview_is_the_picture_of_the_text_as_it_stands(editor: Editor) -> None:
    scene = editor.open(BALLS)
    scene = edit(editor, scene, "< 1, 0, 0 >", "< 0, 1, 0 >")
    view = View(editor, scene, "plain")
    answer = await view.ask("render")
    assert (answer.status, answer.version, answer.stale, answer.message) == ("done", 2, False, None)
    assert (answer.width, answer.height, answer.bent) == (101, 81, False)
    assert (view.picture() == to_bytes(m3d_render.render(m3dc.compile(scene.text).ir))).all()
    steps = [tile.step for tile in view.tiles]
    assert steps == sorted(steps, reverse=True)
    assert steps[-1] == 1


async def test_it_fits_with_its_proportions_kept(editor: Editor) -> None:
    view = View(editor, editor.open(BALLS.replace("WIDTH 101 HEIGHT 81", "WIDTH 60000 HEIGHT 30000")), "small")
    answer = await view.ask("render", maxWidth=90, maxHeight=90)
    assert (answer.width, answer.height) == (90, 45)
    assert view.picture().shape == (45, 90, 3)


@pytest.mark.parametrize(
    ("size", "most", "expected"),
    [
        ("WIDTH 40 HEIGHT 20", (200, 200), (200, 100)),  # larger than the scene's own
        ("WIDTH 320 HEIGHT 200 ASPECT 1.2", (400, 400), (400, 300)),  # 4 : 3 on a screen
        ("WIDTH 320 HEIGHT 200 ASPECT 1.2", (400, 150), (200, 150)),
        ("WIDTH 2 HEIGHT 1", (60_000, 60_000), (2828, 1414)),  # 4,000,000 pixels
    ],
)
async def test_a_picture_that_fills_has_the_shape_of_the_view(
    size: str, most: tuple[int, int], expected: tuple[int, int]
) -> None:
    view = m3dc.compile(f"SCENE {{ VIEW {{ {size} }} }}").ir.scene.view
    assert filling(view, *most) == expected


async def test_a_picture_that_fills_shows_balls_round(editor: Editor) -> None:
    ball = "SOLID { SPHERE { RADIUS 1 } } SCENE { VIEW { FROM < 10, 0, 0 > TO < 0, 0, 0 > FOV 20 WIDTH 40 HEIGHT 30"
    view = View(editor, editor.open(ball + " ASPECT 1.5 } BACKGROUND < 1, 0, 1 > AMBIENT { INTENSITY 1 } }"), "round")
    answer = await view.ask("render", maxWidth=300, maxHeight=300, fill=True)
    assert (answer.width, answer.height, answer.aspect) == (267, 300, 1)
    assert (answer.ownWidth, answer.ownHeight) == (40, 30)
    shown = (view.picture() != [255, 0, 255]).any(axis=2)
    across, down = np.count_nonzero(shown.any(axis=0)), np.count_nonzero(shown.any(axis=1))
    assert across > 100
    assert abs(across - down) <= 2
    # As large as the scene says it is squashed, and the client is told by how much.
    answer = await view.ask("render")
    assert (answer.width, answer.height, answer.aspect) == (40, 30, 1.5)


async def test_straight_and_bent_pictures_of_one_scene(editor: Editor, examples: Path) -> None:
    scene = editor.open((examples / "merman.m3d").read_text(encoding="utf-8"), "merman")
    ir = m3dc.compile(scene.text).ir
    straight, bent = View(editor, scene, "straight", "straight"), View(editor, scene, "bent", "mirage")
    answers = await asyncio.gather(straight.ask("render", maxWidth=80), bent.ask("render", maxWidth=80))
    assert [(answer.status, answer.bent) for answer in answers] == [("done", False), ("done", True)]
    assert (straight.picture() == to_bytes(m3d_render.render(ir, straight=True, width=80, height=50))).all()
    assert (bent.picture() == to_bytes(m3d_render.render(ir, width=80, height=50))).all()


async def test_the_last_good_picture_is_kept_while_there_are_errors(editor: Editor) -> None:
    scene = editor.open(BALLS)
    view = View(editor, scene, "kept")
    await view.ask("render")
    before = view.picture()
    scene = edit(editor, scene, "RADIUS 1", "RADIUS")
    answer = await view.ask("render")
    assert (answer.status, answer.version, answer.stale) == ("done", 1, True)
    assert (view.picture() == before).all()
    never = View(editor, editor.open("SOLID { SPHERE"), "never good")
    answer = await never.ask("render")
    assert answer.status == "error"
    assert "has errors" in answer.message


async def test_what_the_renderer_refuses_is_said(editor: Editor) -> None:
    answer = await View(editor, editor.open(BALLS), "many").ask("render", samples=100_000)
    assert answer.status == "error"
    assert "samples must be from 1 to" in answer.message


async def test_the_newest_request_wins(editor: Editor) -> None:
    scene = editor.open(BALLS)
    view = View(editor, scene, "newest")
    first = view.start("render", samples=ENDLESS)
    second = view.start("render", samples=ENDLESS)
    await editor.client.wait_until(lambda: view.tiles or None)
    third = view.start("render")
    assert [(await each).status for each in (first, second, third)] == ["cancelled", "cancelled", "done"]
    assert (view.picture() == to_bytes(m3d_render.render(m3dc.compile(scene.text).ir))).all()


async def test_tiles_name_the_job_that_they_are_of(editor: Editor) -> None:
    view = View(editor, editor.open(BALLS), "jobs")
    assert (await view.ask("render")).status == "done"
    assert {tile.job for tile in view.tiles} == {None}  # none was given
    endless = view.start("render", job=7, samples=ENDLESS)
    await editor.client.wait_until(lambda: any(tile.job == 7 for tile in view.tiles) or None)
    before = len(view.tiles)
    answers = await asyncio.gather(endless, view.ask("render", job=8))
    assert [answer.status for answer in answers] == ["cancelled", "done"]
    jobs = [tile.job for tile in view.tiles[before:]]
    assert set(jobs) <= {7, 8}
    assert jobs == sorted(jobs)  # none of a request that has ended
    with pytest.raises(JsonRpcInvalidParams, match="job must be a whole number, 1 or more"):
        await view.ask("render", job=0)


async def test_a_client_can_cancel(editor: Editor) -> None:
    view = View(editor, editor.open(BALLS), "cancelled")
    answer = view.start("render", "the-number", samples=ENDLESS)
    await editor.client.wait_until(lambda: view.tiles or None)
    editor.client.cancel_request(types.CancelParams("the-number"))
    assert (await answer).status == "cancelled"
    assert (await view.ask("render")).status == "done"


async def test_closing_the_preview_or_the_document_ends_it(editor: Editor) -> None:
    view = View(editor, editor.open(BALLS), "closed")
    assert (await view.ask("render")).status == "done"
    answer = view.start("render", samples=ENDLESS)
    assert await view.ask("pick", x=38, y=40) is not None
    assert await view.ask("close") is None
    assert (await answer).status == "cancelled"
    assert await view.ask("pick", x=38, y=40) is None
    editor.close()
    with pytest.raises(JsonRpcInvalidParams, match="is not open"):
        await view.ask("render")


async def test_which_statement_made_a_pixel(editor: Editor) -> None:
    scene = editor.open(BALLS)
    view = View(editor, scene, "pick")
    assert await view.ask("pick", x=0, y=0) is None  # nothing is drawn
    await view.ask("render")
    whole = m3d_render.prepare(m3dc.compile(scene.text).ir).render(aov=["solid", "depth", "position", "path"])
    found: dict[int, Any] = {}
    for y, x in np.argwhere(whole.layers["solid"] >= 0)[::50].tolist():
        picked = await view.ask("pick", x=x, y=y)
        assert picked.solid == whole.layers["solid"][y, x]
        assert picked.color == pytest.approx(whole.picture[y, x].tolist())
        assert picked.position == pytest.approx(whole.layers["position"][y, x].tolist())
        assert picked.depth == pytest.approx(float(whole.layers["depth"][y, x]))
        assert [picked.path.length, picked.path.arcs] == pytest.approx(whole.layers["path"][y, x].tolist())
        found[picked.solid] = picked
    assert scene.part(to_range(found[0].range)) == "SPHERE { CENTER < 0, -2, 1 > }"
    assert to_range(found[0].solidRange) == scene.range
    assert found[1].primitive == 1
    for outside in ({"x": 0, "y": 0}, {"x": 101, "y": 0}, {"x": 0, "y": 81}):
        assert await view.ask("pick", **outside) is None
    height, width = whole.layers["solid"].shape
    for times in (2, 3):  # in a picture so many times as large
        larger = {"width": times * width, "height": times * height}
        for y, x in np.argwhere(whole.layers["solid"] >= 0)[::200].tolist():
            here = await view.ask("pick", x=x, y=y)
            assert await view.ask("pick", x=times * x, y=times * y + 1, **larger) == here
        assert await view.ask("pick", x=times * width, y=0, **larger) is None
    smaller = await view.ask("pick", x=0, y=0, width=1, height=1)
    assert smaller == await view.ask("pick", x=width // 2, y=height // 2)
    with pytest.raises(JsonRpcInvalidParams, match="x must be"):
        await view.ask("pick", x=-1, y=0)


async def test_places_move_with_the_text(editor: Editor) -> None:
    scene = editor.open(BALLS)
    view = View(editor, scene, "moved")
    await view.ask("render")
    scene = edit(editor, scene, "LOGSCALE 4 }", "LOGSCALE 4 }\n\n/* what came between */")
    picked = await view.ask("pick", x=38, y=40)
    assert picked.version == 1
    assert scene.part(to_range(picked.range)) == "SPHERE { CENTER < 0, -2, 1 > }"


ROW = """\
SCENE { VIEW { FROM < 20, 0, 3 > TO < 0, 0, 1 > WIDTH 90 HEIGHT 30 } LOGSCALE 4 }
SOLID { SPHERE { CENTER < 0, -2, 1 > } SURFACE { COLOR < 1, 0, 0 > } }
SOLID { SPHERE { CENTER < 0, 0, 1 > } SURFACE { COLOR < 0, 1, 0 > } }
SOLID { SPHERE { CENTER < 0, 2, 1 > } SURFACE { COLOR < 0, 0, 1 > } }
LIGHT { SOURCE { FROM < 9, 9, 9 > } }
"""
MIDDLE = "SPHERE { CENTER < 0, 0, 1 > }"


@pytest.mark.parametrize("whole", [False, True], ids=["edits", "whole texts"])
async def test_picture_and_text_keep_together_over_edits_far_apart(editor: Editor, whole: bool) -> None:
    scene = editor.open(ROW)
    solid = next(line for line in ROW.splitlines() if MIDDLE in line)
    view = View(editor, scene, f"far apart {whole}")
    await view.ask("render")

    def change(start: int, end: int, new: str) -> None:
        nonlocal scene
        text = scene.text[:start] + new + scene.text[end:]
        if whole:
            scene = editor.replace(scene, text)
        else:
            range_ = types.Range(position(scene.text, start), position(scene.text, end))
            editor.change(scene, types.TextDocumentContentChangePartial(range_, new))
            scene = scene._replace(text=text)

    async def check(stale: bool) -> None:
        picked = await view.ask("pick", x=45, y=14)
        assert scene.part(to_range(picked.range)) == MIDDLE
        assert scene.part(to_range(picked.solidRange)) == solid
        at = position(scene.text, scene.text.index(MIDDLE) + 2)
        place = {"line": at.line, "character": at.character}
        mask = await view.ask("mask", position=place)
        assert scene.part(to_range(mask.range)) == solid
        assert mask.runs
        params = {"textDocument": {"uri": scene.uri}, "position": place}
        dump = await editor.client.protocol.send_request_async("m3d/dump", params)
        assert dump.stale == stale
        assert "Solid Object Definition # 2" in dump.text
        assert to_range(dump.ranges[0]) == to_range(picked.solidRange)

    change(0, 0, "/* one */\n/* two */\n")
    await check(stale=False)
    end = len(scene.text)
    for count, letter in enumerate("SOLID {", 1):
        change(end + count - 1, end + count - 1, letter)
    await check(stale=True)
    change(0, 0, "x")
    await check(stale=True)
    before = scene.text.index(solid)
    change(before, before, "SOLID { SPHERE { } }\n")
    await check(stale=True)
    line = position(scene.text, before).line
    assert await view.ask("mask", position={"line": line, "character": 3}) is None
    after = scene.text.index(solid) + len(solid)
    change(after, after, " /* three */")
    change(scene.text.index("-2"), scene.text.index("-2") + 2, "-2.5")
    await check(stale=True)


async def test_which_pixels_a_statement_makes(editor: Editor) -> None:
    scene = editor.open(BALLS)
    view = View(editor, scene, "mask")
    await view.ask("render")
    rendering = m3d_render.prepare(m3dc.compile(scene.text).ir).render(aov=["solid"])

    def drawn(mask: Any) -> NDArray[np.bool_]:
        shown = np.zeros((mask.height, mask.width), bool)
        for row, start, end in mask.runs:
            shown[row, start:end] = True
        return shown

    mask = await view.at("0")
    assert to_range(mask.range) == scene.range
    assert (drawn(mask) == (rendering.layers["solid"] == 0)).all()
    assert (drawn(await view.at("2")) == (rendering.layers["solid"] == 1)).all()
    light = await view.at("1")  # it has no body
    assert list(light.runs) == []


async def test_a_primitive_in_a_variable_is_shown_wherever_it_is_used(editor: Editor) -> None:
    scene = editor.open("""\
        VARIABLES { SOLID pair; }
        pair = { $[SPH$0ERE { CENTER < 0, -2, 1 > }$] SPHERE { CENTER < 0, 2, 1 > } }
        SCENE { VIEW { FROM < 20, 0, 3 > TO < 0, 0, 1 > WIDTH 60 HEIGHT 40 } }
        SOLID pair { }
        SOLID pair { TRANSFORM { TRANSLATE < 0, 0, 3 > } }
        LIGHT { SOURCE { FROM < 9, 9, 9 > } }
    """)
    assert await editor.diagnostics(scene) == []
    view = View(editor, scene, "variable")
    await view.ask("render")
    layers = m3d_render.prepare(m3dc.compile(scene.text).ir).render(aov=["primitive"]).layers
    mask = await view.at("0")
    assert to_range(mask.range) == scene.range
    assert sum(end - start for _, start, end in mask.runs) == np.isin(layers["primitive"], [0, 2]).sum()


async def test_the_ray_through_a_pixel(editor: Editor, examples: Path) -> None:
    scene = editor.open((examples / "merman.m3d").read_text(encoding="utf-8"), "merman")
    ir = m3dc.compile(scene.text).ir
    eye = ir.scene.view.eye
    bent, straight = View(editor, scene, "bent ray", "mirage"), View(editor, scene, "straight ray", "straight")
    for view in (bent, straight):
        await view.ask("render", maxWidth=160)
    whole = m3d_render.prepare(ir).render(width=160, height=100, aov=["position", "primitive", "path"])
    seen: set[str] = set()
    for x, y in ((80, 20), (80, 45), (80, 55), (80, 90)):
        ray = await bent.ask("ray", x=x, y=y)
        seen.add(ray.end)
        assert ray.points[0] == [0, eye[2]]
        if whole.layers["primitive"][y, x] >= 0:
            place = whole.layers["position"][y, x]
            assert ray.end == "hit"
            assert ray.points[-1] == pytest.approx([np.hypot(*(place[:2] - eye[:2])), place[2]], rel=1e-5)
            assert len(ray.points) >= whole.layers["path"][y, x, 1]
        else:
            angle = np.arctan2(ray.points[1][1] - eye[2], ray.points[1][0])
            assert ray.end in optics.trace_paths(ir, [angle]).ends
        assert (np.diff([r for r, _ in ray.points]) > 0).all()
        assert len((await straight.ask("ray", x=x, y=y)).points) == 2
    assert "hit" in seen
    assert seen - {"hit"}


@pytest.mark.parametrize("suffix", ["png", "exr", "tif"])
async def test_saving_writes_what_the_renderer_makes(editor: Editor, tmp_path: Path, suffix: str) -> None:
    scene = editor.open(BALLS)
    path, expected = tmp_path / f"saved.{suffix}", tmp_path / f"expected.{suffix}"
    answer = await View(editor, scene, "unused").ask("save", path=str(path))
    assert (answer.status, answer.path) == ("done", str(path))
    m3d_render.write_picture(expected, m3d_render.render(m3dc.compile(scene.text).ir))
    import OpenImageIO

    saved, made = (OpenImageIO.ImageBuf(str(each)).get_pixels() for each in (path, expected))
    assert (saved == made).all()


async def test_saving_tells_how_far_it_is(editor: Editor, tmp_path: Path) -> None:
    reports = editor.client.progress_reports
    before = set(reports)
    scene = editor.open(BALLS.replace("WIDTH 101 HEIGHT 81", "WIDTH 400 HEIGHT 300"))
    answer = await View(editor, scene, "unused").ask("save", path=str(tmp_path / "saved.png"))
    assert answer.status == "done"
    (token,) = set(reports) - before
    said: list[Any] = reports[token]
    percentages = [report.percentage for report in said[:-1]]
    assert percentages[0] == 0
    assert percentages == sorted(percentages)
    assert [report.kind for report in (said[0], said[-1])] == ["begin", "end"]


@pytest.mark.filterwarnings("ignore:Unknown progress token")  # pytest-lsp knows of none that the client gave
async def test_saving_can_be_cancelled(editor: Editor, tmp_path: Path) -> None:
    path = tmp_path / "saved.png"
    path.write_text("old")
    params: dict[str, Any] = {"path": str(path), "samples": ENDLESS, "workDoneToken": "slow"}
    answer = View(editor, editor.open(BALLS), "unused").start("save", **params)
    await until(lambda: "slow" in editor.client.progress_reports)
    editor.client.window_work_done_progress_cancel(types.WorkDoneProgressCancelParams("slow"))
    assert (await answer).status == "cancelled"
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


async def test_what_can_not_be_saved_is_explained(editor: Editor, tmp_path: Path) -> None:
    scene = editor.open(BALLS)
    view = View(editor, scene, "unused")
    for path, message in (
        (tmp_path / "picture.gif", "must name the picture's format"),
        (tmp_path / "nowhere" / "picture.png", "does not exist"),
    ):
        answer = await view.ask("save", path=str(path))
        assert answer.status == "error"
        assert message in answer.message
    edit(editor, scene, "RADIUS 1", "RADIUS")
    answer = await view.ask("save", path=str(tmp_path / "picture.png"))
    assert (answer.status, "has errors" in answer.message) == ("error", True)


# --- processes ----------------------------------------------------------------------------------------------------

on_linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="finds processes in /proc")


def children(process: int) -> list[int]:
    """The processes that a process has started."""
    lists = Path(f"/proc/{process}/task").glob("*/children")
    return [int(child) for each in lists for child in each.read_text().split()]


def alive(process: int) -> bool:
    try:
        return "\nState:\tZ" not in Path(f"/proc/{process}/status").read_text()
    except FileNotFoundError:
        return False


@on_linux
async def test_a_drawing_process_that_dies_is_replaced() -> None:
    client, _ = await start_server()
    server = process_of(client)
    try:
        editor = Editor(client)
        view = View(editor, editor.open(BALLS), "survivor")
        assert (await view.ask("render")).status == "done"
        before = len(view.tiles)
        drawing = view.start("render", samples=ENDLESS)
        await client.wait_until(lambda: len(view.tiles) > before or None)
        (worker,) = children(server.pid)
        os.kill(worker, signal.SIGKILL)
        answer = await drawing
        assert answer.status == "error"
        assert "was ended unexpectedly, by SIGKILL; the next preview starts another" in answer.message
        assert await view.ask("pick", x=38, y=40) is None
        assert (await view.ask("render")).status == "done"
        assert await view.ask("pick", x=38, y=40) is not None
        (other,) = children(server.pid)
        assert other != worker
    finally:
        await client.shutdown_session()


@pytest.mark.slow
@on_linux
@pytest.mark.parametrize("how", ["the client says so", "the client is gone", "the server is killed"])
async def test_no_process_is_left_behind(how: str) -> None:
    client, _ = await start_server()
    server = process_of(client)
    editor = Editor(client)
    view = View(editor, editor.open(BALLS), "left")
    drawing = view.start("render", samples=ENDLESS)
    await client.wait_until(lambda: view.tiles or None)
    (worker,) = children(server.pid)
    if how == "the client says so":
        await client.shutdown_session()
    elif how == "the client is gone":
        assert server.stdin is not None
        server.stdin.close()
        await until(lambda: not alive(server.pid))
    else:
        server.kill()
    await until(lambda: not alive(worker))
    drawing.cancel()
    await client.stop()
