"""Pictures of compiled Mirage3D scenes, with straight rays or with rays bent by the atmosphere.

    import m3dc, m3d_render

    scene = m3dc.compile(source).ir
    picture = m3d_render.render(scene)                     # float32, rows x columns x 3, 0..1
    straight = m3d_render.render(scene, straight=True)
    m3d_render.write_picture("mirage.exr", picture)

`m3d_render.optics` traces ray paths without a picture.
"""

from m3d_render.picture import PictureError, write_picture
from m3d_render.rendering import Cancelled, Rays, Rendering, SceneError, prepare, render

__all__ = [
    "Cancelled",
    "PictureError",
    "Rays",
    "Rendering",
    "SceneError",
    "prepare",
    "render",
    "write_picture",
]
