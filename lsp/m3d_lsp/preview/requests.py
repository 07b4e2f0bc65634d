"""`m3d/preview/...`: a picture of a document as it stands in the editor, and what its pixels are.

One sees a scene change as it is typed; can ask which statement made a pixel, and which pixels a statement makes; and
can follow the light that came to one.
"""

from __future__ import annotations

import asyncio
import base64
import math
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from m3dc.ir import SceneIR, View

from ..documents import file_name
from ..given import Given
from ..good import Good, last_good
from ..registry import server_request
from ..text import Span
from .messages import Draw, Ended, Mask, Pick, Progress, Ray, Save, Tile
from .previews import Shown
from .progress import WorkDone

if TYPE_CHECKING:
    from ..server import Server

OPTICS = ("straight", "mirage")

# A picture with all that is kept of it takes 64 bytes a pixel.
MOST_PIXELS = 4_000_000
ANY_SIDE = 65_535

NOT_GOOD = "the scene has errors, and no earlier version without any is known; mend them to see a picture"
NOT_SAVED = "the scene has errors; mend them before saving its picture"


@server_request("m3d/preview/render")
async def render(server: Server, params: Any) -> dict[str, Any]:
    """A picture, notified in tiles while it is made."""
    given = Given(params)
    name, uri, straight = given.text("preview"), given.uri(), given.one_of("optics", OPTICS) == "straight"
    samples = given.whole("samples", 1, 1)
    most = given.whole("maxWidth", 1, ANY_SIDE), given.whole("maxHeight", 1, ANY_SIDE)
    fill = given.flag("fill")
    answer = {"status": "cancelled", "version": 0, "stale": False, "width": 0, "height": 0, "seconds": 0.0}
    answer |= {"bent": False, "message": None, "aspect": 1.0, "ownWidth": 0, "ownHeight": 0}
    previews = server.previews
    previews.begin(name)
    shown: Shown | None = None
    try:
        good = await last_good(server, uri)
        snapshot, ir = good.snapshot, good.snapshot.analysis.ir
        answer |= {"version": snapshot.version, "stale": good.stale}
        if not snapshot.analysis.ok:
            return answer | {"status": "error", "message": NOT_GOOD}
        view = ir.scene.view
        width, height = filling(view, *most) if fill else fit(view.width, view.height, *most)
        answer |= {"width": width, "height": height, "aspect": 1.0 if fill else view.aspect}
        answer |= {"ownWidth": view.width, "ownHeight": view.height}

        def hears(message: Tile | Progress) -> None:
            if isinstance(message, Tile):
                server.protocol.notify("m3d/preview/tile", _tile(name, snapshot.version, width, height, message))

        threads = server.documents.settings.preview.threads
        number = scene = 0

        def make(new_number: int, new_scene: int) -> Draw:
            nonlocal number, scene
            number, scene = new_number, new_scene
            return Draw(number, scene, straight, width, height, samples, threads, square=fill)

        ended = await previews.work(snapshot.analysis, make, hears)
        if ended.status == "done":
            shown = Shown(number, scene, snapshot, width, height)
        return answer | _outcome(ended)
    except asyncio.CancelledError:
        return answer
    finally:
        previews.end(name, shown)


def fit(width: int, height: int, most_width: int, most_height: int) -> tuple[int, int]:
    """The size of a picture made smaller to fit, with its proportions kept."""
    share = min(1.0, most_width / width, most_height / height, math.sqrt(MOST_PIXELS / (width * height)))
    return max(1, round(width * share)), max(1, round(height * share))


def filling(view: View, most_width: int, most_height: int) -> tuple[int, int]:
    """The size of a picture with square pixels that is as large as fits, be it larger than the scene's own."""
    shape = view.height * view.aspect / view.width
    width = min(most_width, most_height / shape, math.sqrt(MOST_PIXELS / shape))
    return max(1, round(width)), max(1, round(width * shape))


def _tile(name: str, version: int, width: int, height: int, tile: Tile) -> dict[str, Any]:
    return {
        "preview": name,
        "version": version,
        "width": width,
        "height": height,
        "top": tile.top,
        "step": tile.step,
        "columns": tile.columns,
        "rows": tile.rows,
        "pixels": base64.b64encode(tile.pixels).decode("ascii"),
    }


def _outcome(ended: Ended) -> dict[str, Any]:
    return {
        "status": ended.status,
        "seconds": ended.seconds,
        "bent": ended.bent,
        "message": ended.message or None,
    }


@server_request("m3d/preview/pick")
async def pick(server: Server, params: Any) -> dict[str, Any] | None:
    """What a pixel shows, and which text made it."""
    given = Given(params)
    shown, x, y = _pixel(server, given)
    found = None if shown is None else await server.previews.ask(shown, Pick(x, y))
    if shown is None or found is None:
        return None
    ir = shown.snapshot.analysis.ir
    good = await _now(server, shown)
    primitive = found["primitive"]
    light, owners = int(ir["primitives"]["light"][primitive]), "solids"
    owner = found["solid"]
    if owner < 0:
        owner, owners = light, "lights"
    return {
        "version": shown.snapshot.version,
        "range": good.range(_span(ir, "primitives", primitive)),
        "solidRange": good.range(_span(ir, owners, owner)),
        **found,
    }


@server_request("m3d/preview/mask")
async def mask(server: Server, params: Any) -> SimpleNamespace | None:
    """Where the picture shows what stands at a place of the text."""
    given = Given(params)
    shown, position = server.previews.shown(given.text("preview")), given.position()
    if shown is None or position is None:
        return None
    good = await _now(server, shown)
    found = primitives_at(shown.snapshot.analysis.ir, good.place(position))
    if found is None:
        return None
    span, primitives = found
    runs = await server.previews.ask(shown, Mask(primitives))
    if runs is None:
        return None
    size = {"width": shown.width, "height": shown.height}
    return SimpleNamespace(version=shown.snapshot.version, **size, runs=runs, range=good.range(span))


@server_request("m3d/preview/ray")
async def ray(server: Server, params: Any) -> SimpleNamespace | None:
    """The path of the light that a pixel shows, in the vertical plane through it and the eye."""
    shown, x, y = _pixel(server, Given(params))
    found = None if shown is None else await server.previews.ask(shown, Ray(x, y))
    return None if found is None else SimpleNamespace(**found)


@server_request("m3d/preview/save")
async def save(server: Server, params: Any) -> dict[str, Any]:
    """A picture at the scene's own size, in a file."""
    given = Given(params)
    uri, straight = given.uri(), given.one_of("optics", OPTICS) == "straight"
    path, samples = given.text("path"), given.whole("samples", 1, 1)
    answer = {"status": "cancelled", "path": path, "message": None}
    threads = server.documents.settings.preview.threads
    work_done = WorkDone(server, given.token())
    try:
        good = await last_good(server, uri)
        if good.stale:
            return answer | {"status": "error", "message": NOT_SAVED}
        await work_done.begin(f"Rendering {file_name(uri)}")

        def make(number: int, scene: int) -> Save:
            return Save(number, scene, straight, samples, threads, path)

        def hears(message: Tile | Progress) -> None:
            if isinstance(message, Progress):
                work_done.report(message.rows, message.of)

        ended = await server.previews.work(good.snapshot.analysis, make, hears)
        return answer | {"status": ended.status, "message": ended.message or None}
    except asyncio.CancelledError:
        return answer
    finally:
        work_done.end()


@server_request("m3d/preview/close")
def close(server: Server, params: Any) -> None:
    """The client shows a preview no longer."""
    server.previews.close(Given(params).text("preview"))


def primitives_at(ir: SceneIR, place: Span) -> tuple[Span, np.ndarray[tuple[int], np.dtype[np.int64]]] | None:
    """The text of the solid or light that holds a place, and the rows of its primitives; elsewhere, in a variable,
    the text of the innermost primitive, and the rows of all that were copied from it."""
    for table in ("solids", "lights"):
        spans = ir[table]["span"]
        (rows,) = np.nonzero((spans[:, 0] <= place[0]) & (place[1] <= spans[:, 1]))
        if rows.size:
            row = int(rows[0])
            first, many = int(ir[table]["first_primitive"][row]), int(ir[table]["primitive_count"][row])
            return _span(ir, table, row), np.arange(first, first + many, dtype=np.int64)
    spans = ir["primitives"]["span"]
    (rows,) = np.nonzero((spans[:, 0] <= place[0]) & (place[1] <= spans[:, 1]))
    if not rows.size:
        return None
    row = int(rows[np.argmin(spans[rows, 1] - spans[rows, 0])])
    (rows,) = np.nonzero((spans == spans[row]).all(axis=1))
    return _span(ir, "primitives", row), rows.astype(np.int64)


def _pixel(server: Server, given: Given) -> tuple[Shown | None, int, int]:
    """The picture that a pixel is of, if it has it, and its column and row. What a client shows may be a picture of
    another size, such as the one before: it then says which, and meant is what is at the same place."""
    shown = server.previews.shown(given.text("preview"))
    x, y = given.whole("x", 0), given.whole("y", 0)
    if shown is None:
        return None, x, y
    width, height = given.whole("width", 1, shown.width), given.whole("height", 1, shown.height)
    inside = x < width and y < height
    return (shown if inside else None), _middle(x, width, shown.width), _middle(y, height, shown.height)


def _middle(i: int, count: int, of: int) -> int:
    """Which of `of` equal parts the middle of the i-th of `count` lies in."""
    return (2 * i + 1) * of // (2 * count)


async def _now(server: Server, shown: Shown) -> Good:
    """The version that a picture was made of, as the client has its places."""
    document = server.documents.get(shown.snapshot.uri)
    text = shown.snapshot.text if document is None else document.text
    # To compare two long texts takes a while.
    return await asyncio.to_thread(Good, shown.snapshot, text is not shown.snapshot.text, text)


def _span(ir: SceneIR, table: str, row: int) -> Span:
    start, end = ir[table]["span"][row].tolist()
    return start, end
