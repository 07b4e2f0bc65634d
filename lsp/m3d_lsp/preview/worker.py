"""The process that draws: `python -m m3d_lsp.preview.worker`, talked to over its standard input and output.

It ends when its input does, whatever the server died of.
"""

from __future__ import annotations

import base64
import contextlib
import logging
import os
import signal
import sys
import time
from collections.abc import Callable
from functools import cached_property, partial
from io import BufferedIOBase
from pathlib import Path
from threading import Lock, Thread
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from m3d_render import Cancelled, PictureError, Prepared, SceneError, prepare, write_picture
from m3d_render.command import CommandError, check_folder
from m3d_render.metadata import metadata
from m3d_render.picture import check_suffix
from m3dc.ir import SceneIR, with_square_pixels

from .channel import Channel
from .finished import LAYERS, Finished
from .messages import (
    Answer,
    Ask,
    Cancel,
    Draw,
    Ended,
    Forget,
    FromWorker,
    Mask,
    Painted,
    Pick,
    Progress,
    Ray,
    Save,
    Scene,
    Taken,
)
from .tiles import Tiles
from .wire import Tile

log = logging.getLogger(__name__)

# How much this process stands back for others: whoever types comes first.
NICENESS = 5

# A picture that is being written when the server ends is given so long.
LAST_WORDS_S = 2.0


class Unprepared:
    """A scene whose acceleration structure is built when it is first drawn. One at a time is built, so that scenes
    which nobody wants any more by then never are."""

    _building = Lock()

    def __init__(self, ir: SceneIR) -> None:
        self._ir = ir
        self._prepared: Prepared | None = None

    @cached_property
    def square(self) -> Unprepared:
        """The same scene seen with square pixels: its ASPECT is undone."""
        ir = with_square_pixels(self._ir)
        return self if ir is self._ir else Unprepared(ir)

    def prepared(self, wanted: Callable[[], bool]) -> Prepared | None:
        """The scene in the kernel; None if it is not wanted any more. Raises SceneError."""
        with self._building:
            if self._prepared is None and wanted():
                self._prepared = prepare(self._ir)
            return self._prepared


class Worker:
    """Draws what it is told to, each picture in a thread of its own."""

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        self._scenes: dict[int, Unprepared] = {}
        self._pictures: dict[int, Finished] = {}
        self._tiles: dict[int, Tiles] = {}
        self._threads: list[Thread] = []

    def run(self) -> None:
        """Do what messages say until there are no more."""
        with contextlib.suppress(EOFError, OSError):
            while True:
                self._do(self._channel.receive())
        for tiles in list(self._tiles.values()):
            tiles.cancel()
        until = time.monotonic() + LAST_WORDS_S
        for thread in self._threads:
            thread.join(max(0.0, until - time.monotonic()))

    def _do(self, message: Any) -> None:
        match message:
            case Scene():
                self._scenes[message.number] = Unprepared(message.ir)
            case Draw() | Save():
                self._start(message)
            case Cancel():
                if (tiles := self._tiles.get(message.number)) is not None:
                    tiles.cancel()
            case Taken():
                if (tiles := self._tiles.get(message.number)) is not None:
                    tiles.taken()
            case Forget():
                for number in message.numbers:
                    self._scenes.pop(number, None)
                    self._pictures.pop(number, None)
            case Ask():
                self._channel.send(Answer(message.number, self._answer(message)))
            case _:
                log.error("unknown message %r", message)

    def _start(self, job: Draw | Save) -> None:
        tiles = self._tiles[job.number] = Tiles(partial(self._send_tile, job))
        scene = self._scenes.get(job.scene)
        if scene is not None and isinstance(job, Draw) and job.square:
            scene = scene.square
        thread = Thread(target=self._work, args=(job, scene, tiles), daemon=True)
        self._threads = [other for other in self._threads if other.is_alive()] + [thread]
        thread.start()

    def _send_tile(self, job: Draw | Save, top: int, step: int, pixels: NDArray[np.uint8]) -> None:
        assert isinstance(job, Draw)
        rows, columns, _ = pixels.shape
        tile: Tile = {
            "preview": job.preview,
            "job": job.job,
            "version": job.version,
            "width": job.width,
            "height": job.height,
            "top": top,
            "step": step,
            "columns": columns,
            "rows": rows,
            "pixels": base64.b64encode(pixels.tobytes()).decode("ascii"),
        }
        self._channel.send(Painted(job.number, tile))

    def _work(self, job: Draw | Save, scene: Unprepared | None, tiles: Tiles) -> None:
        """Draw or save; say how it ended, whatever happens."""
        started = time.perf_counter()
        try:
            prepared = None if scene is None else scene.prepared(lambda: not tiles.cancelled())
            if prepared is None:
                ended = Ended(job.number, "cancelled")
            elif isinstance(job, Draw):
                ended = self._draw(job, prepared, tiles)
            else:
                ended = self._save(job, prepared, tiles)
        except Cancelled:
            ended = Ended(job.number, "cancelled")
        except (SceneError, PictureError, CommandError) as error:
            ended = Ended(job.number, "error", str(error))
        except MemoryError:
            ended = Ended(job.number, "error", "the picture does not fit in memory; a smaller one may")
        except BaseException as error:  # whatever it is, the next job is done
            log.exception("%s failed", type(job).__name__)
            ended = Ended(job.number, "error", f"the renderer failed: {error}; the server's log says more")
        del self._tiles[job.number]
        self._tell(ended._replace(seconds=time.perf_counter() - started))

    def _draw(self, job: Draw, prepared: Prepared, tiles: Tiles) -> Ended:
        rendering = prepared.render(
            aov=LAYERS,
            **(job.options | {"width": job.width, "height": job.height, "tiles": tiles.add, "cancel": tiles.cancelled}),
        )
        if not tiles.finish():
            return Ended(job.number, "cancelled")
        self._pictures[job.number] = Finished(prepared, rendering)
        return Ended(job.number, "done", bent=rendering.bent)

    def _save(self, job: Save, prepared: Prepared, tiles: Tiles) -> Ended:
        path = Path(job.path)
        check_suffix(path)
        check_folder(path)

        def progress(rows: int, of: int) -> None:
            self._tell(Progress(job.number, rows, of))

        rendering = prepared.render(**(job.options | {"progress": progress, "cancel": tiles.cancelled}))
        part = rendering.region
        write_picture(
            path,
            rendering.picture,
            metadata(prepared.ir, rendering, prepared.ir.source),
            origin=(part.left, part.top),
            whole=(rendering.width, rendering.height),
        )
        return Ended(job.number, "done", bent=rendering.bent)

    def _answer(self, ask: Ask) -> Any:
        """The answer to a question; None about a picture that is gone, or if it can not be found."""
        picture = self._pictures.get(ask.picture)
        if picture is None:
            return None
        try:
            match ask.question:
                case Pick(x, y):
                    return picture.pick(x, y)
                case Mask(primitives):
                    return picture.mask(primitives)
                case Ray(x, y):
                    return picture.ray(x, y)
        except Exception:
            log.exception("%r failed", ask)
            return None

    def _tell(self, message: FromWorker) -> None:
        # That nobody listens any more, `run` finds out too.
        with contextlib.suppress(OSError):
            self._channel.send(message)


def main() -> None:
    """Run the process."""
    logging.basicConfig(format="m3d-lsp preview: %(levelname)s %(name)s: %(message)s")
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # What anybody prints must not get among the messages.
    writer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    Worker(Channel(cast("BufferedIOBase", sys.stdin.buffer), writer)).run()
    os._exit(0)  # threads that still draw need not be waited for


if __name__ == "__main__":
    main()
