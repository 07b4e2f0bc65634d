"""What the server and the process that draws tell each other. Pictures, scenes and questions have numbers, which the
server gives."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import SceneIR

from . import wire

if TYPE_CHECKING:
    from m3d_render import RenderOptions


class Scene(NamedTuple):
    """A scene that pictures will be made of."""

    number: int
    ir: SceneIR


class Draw(NamedTuple):
    """Make a picture of a scene, show it while it becomes known, and keep it. `square` pixels undo the scene's ASPECT;
    its tiles name the client's `preview` and `job`, and the `version` of the text."""

    number: int
    scene: int
    width: int
    height: int
    options: RenderOptions
    square: bool
    preview: str
    job: int | None
    version: int


class Save(NamedTuple):
    """Make a picture of a scene as large as the scene says, and write it to a file."""

    number: int
    scene: int
    options: RenderOptions
    path: str


class Cancel(NamedTuple):
    """Give up a Draw or a Save."""

    number: int


class Taken(NamedTuple):
    """A tile has gone to the client."""

    number: int


class Forget(NamedTuple):
    """Scenes and pictures that nobody will ask for again."""

    numbers: tuple[int, ...]


class Pick(NamedTuple):
    """What does a pixel of a picture show?"""

    x: int
    y: int


class Mask(NamedTuple):
    """Where does a picture show some rows of `primitives`?"""

    primitives: NDArray[np.int64]


class Ray(NamedTuple):
    """Where does the ray through a pixel go?"""

    x: int
    y: int


class Ask(NamedTuple):
    """A question about a finished picture."""

    number: int
    picture: int
    question: Pick | Mask | Ray


ToWorker: TypeAlias = Scene | Draw | Save | Cancel | Taken | Forget | Ask


class Painted(NamedTuple):
    """A part of a picture has become known."""

    number: int
    tile: wire.Tile


class Progress(NamedTuple):
    """How much of a Save is done."""

    number: int
    rows: int
    of: int


class Ended(NamedTuple):
    """A Draw or Save has come to its end: `"done"`, `"cancelled"`, or `"error"` with a message."""

    number: int
    status: wire.Status
    message: str = ""
    seconds: float = 0.0
    bent: bool = False


class Answer(NamedTuple):
    """The answer to a question, as JSON; None if there is none."""

    number: int
    value: Any


FromWorker: TypeAlias = Painted | Progress | Ended | Answer
