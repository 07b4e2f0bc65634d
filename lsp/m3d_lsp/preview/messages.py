"""What the server and the process that draws tell each other. Pictures, scenes and questions have numbers, which the
server gives."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import SceneIR


class Scene(NamedTuple):
    """A scene that pictures will be made of."""

    number: int
    ir: SceneIR


class Draw(NamedTuple):
    """Make a picture of a scene, show it while it becomes known, and keep it. `threads` 0 is all; `square` pixels undo
    the scene's ASPECT."""

    number: int
    scene: int
    straight: bool
    width: int
    height: int
    samples: int
    threads: int
    square: bool


class Save(NamedTuple):
    """Make a picture of a scene as large as the scene says, and write it to a file."""

    number: int
    scene: int
    straight: bool
    samples: int
    threads: int
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


class Tile(NamedTuple):
    """A part of a picture that has become known, in full rows from `top` on: every `step`-th pixel of every `step`-th
    row. `pixels` are rows x columns x (red, green, blue), a byte each."""

    number: int
    top: int
    step: int
    columns: int
    rows: int
    pixels: bytes


class Progress(NamedTuple):
    """How much of a Save is done."""

    number: int
    rows: int
    of: int


class Ended(NamedTuple):
    """A Draw or Save has come to its end: `"done"`, `"cancelled"`, or `"error"` with a message."""

    number: int
    status: str
    message: str = ""
    seconds: float = 0.0
    bent: bool = False


class Answer(NamedTuple):
    """The answer to a question, as JSON; None if there is none."""

    number: int
    value: Any


FromWorker: TypeAlias = Tile | Progress | Ended | Answer
