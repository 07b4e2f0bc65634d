"""What a picture file says of its picture."""

from __future__ import annotations

from m3d_render import _kernel
from m3d_render.rendering import Rendering
from m3dc.ir import SceneIR


def metadata(ir: SceneIR, rendering: Rendering, scene: str) -> dict[str, str]:
    """Attributes for `write_picture`, `scene` being what to call the scene. TIFF keeps the first two alone."""
    view = ir.scene.view
    described = {
        "mirage3d:scene": scene,
        "mirage3d:mirage": "on" if rendering.bent else "off",
        "mirage3d:from": _vector(view.eye),
        "mirage3d:to": _vector(view.target),
        "mirage3d:fov": f"{view.fov:g}",
        "mirage3d:tilt": f"{view.tilt:g}",
        "mirage3d:size": f"{rendering.width} {rendering.height}",
    }
    part = rendering.region
    region = (part.top, part.left, part.bottom, part.right)
    if region != (0, 0, rendering.height - 1, rendering.width - 1):
        described["mirage3d:region"] = " ".join(map(str, region))
    sentence = "; ".join(f"{key.removeprefix('mirage3d:')} {value}" for key, value in described.items())
    return {
        "Software": f"m3d-render {_kernel.VERSION}",
        "ImageDescription": sentence.removeprefix("scene "),
        **described,
    }


def _vector(values: tuple[float, float, float]) -> str:
    return " ".join(f"{value:.10g}" for value in values)
