"""What is being drawn for the client, and what it has been shown."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from typing import Any

from m3dc.analysis import Analysis

from ..snapshot import Snapshot
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
    ToWorker,
)
from .process import Process


@dataclass
class Job:
    """A picture that is being made. `hears` is told of its tiles, or of how far it is."""

    scene: int
    hears: Callable[[Painted | Progress], None]
    ended: asyncio.Future[Ended]


@dataclass
class Shown:
    """The last whole picture of a preview, of a `scene`, as the process that draws has it by its `number`."""

    number: int
    scene: int
    snapshot: Snapshot
    width: int
    height: int


@dataclass
class Preview:
    """A picture in the client: the request that draws it, if one does, and what it shows."""

    drawing: asyncio.Task[Any] | None = None
    shown: Shown | None = None


@dataclass
class Previews:
    """All previews. All methods are called from the message loop."""

    _process: Process | None = None
    _numbers: count[int] = field(default_factory=lambda: count(1))
    _previews: dict[str, Preview] = field(default_factory=dict[str, Preview])
    _scenes: dict[Analysis, int] = field(default_factory=dict[Analysis, int])
    _jobs: dict[int, Job] = field(default_factory=dict[int, Job])
    _questions: dict[int, asyncio.Future[Any]] = field(default_factory=dict[int, asyncio.Future[Any]])

    # --- previews by name ---------------------------------------------------------------------------------------------

    def begin(self, name: str) -> None:
        """The current task draws a preview from here on; the one before that did is cancelled."""
        preview = self._previews.setdefault(name, Preview())
        if preview.drawing is not None:
            preview.drawing.cancel()
        preview.drawing = asyncio.current_task()

    def end(self, name: str, shown: Shown | None) -> None:
        """The current task draws a preview no longer; it may leave a picture. Whether it still was to."""
        preview = self._previews.get(name)
        if preview is None or preview.drawing is not asyncio.current_task():
            if shown is not None:
                self._forget([shown.number])
            return
        preview.drawing = None
        if shown is not None:
            before, preview.shown = preview.shown, shown
            self._forget([before.number] if before is not None else [])

    def shown(self, name: str) -> Shown | None:
        preview = self._previews.get(name)
        return None if preview is None else preview.shown

    def close(self, name: str) -> None:
        """The client shows a preview no longer."""
        preview = self._previews.pop(name, None)
        if preview is None:
            return
        if preview.drawing is not None:
            preview.drawing.cancel()
        self._forget([preview.shown.number] if preview.shown is not None else [])

    # --- the process --------------------------------------------------------------------------------------------------

    async def work(
        self, analysis: Analysis, make: Callable[[int, int], Draw | Save], hears: Callable[[Painted | Progress], None]
    ) -> Ended:
        """Have a picture made of a document's scene; `make` makes the message of the picture's number and the scene's.
        Cancelling this cancels that."""
        process = self._running()
        number, scene = next(self._numbers), self._scene(process, analysis)
        job = self._jobs[number] = Job(scene, hears, asyncio.get_running_loop().create_future())
        process.send(make(number, scene))
        try:
            return await job.ended
        except asyncio.CancelledError:
            self._tell(Cancel(number))
            if job.ended.done():
                self._forget([number])
            raise
        finally:
            self._jobs.pop(number, None)
            self._forget([])

    async def ask(self, shown: Shown, question: Pick | Mask | Ray) -> Any:
        """The answer to a question about a picture; None if there is none."""
        if self._process is None:
            return None
        number = next(self._numbers)
        answer = self._questions[number] = asyncio.get_running_loop().create_future()
        self._process.send(Ask(number, shown.number, question))
        try:
            return await answer
        finally:
            self._questions.pop(number, None)

    def stop(self) -> None:
        """The server ends."""
        process, self._process = self._process, None
        if process is not None:
            process.close()

    def _running(self) -> Process:
        if self._process is None:
            self._process = Process(self._hear, self._died)
        return self._process

    def _scene(self, process: Process, analysis: Analysis) -> int:
        """The number of a scene, which is sent if the process has not got it. A large one takes a while, in which it
        may turn out that nobody wants it any more."""
        number = self._scenes.get(analysis)
        if number is None:
            number = self._scenes[analysis] = next(self._numbers)
            process.send_if(lambda: Scene(number, analysis.ir) if analysis in self._scenes else None)
        return number

    def _forget(self, pictures: list[int]) -> None:
        """Have the process forget pictures, and all scenes that no picture is or will be made of."""
        shown = (preview.shown.scene for preview in self._previews.values() if preview.shown is not None)
        used = {*shown, *(job.scene for job in self._jobs.values())}
        unused = [analysis for analysis, number in self._scenes.items() if number not in used]
        numbers = (*pictures, *(self._scenes.pop(analysis) for analysis in unused))
        if numbers:
            self._tell(Forget(numbers))

    def _tell(self, message: ToWorker) -> None:
        if self._process is not None:
            self._process.send(message)

    def _hear(self, message: FromWorker) -> None:
        if isinstance(message, Answer):
            if (answer := self._questions.get(message.number)) is not None and not answer.done():
                answer.set_result(message.value)
            return
        job = self._jobs.get(message.number)
        if job is not None and job.ended.done():
            job = None
        match message:
            case Ended():
                if job is not None:
                    job.ended.set_result(message)
                else:
                    self._forget([message.number])
            case Painted() | Progress():
                if job is not None:
                    job.hears(message)
                if isinstance(message, Painted):
                    self._tell(Taken(message.number))

    def _died(self, why: str) -> None:
        """Nobody waits for the process any longer; the next request starts another."""
        self._process = None
        self._scenes.clear()
        for preview in self._previews.values():
            preview.shown = None
        for number, job in self._jobs.items():
            if not job.ended.done():
                job.ended.set_result(Ended(number, "error", why))
        for answer in self._questions.values():
            if not answer.done():
                answer.set_result(None)
