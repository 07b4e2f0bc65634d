"""What is said about previews. Made by `make generate` from protocol/preview.toml.

Answers and notifications are dictionaries, as JSON has them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, TypedDict

from lsprotocol import types

from ..given import Given

if TYPE_CHECKING:  # the server's process does not load the renderer
    from m3d_render import RenderOptions

Optics: TypeAlias = Literal["straight", "mirage"]
"""Whether the air bends light. A scene without MIRAGE is the same with both."""

Status: TypeAlias = Literal["done", "cancelled", "error"]
"""How a request ended. It is cancelled by a newer request for the preview, a cancellation or `close`."""

End: TypeAlias = Literal["ground", "top", "range", "segments", "hit"]
"""How a ray ends: at a surface, or as `m3d-rays` says. Without MIRAGE the range is that of the scene's things."""


class Tile(TypedDict):
    """Full rows of a picture, each pixel for a square of `step` picture pixels."""

    preview: str
    job: int | None
    version: int
    width: int
    height: int
    top: int
    step: int
    columns: int
    rows: int
    pixels: str


class Rendered(TypedDict):
    """What became of a picture."""

    status: Status
    version: int
    stale: bool
    width: int
    height: int
    aspect: float | None
    ownWidth: int
    ownHeight: int
    seconds: float | None
    bent: bool
    message: str | None


class Path(TypedDict):
    """The ray through a pixel."""

    length: float | None
    arcs: int


class Picked(TypedDict):
    """What a pixel shows."""

    version: int
    range: dict[str, Any]
    solidRange: dict[str, Any]
    solid: int
    primitive: int
    color: list[float | None]
    position: list[float | None]
    normal: list[float | None]
    depth: float | None
    uv: list[float | None]
    path: Path


class Mask(TypedDict):
    """Where the picture shows the solid or light whose text is at a position."""

    version: int
    width: int
    height: int
    runs: list[list[int]]
    range: dict[str, Any]


class Ray(TypedDict):
    """The ray through a pixel, in the vertical plane through it and the eye. A straight one has two points."""

    points: list[list[float | None]]
    end: End


class Saved(TypedDict):
    """What became of a picture's file."""

    status: Status
    path: str
    message: str | None


class RenderParams(NamedTuple):
    """The parameters of `m3d/preview/render`."""

    uri: str
    preview: str
    optics: Optics
    job: int | None
    max_width: int
    max_height: int
    fill: bool
    options: RenderOptions

    @classmethod
    def read(cls, params: Any) -> RenderParams:
        """Raises JsonRpcInvalidParams."""
        given = Given(params)
        return cls(
            uri=given.uri(),
            preview=given.text("preview"),
            optics=given.one_of("optics", ("straight", "mirage")),
            job=given.whole("job", 1, 0) or None,
            max_width=given.whole("maxWidth", 1, 65535),
            max_height=given.whole("maxHeight", 1, 65535),
            fill=given.flag("fill"),
            options={
                "samples": given.whole("samples", 1, 1),
            },
        )


class PickParams(NamedTuple):
    """The parameters of `m3d/preview/pick`."""

    preview: str
    x: int
    y: int
    width: int | None
    height: int | None

    @classmethod
    def read(cls, params: Any) -> PickParams:
        """Raises JsonRpcInvalidParams."""
        given = Given(params)
        return cls(
            preview=given.text("preview"),
            x=given.whole("x", 0),
            y=given.whole("y", 0),
            width=given.whole("width", 1, 0) or None,
            height=given.whole("height", 1, 0) or None,
        )


class MaskParams(NamedTuple):
    """The parameters of `m3d/preview/mask`."""

    preview: str
    position: types.Position | None

    @classmethod
    def read(cls, params: Any) -> MaskParams:
        """Raises JsonRpcInvalidParams."""
        given = Given(params)
        return cls(
            preview=given.text("preview"),
            position=given.position("position"),
        )


class RayParams(NamedTuple):
    """The parameters of `m3d/preview/ray`."""

    preview: str
    x: int
    y: int
    width: int | None
    height: int | None

    @classmethod
    def read(cls, params: Any) -> RayParams:
        """Raises JsonRpcInvalidParams."""
        given = Given(params)
        return cls(
            preview=given.text("preview"),
            x=given.whole("x", 0),
            y=given.whole("y", 0),
            width=given.whole("width", 1, 0) or None,
            height=given.whole("height", 1, 0) or None,
        )


class SaveParams(NamedTuple):
    """The parameters of `m3d/preview/save`."""

    uri: str
    optics: Optics
    path: str
    work_done_token: types.ProgressToken | None
    options: RenderOptions

    @classmethod
    def read(cls, params: Any) -> SaveParams:
        """Raises JsonRpcInvalidParams."""
        given = Given(params)
        return cls(
            uri=given.uri(),
            optics=given.one_of("optics", ("straight", "mirage")),
            path=given.text("path"),
            work_done_token=given.token(),
            options={
                "samples": given.whole("samples", 1, 1),
            },
        )


class CloseParams(NamedTuple):
    """The parameters of `m3d/preview/close`."""

    preview: str

    @classmethod
    def read(cls, params: Any) -> CloseParams:
        """Raises JsonRpcInvalidParams."""
        given = Given(params)
        return cls(
            preview=given.text("preview"),
        )


RENDER = "m3d/preview/render"
PICK = "m3d/preview/pick"
MASK = "m3d/preview/mask"
RAY = "m3d/preview/ray"
SAVE = "m3d/preview/save"
CLOSE = "m3d/preview/close"
TILE = "m3d/preview/tile"
