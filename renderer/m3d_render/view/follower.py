"""Follows a scene file: notices that it was saved, and opens it anew beside the window's work."""

from __future__ import annotations

import os
from concurrent.futures import Executor, Future
from pathlib import Path

from m3d_render.command import USAGE_ERROR
from m3d_render.view.opening import Fault, Opened, open_scene

_Signature = tuple[int, int, int] | None


class Follower:
    """Asked now and then, tells what has become of a file since it was made. Make it before the file is first read, so
    that no change is missed."""

    def __init__(self, scene: Path, executor: Executor) -> None:
        self._scene = scene
        self._executor = executor
        self._seen = self._signature()
        self._work: Future[Opened | Fault] | None = None

    def poll(self) -> Opened | Fault | None:
        """The file as it has become; None where it is as it was, or is still being read. It does not wait."""
        if self._work is not None:
            if not self._work.done():
                return None
            found = self._work.result()
            self._work = None
            return found
        signature = self._signature()
        if signature == self._seen:
            return None
        self._seen = signature
        if signature is None:
            message = f"{self._scene} is not there any more"
            return Fault(message, f"m3d-view: {message}\n", USAGE_ERROR)
        self._work = self._executor.submit(open_scene, str(self._scene))
        return self.poll()

    def _signature(self) -> _Signature:
        """Changes whenever the file is written or replaced; None where there is none."""
        try:
            found = os.stat(self._scene)
        except OSError:
            return None
        return found.st_mtime_ns, found.st_size, found.st_ino
