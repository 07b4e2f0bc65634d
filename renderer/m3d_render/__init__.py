"""Pictures of compiled Mirage3D scenes, with straight rays or with rays bent by the atmosphere.

    import m3dc, m3d_render

    scene = m3dc.compile(source).ir
    picture = m3d_render.render(scene)                     # float32, rows x columns x 3, 0..1
    straight = m3d_render.render(scene, straight=True)
    m3d_render.write_picture("mirage.exr", picture)

    more = m3d_render.prepare(scene).render(aov=["depth", "path"])
    more.picture, more.layers["depth"], more.rays          # what else there is to know of a picture

`m3d_render.optics` traces ray paths without a picture.
"""

from m3d_render.options import Picture, Region, RenderOptions, Tile
from m3d_render.picture import PictureError, write_picture
from m3d_render.rendering import Cancelled, Prepared, Rays, Rendering, SceneError, prepare, render

__all__ = [
    "Cancelled",
    "Picture",
    "PictureError",
    "Prepared",
    "Rays",
    "Region",
    "RenderOptions",
    "Rendering",
    "SceneError",
    "Tile",
    "prepare",
    "render",
    "write_picture",
]
