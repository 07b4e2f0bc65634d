"""`m3d/dump`: the scene as `m3dc --dump` prints it, each line with the place of the text that it tells of; or of the
solid or light under the cursor alone.

One sees what a scene resolves to, beside it and while it is edited, and can go from either to the other.
"""

from __future__ import annotations

import asyncio
from itertools import islice
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from m3dc.ir import SceneIR
from m3dc.ir.dump import Line, lines, object_lines

from ..given import Given
from ..good import Good, last_good
from ..registry import server_request
from ..text import Span

if TYPE_CHECKING:
    from ..server import Server

# What an editor can still show, and a person might still read.
MOST_ROWS = 1_000
MOST_LINES = 50_000


@server_request("m3d/dump")
async def dump(server: Server, params: Any) -> SimpleNamespace:
    """The dump of a document, of its last version without errors."""
    given = Given(params)
    position = given.position()
    good = await last_good(server, given.uri())
    return await asyncio.to_thread(_dump, good, None if position is None else good.place(position))


def _dump(good: Good, place: Span | None) -> SimpleNamespace:
    ir = good.snapshot.analysis.ir
    if place is None:
        shown = list(islice(lines(ir, MOST_ROWS), MOST_LINES + 1))
    else:
        span = object_at(ir, place)
        shown = [] if span is None else list(islice(object_lines(ir, span, MOST_ROWS), MOST_LINES + 1))
    if len(shown) > MOST_LINES:
        shown[MOST_LINES] = Line("... and more, which m3dc --dump prints")
    # The scene's own blocks stand nowhere where they are not written.
    places: dict[Span | None, Any] = {None: None, (0, 0): None}
    places |= {span: good.range(span) for line in shown if (span := line.span) is not None and span not in places}
    return SimpleNamespace(
        version=good.snapshot.version,
        stale=good.stale,
        text="\n".join(line.text for line in shown),
        ranges=[places[line.span] for line in shown],
    )


def object_at(ir: SceneIR, place: Span) -> Span | None:
    """The text of the solid or light that holds a place, or that ends before it."""
    for table in ("solids", "lights"):
        for start, end in ir[table]["span"].tolist():
            if start <= place[0] and place[1] <= end:
                return start, end
    return None
