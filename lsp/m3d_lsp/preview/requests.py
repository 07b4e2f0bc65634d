"""`m3d/preview/...`: a picture of a document as it stands in the editor, and what its pixels are.

One sees a scene change as it is typed; can ask which statement made a pixel, and which pixels a statement makes; and
can follow the light that came to one.
"""

from __future__ import annotations

import asyncio
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from m3dc.ir import SceneIR, View

from ..documents import file_name
from ..good import Good, last_good
from ..registry import server_request
from ..text import Span
from . import wire
from .messages import Draw, Mask, Painted, Pick, Progress, Ray, Save
from .previews import Shown
from .progress import WorkDone

if TYPE_CHECKING:
    from m3d_render import RenderOptions

    from ..server import Server

# A picture with all that is kept of it takes 64 bytes a pixel.
MOST_PIXELS = 4_000_000

NOT_GOOD = "the scene has errors, and no earlier version without any is known; mend them to see a picture"
NOT_SAVED = "the scene has errors; mend them before saving its picture"


@server_request(wire.RENDER)
async def render(server: Server, params: Any) -> wire.Rendered:
    """A picture, notified in tiles while it is made."""
    asked = wire.RenderParams.read(params)
    most = asked.max_width, asked.max_height
    answer: wire.Rendered = {
        "status": "cancelled",
        "version": 0,
        "stale": False,
        "width": 0,
        "height": 0,
        "aspect": 1.0,
        "ownWidth": 0,
        "ownHeight": 0,
        "seconds": 0.0,
        "bent": False,
        "message": None,
    }
    previews = server.previews
    previews.begin(asked.preview)
    shown: Shown | None = None
    try:
        good = await last_good(server, asked.uri)
        snapshot, ir = good.snapshot, good.snapshot.analysis.ir
        answer["version"], answer["stale"] = snapshot.version, good.stale
        if not snapshot.analysis.ok:
            answer["status"], answer["message"] = "error", NOT_GOOD
            return answer
        view = ir.scene.view
        width, height = filling(view, *most) if asked.fill else fit(view.width, view.height, *most)
        answer["width"], answer["height"], answer["aspect"] = width, height, 1.0 if asked.fill else view.aspect
        answer["ownWidth"], answer["ownHeight"] = view.width, view.height

        def hears(message: Painted | Progress) -> None:
            if isinstance(message, Painted):
                server.protocol.notify(wire.TILE, message.tile)

        options = _options(server, asked)
        number = scene = 0

        def make(new_number: int, new_scene: int) -> Draw:
            nonlocal number, scene
            number, scene = new_number, new_scene
            its = asked.preview, asked.job, snapshot.version
            return Draw(number, scene, width, height, options, asked.fill, *its)

        ended = await previews.work(snapshot.analysis, make, hears)
        if ended.status == "done":
            shown = Shown(number, scene, snapshot, width, height)
        answer["status"], answer["message"] = ended.status, ended.message or None
        answer["seconds"], answer["bent"] = ended.seconds, ended.bent
        return answer
    except asyncio.CancelledError:
        return answer
    finally:
        previews.end(asked.preview, shown)


def fit(width: int, height: int, most_width: int, most_height: int) -> tuple[int, int]:
    """The size of a picture made smaller to fit, with its proportions kept."""
    share = min(1.0, most_width / width, most_height / height, math.sqrt(MOST_PIXELS / (width * height)))
    return max(1, round(width * share)), max(1, round(height * share))


def filling(view: View, most_width: int, most_height: int) -> tuple[int, int]:
    """The size of a picture with square pixels that is as large as fits, be it larger than the scene's own."""
    shape = view.height * view.aspect / view.width
    width = min(most_width, most_height / shape, math.sqrt(MOST_PIXELS / shape))
    return max(1, round(width)), max(1, round(width * shape))


def _options(server: Server, asked: wire.RenderParams | wire.SaveParams) -> RenderOptions:
    """What is asked of the renderer. Of the settings the number of threads counts, 0 being all."""
    threads = server.documents.settings.preview.threads or None
    return asked.options | {"straight": asked.optics == "straight", "threads": threads}


@server_request(wire.PICK)
async def pick(server: Server, params: Any) -> wire.Picked | None:
    """What a pixel shows, and which text made it."""
    shown, x, y = _pixel(server, wire.PickParams.read(params))
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
    return found | {
        "version": shown.snapshot.version,
        "range": good.range(_span(ir, "primitives", primitive)),
        "solidRange": good.range(_span(ir, owners, owner)),
    }


@server_request(wire.MASK)
async def mask(server: Server, params: Any) -> wire.Mask | None:
    """Where the picture shows what stands at a place of the text."""
    asked = wire.MaskParams.read(params)
    shown = server.previews.shown(asked.preview)
    if shown is None or asked.position is None:
        return None
    good = await _now(server, shown)
    found = primitives_at(shown.snapshot.analysis.ir, good.place(asked.position))
    if found is None:
        return None
    span, primitives = found
    runs = await server.previews.ask(shown, Mask(primitives))
    if runs is None:
        return None
    return {
        "version": shown.snapshot.version,
        "width": shown.width,
        "height": shown.height,
        "runs": runs,
        "range": good.range(span),
    }


@server_request(wire.RAY)
async def ray(server: Server, params: Any) -> wire.Ray | None:
    """The path of the light that a pixel shows, in the vertical plane through it and the eye."""
    shown, x, y = _pixel(server, wire.RayParams.read(params))
    return None if shown is None else await server.previews.ask(shown, Ray(x, y))


@server_request(wire.SAVE)
async def save(server: Server, params: Any) -> wire.Saved:
    """A picture at the scene's own size, in a file."""
    asked = wire.SaveParams.read(params)
    answer: wire.Saved = {"status": "cancelled", "path": asked.path, "message": None}
    options = _options(server, asked)
    work_done = WorkDone(server, asked.work_done_token)
    try:
        good = await last_good(server, asked.uri)
        if good.stale:
            answer["status"], answer["message"] = "error", NOT_SAVED
            return answer
        await work_done.begin(f"Rendering {file_name(asked.uri)}")

        def make(number: int, scene: int) -> Save:
            return Save(number, scene, options, asked.path)

        def hears(message: Painted | Progress) -> None:
            if isinstance(message, Progress):
                work_done.report(message.rows, message.of)

        ended = await server.previews.work(good.snapshot.analysis, make, hears)
        answer["status"], answer["message"] = ended.status, ended.message or None
        return answer
    except asyncio.CancelledError:
        return answer
    finally:
        work_done.end()


@server_request(wire.CLOSE)
def close(server: Server, params: Any) -> None:
    """The client shows a preview no longer."""
    server.previews.close(wire.CloseParams.read(params).preview)


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


def _pixel(server: Server, asked: wire.PickParams | wire.RayParams) -> tuple[Shown | None, int, int]:
    """The picture that a pixel is of, if it has it, and its column and row. What a client shows may be a picture of
    another size, such as the one before: it then says which, and meant is what is at the same place."""
    shown = server.previews.shown(asked.preview)
    x, y = asked.x, asked.y
    if shown is None:
        return None, x, y
    width, height = asked.width or shown.width, asked.height or shown.height
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
