"""Wireframe pictures: the edges of everything in a scene, from its camera or from above. Thesis 7.2, command -W.

    from m3d_render import wireframe

    picture = wireframe.draw(scene)                                       # as m3d_render.render gives it
    text = wireframe.svg(wireframe.project(scene, hidden="remove"))       # with a group for each solid

Edges are projected with straight rays, whatever MIRAGE says. Nearer lines are drawn over farther ones; which parts of
them surfaces hide is asked of the ray tracer.
"""

from m3d_render.wireframe.drawing import HIDDEN, Drawing, Hidden, Strokes, project
from m3d_render.wireframe.edges import CIRCLE_STEPS, Edges, edges
from m3d_render.wireframe.marks import MARKS
from m3d_render.wireframe.picture import draw
from m3d_render.wireframe.raster import raster
from m3d_render.wireframe.svg import svg

__all__ = [
    "CIRCLE_STEPS",
    "HIDDEN",
    "MARKS",
    "Drawing",
    "Edges",
    "Hidden",
    "Strokes",
    "draw",
    "edges",
    "project",
    "raster",
    "svg",
]
