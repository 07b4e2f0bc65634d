"""A scene put before a camera with pyvista: what is drawn and how, and what is where in the picture."""

from __future__ import annotations

import io
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from m3d_render.geometry import Triangles
from m3d_render.rendering import SceneError
from m3d_render.view.axes import axes
from m3d_render.view.bodies import bodies, primitive_colors
from m3d_render.view.description import describe
from m3d_render.view.fan import fan
from m3d_render.view.ground import ground
from m3d_render.view.marks import box, extent_box, frustum, light_marks
from m3d_render.view.opening import Opened
from m3d_render.view.viewpoint import LEAST_VERTICAL, MOST_VERTICAL, From, fitting_vertical, viewpoint

Points = NDArray[np.float64]

LAYERS = ("rays", "camera", "lights", "extents", "ground", "axes")
"""What can be shown or hidden, beside the solids."""

_STEEPEST, _INCLINED = 0.9995, 0.04  # the sine and the tangent of 2 degrees from the vertical: turning ends at 1
_BACKGROUND = "#a9b3ba"  # black and white things are seen on it
_INK = "#101418"
_PAPER, _PAPER_OPACITY = "#dde3e8", 0.6  # under writing
_ASIDE = "  "  # between a point and its name
_CAMERA = "#ffd23c"
_EXTENTS = "#ffffff"
_PICKED = "#ff2fd0"
_ANGLES = "turbo"
_WIDE = 10  # degrees: the angles of a fan that is wider are in degrees, else in arcminutes
_GRID_DARK, _GRID_LIGHT = 0.6, 0.35  # factor of a light plane's colour; share of white in a dark one's
# A light at the eye hardly reaches what is seen at a grazing angle, as the ground is.
_SHADING = {"solids": {"ambient": 0.45, "diffuse": 0.55}, "ground": {"ambient": 1.0, "diffuse": 0.0}}


class Stage:
    """One scene before one camera. `vertical` is how many times heights are stretched: as asked for, or as it shows
    something from where it is looked. `notes` are what could not be shown and why."""

    def __init__(
        self,
        pyvista: Any,
        *,
        size: tuple[int, int],
        off_screen: bool,
        rays: int,
        hidden: Iterable[str] = (),
        vertical: float | None = None,
        title: str = "m3d-view",
    ) -> None:
        self._pyvista = pyvista
        self.plotter: Any = pyvista.Plotter(
            off_screen=off_screen, window_size=list(size), lighting=None, title=title, theme=pyvista.themes.Theme()
        )
        self.plotter.add_light(pyvista.Light(light_type="headlight"))
        self.plotter.set_background(_BACKGROUND)
        # Lines without steps; solids keep their colours up to their edges.
        self.plotter.enable_anti_aliasing("msaa")
        self.vertical = 1.0 if vertical is None else vertical
        self._fitting = vertical is None
        self.notes: list[str] = []
        self._rays = rays
        self._hidden = set(hidden)
        self._wires = False
        self._opened: Opened | None = None
        self._actors: dict[str, list[Any]] = {}
        self._labels: dict[str, tuple[Points, list[str]]] = {}
        self._written: dict[str, Any] = {}
        self._solids: list[tuple[Any, Triangles]] = []
        self._looked: tuple[From, Any] | None = None

    # --- what is shown -----------------------------------------------------------------------------------------------

    def show(self, opened: Opened) -> None:
        """Shows a scene instead of the one before. The camera stays where it was moved to by hand."""
        stayed = self._stayed()
        self._clear()
        self._opened = opened
        self.notes = []
        self._add_solids(opened)
        self._add_ground(opened)
        self._add_marks(opened)
        self._add_axes(opened)
        self._add_rays(opened)
        self._stretch()
        if stayed is None:
            self.plotter.renderer.ResetCameraClippingRange()
        else:
            self.look(stayed)

    def toggle(self, layer: str) -> bool:
        """Shows or hides one of LAYERS; returns whether it is shown."""
        self._hidden ^= {layer}
        self._apply_visibility()
        return layer not in self._hidden

    def toggle_wires(self) -> None:
        """Shows solids as wireframes, or again as surfaces."""
        self._wires = not self._wires
        self._apply_visibility()

    def stretch(self, vertical: float) -> None:
        """Stretches heights so many times."""
        stayed = self._stayed()
        self._fitting = False
        before, self.vertical = self.vertical, float(np.clip(vertical, LEAST_VERTICAL, MOST_VERTICAL))
        self._stretch()
        if stayed is None:
            camera, factors = self.plotter.camera, np.array([1, 1, self.vertical / before])
            camera.position, camera.focal_point = camera.position * factors, camera.focal_point * factors
            self.plotter.renderer.ResetCameraClippingRange()
        else:
            self.look(stayed)

    def look(self, place: From) -> None:
        """Looks from the scene's camera, from above or from the side."""
        assert self._opened is not None
        width, height = self.plotter.window_size
        if self._fitting:
            vertical = fitting_vertical(self._opened.ir, place, width / height)
            if vertical != self.vertical:
                self.vertical = vertical
                self._stretch()
        found = viewpoint(self._opened.ir, place, width / height, self.vertical)
        camera = self.plotter.camera
        camera.position, camera.focal_point, camera.up = found.position, found.target, found.up
        camera.parallel_projection = found.half_height is not None
        if found.half_height is not None:
            camera.parallel_scale = found.half_height
        if found.angle is not None:
            camera.view_angle = found.angle
        self.plotter.camera_set = True
        self.plotter.renderer.ResetCameraClippingRange()
        self._looked = place, self._camera_state()

    def upright(self) -> None:
        """Makes the scene's z what is up for the camera, as turning it about the vertical needs. A camera that looks
        straight up or down is inclined a little for it, so that what was up in the picture stays so."""
        stayed = self._stayed()
        camera = self.plotter.camera
        ahead, up = np.array(camera.focal_point) - np.array(camera.position), np.array(camera.up)
        distance = float(np.linalg.norm(ahead))
        if abs(ahead[2]) > _STEEPEST * distance:
            ahead = ahead / distance - np.sign(ahead[2]) * _INCLINED * up
            camera.position = np.array(camera.focal_point) - distance * ahead / np.linalg.norm(ahead)
        camera.up = (0.0, 0.0, 1.0)
        if stayed is not None:
            self._looked = stayed, self._camera_state()

    def _stayed(self) -> From | None:
        """From where it is looked, unless the camera was moved by hand since."""
        return self._looked[0] if self._looked is not None and self._looked[1] == self._camera_state() else None

    def _camera_state(self) -> Any:
        camera = self.plotter.camera
        return camera.position, camera.focal_point, camera.up, camera.view_angle, camera.parallel_scale

    def say(self, text: str, where: str = "upper_left", *, alarm: bool = False) -> None:
        """Writes lines into a corner of the picture, instead of what stood there; on the right in columns."""
        self.plotter.remove_actor(where, reset_camera=False, render=False)
        if not text:
            return
        lines = text.splitlines()
        width = max(len(line) for line in lines)
        actor = self.plotter.add_text(
            "\n".join(line.ljust(width) for line in lines) if where.endswith("right") else text,
            position=where,
            font_size=9,
            color="#a00000" if alarm else _INK,
            font="courier" if where.endswith("right") else "arial",
            name=where,
            render=False,
        )
        actor.prop.background_color = _PAPER
        actor.prop.background_opacity = _PAPER_OPACITY

    def photograph(self, suffix: str) -> bytes:
        """The bytes of a picture's file, in the format that the suffix names."""
        from PIL import Image  # pyvista brings it

        pixels: Any = self.plotter.screenshot(None, return_img=True)
        file = io.BytesIO()
        Image.fromarray(np.asarray(pixels)).save(file, format=Image.registered_extensions()[suffix.lower()])
        return file.getvalue()

    # --- what is where -----------------------------------------------------------------------------------------------

    def pick(self, column: int, row: int) -> int | None:
        """The row of `primitives` that is seen at a pixel, counted from the top left; None where there is none. A box
        is drawn about it."""
        picker = self._pyvista._vtk.vtkCellPicker()
        picker.SetTolerance(0)
        picker.PickFromListOn()
        for actor, _ in self._solids:
            if actor.GetVisibility():
                picker.AddPickList(actor)
        self._remove("picked")
        if not picker.Pick(column, self.plotter.window_size[1] - 1 - row, 0, self.plotter.renderer):
            return None
        found = picker.GetActor()
        mesh = next(mesh for actor, mesh in self._solids if actor is found)
        primitive = int(mesh.primitives[picker.GetCellId()])
        corners = mesh.points[mesh.corners[mesh.primitives == primitive]].reshape(-1, 3)
        self._add_lines("picked", box(corners.min(axis=0), corners.max(axis=0)), _PICKED, width=2.5)
        self._stretch_actors("picked")
        return primitive

    def describe(self, primitive: int) -> str:
        """What there is to say of a row of `primitives`."""
        assert self._opened is not None
        return describe(self._opened, primitive)

    # --- layers ------------------------------------------------------------------------------------------------------

    def _add_solids(self, opened: Opened) -> None:
        colors = _bytes(primitive_colors(opened.ir))
        for mesh in bodies(opened.ir):
            self._add_mesh("solids", mesh, colors)

    def _add_ground(self, opened: Opened) -> None:
        made = ground(opened.ir)
        if not len(made.patches.corners):
            return
        colors = primitive_colors(opened.ir)
        self._add_mesh("ground", made.patches, _bytes(colors))
        # Things that lie on the ground, or nearly, are drawn over it.
        mapper = self._actors["ground"][0].mapper
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2)
        mean = float(colors[made.patches.primitives].mean())
        shade = _GRID_DARK * mean if mean > 0.4 else mean + _GRID_LIGHT * (1 - mean)
        self._add_lines("ground", made.lines, (shade,) * 3, width=1)
        self.notes.append(f"the ground's lines are {made.step:g}{_unit(opened)} apart")

    def _add_marks(self, opened: Opened) -> None:
        self._add_lines("camera", frustum(opened.ir), _CAMERA, width=2)
        eye = np.array([opened.ir.scene.view.eye])
        self._add_points("camera", eye, _CAMERA)
        self._labels["camera"] = eye, [f"{_ASIDE}camera"]
        self._add_lines("extents", extent_box(opened.ir), _EXTENTS, width=1.5)
        lights = light_marks(opened.ir)
        if lights:
            self._labels["lights"] = (
                np.array([mark.source for mark in lights]),
                [f"{_ASIDE}{mark.name}" for mark in lights],
            )
        for mark in lights:
            self._add_lines("lights", mark.lines, tuple(mark.color), width=2)
            self._add_points("lights", mark.source[None], tuple(mark.color))

    def _add_axes(self, opened: Opened) -> None:
        made = axes(opened.ir)
        self._add_lines("axes", made.lines, _INK, width=1.5)
        self._add_points("axes", made.ticks, _INK, size=6)
        self._labels["axes"] = made.labels, made.texts

    def _add_rays(self, opened: Opened) -> None:
        if not self._rays:
            return
        try:
            made = fan(opened.ir, self._rays)
        except SceneError as error:
            self.notes.append(f"no rays: {error}")
            return
        lengths = [len(curve) for curve in made.curves]
        firsts = np.cumsum([0, *lengths])
        cells = [np.r_[n, np.arange(first, first + n)] for n, first in zip(lengths, firsts, strict=False)]
        lines = self._pyvista.PolyData(np.concatenate(made.curves), lines=np.concatenate(cells))
        degrees = np.degrees(made.angles)
        wide = float(np.ptp(degrees)) > _WIDE
        title = f"above the horizontal, {'degrees' if wide else 'arcminutes'}"
        lines.cell_data[title] = degrees if wide else 60 * degrees
        bar = {
            "title": title,
            "n_labels": 5,
            "fmt": "%.3g",
            "color": _INK,
            "height": 0.1,
            "width": 0.34,
        }
        bar |= {"position_x": 0.33, "position_y": 0.02, "title_font_size": 13, "label_font_size": 12}
        actor = self._add("rays", lines, scalars=title, cmap=_ANGLES, line_width=1, lighting=False, scalar_bar_args=bar)
        assert actor is not None
        self._actors["rays"].append(self.plotter.scalar_bars[title])

    def _add_mesh(self, layer: str, mesh: Triangles, colors: NDArray[np.uint8]) -> None:
        if not len(mesh.corners):
            return
        data = self._pyvista.PolyData.from_regular_faces(mesh.points, mesh.corners)
        data.cell_data["color"] = colors[mesh.primitives]
        if mesh.normals is not None:
            data.point_data.active_normals = mesh.normals
        actor = self._add(layer, data, scalars="color", rgb=True, **_SHADING[layer])
        if mesh.normals is not None:
            actor.prop.SetInterpolationToPhong()
        self._solids.append((actor, mesh))

    def _add_lines(self, layer: str, lines: Points, color: Any, *, width: float) -> None:
        if len(lines):
            data = self._pyvista.line_segments_from_points(lines.reshape(-1, 3))
            self._add(layer, data, color=color, line_width=width, lighting=False, pickable=False)

    def _add_points(self, layer: str, points: Points, color: Any, *, size: int = 14) -> None:
        style = {"point_size": size, "render_points_as_spheres": True, "lighting": False, "pickable": False}
        self._add(layer, self._pyvista.PolyData(points), color=color, **style)

    def _add(self, layer: str, data: Any, **how: Any) -> Any:
        actor = self.plotter.add_mesh(
            data, reset_camera=False, render=False, remove_existing_actor=False, copy_mesh=False, **how
        )
        self._actors.setdefault(layer, []).append(actor)
        return actor

    def _remove(self, layer: str) -> None:
        for actor in self._actors.pop(layer, []):
            self.plotter.remove_actor(actor, reset_camera=False, render=False)

    def _clear(self) -> None:
        for title in list(self.plotter.scalar_bars.keys()):
            self.plotter.remove_scalar_bar(title, render=False)
        for layer in list(self._actors):
            self._remove(layer)
        for actor in self._written.values():
            self.plotter.remove_actor(actor, reset_camera=False, render=False)
        self._labels, self._written, self._solids = {}, {}, []

    # --- heights and what depends on them ----------------------------------------------------------------------------

    def _stretch(self) -> None:
        """Brings everything to the heights that are asked for."""
        for layer in self._actors:
            self._stretch_actors(layer)
        for layer, (points, texts) in self._labels.items():
            self._write(layer, points * [1, 1, self.vertical], texts)
        self._apply_visibility()

    def _stretch_actors(self, layer: str) -> None:
        for actor in self._actors.get(layer, []):
            if isinstance(actor, self._pyvista.Actor):
                actor.SetScale(1, 1, self.vertical)

    def _write(self, layer: str, points: Points, texts: list[str]) -> None:
        """Texts in the scene, all of one size, instead of those that the layer had; where they would hide one another,
        some are left out."""
        old = self._written.pop(layer, None)
        if old is not None:
            self.plotter.remove_actor(old, reset_camera=False, render=False)
        self._written[layer] = self.plotter.add_point_labels(
            points,
            texts,
            font_size=12,
            bold=False,
            text_color=_INK,
            shape_color=_PAPER,
            shape_opacity=_PAPER_OPACITY,
            margin=2,
            show_points=False,
            always_visible=True,
            reset_camera=False,
            render=False,
        )

    def _apply_visibility(self) -> None:
        for layer, actors in self._actors.items():
            for actor in actors:
                actor.SetVisibility(layer not in self._hidden)
        for layer, actor in self._written.items():
            actor.SetVisibility(layer not in self._hidden)
        for actor, _ in self._solids:
            actor.prop.style = "wireframe" if self._wires else "surface"


def _bytes(colors: Points) -> NDArray[np.uint8]:
    return np.rint(255 * colors).astype(np.uint8)


def _unit(opened: Opened) -> str:
    """Lengths are metres where there is an atmosphere."""
    return " m" if opened.ir.scene.mirage is not None else ""
