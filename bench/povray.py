"""The same scene for POV-Ray: its geometry, camera, lights and what its surfaces cost, in POV-Ray's own language.

    python -m bench.povray SCENE.m3d PICTURE.pov

The translation starts from the compiled scene, whose geometry is in world space. POV-Ray's camera is given by its own
four vectors, so our right-handed axes stand in its file unchanged. Its pixels are looked through at their middles,
ours from edge to edge (u = x/(width - 1)); its picture plane is wider by just that much, and a ray of one program is
a ray of the other. Colours are only alike: what counts is which surfaces are hit, mirror, and cast shadows.
"""

from __future__ import annotations

import argparse
import re
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import m3dc
from m3d_render.geometry import Triangles, shape_of
from m3dc.ir import Ambient, Haze, LightKind, PrimitiveKind, SceneIR, TextureKind, empty_tables

from .child import Run, run

FAR = 1e7  # metres to the sun, for POV-Ray, whose parallel lights have a place too


def program() -> str | None:
    """POV-Ray, where it is installed."""
    return shutil.which("povray")


@dataclass(frozen=True, slots=True)
class Rendered:
    """What POV-Ray says of a run. Seconds are processor time by its own count; `peak` is bytes of the process."""

    parse: float
    bounding: float
    trace: float
    rays: int
    shadow_tests: int
    peak: int
    cpu: float


def render(scene: Path, picture: Path, width: int, height: int) -> Rendered:
    """Render a translated scene with one thread and without antialiasing. Raises RunError."""
    return statistics(
        run(
            [
                program() or "povray",
                f"+I{scene}",
                f"+O{picture}",
                f"+W{width}",
                f"+H{height}",
                "+FP",
                "+WT1",
                "-A",
                "-D",
                "-V",
            ]
        )
    )


def statistics(ended: Run) -> Rendered:
    """The figures in what POV-Ray printed."""
    said = ended.output + ended.errors

    def seconds(title: str) -> float:
        found = re.search(rf"{title}:.*?\n\s*using .*? with ([0-9.]+) CPU-seconds", said)
        return float(found[1]) if found else 0.0

    def count(title: str) -> int:
        found = re.search(rf"{title}:\s*([0-9]+)", said)
        return int(found[1]) if found else 0

    return Rendered(
        parse=seconds("Parse Time"),
        bounding=seconds("Bounding Time"),
        trace=seconds("Trace Time"),
        rays=count("Rays"),
        shadow_tests=count("Shadow Ray Tests"),
        peak=ended.peak,
        cpu=ended.cpu,
    )


# --- translation --------------------------------------------------------------------------------------------------


def translate(ir: SceneIR, *, shadows: bool) -> Iterator[str]:
    """The lines of a POV-Ray scene."""
    scene, view = ir.scene, ir.scene.view
    width, height = view.width, view.height
    side = 2.0 * width / max(width - 1, 1)
    upright = 2.0 * height / width * view.aspect * height / max(height - 1, 1)
    yield "#version 3.7;"
    yield f"global_settings {{ assumed_gamma 1 adc_bailout 0 max_trace_level {scene.depth} }}"
    yield "camera {"
    yield f"  perspective location {_vector(view.eye)} direction {_vector(np.array(view.normal) * view.distance)}"
    yield f"  right {_vector(np.array(view.right) * side)} up {_vector(np.array(view.up) * upright)}"
    yield "}"
    yield from _sky(ir)
    for row in range(len(ir["lights"]["kind"])):
        yield from _light(ir, row, shadows)
    for row in range(len(ir["primitives"]["kind"])):
        if ir["primitives"]["solid"][row] >= 0:
            yield from _primitive(ir, row)


def write(ir: SceneIR, path: Path, *, shadows: bool) -> Path:
    """Write a scene for POV-Ray."""
    with path.open("w") as file:
        file.writelines(f"{line}\n" for line in translate(ir, shadows=shadows))
    return path


def _vector(values: Iterable[float]) -> str:
    return f"<{','.join(f'{value + 0.0:.10g}' for value in values)}>"


def _color(values: Iterable[float], factor: float = 1.0) -> str:
    return f"color rgb {_vector(value * factor for value in values)}"


def _sky(ir: SceneIR) -> Iterator[str]:
    scene, sky = ir.scene, ir.scene.sky
    if sky is None:
        haze = scene.haze
        yield f"background {{ {_color(haze.color, haze.intensity) if haze.defined else _color(scene.background)} }}"
        return
    low, high = _color(sky.horizon_color, sky.intensity), _color(sky.zenith_color, sky.intensity)
    yield f"sky_sphere {{ pigment {{ gradient z color_map {{ [0 {low}] [1 {high}] }} }} }}"


def _light(ir: SceneIR, row: int, shadows: bool) -> Iterator[str]:
    light = {name: column[row] for name, column in ir["lights"].items()}
    infinite = light["kind"] == LightKind.INFINITE
    place = -FAR * light["direction"] if infinite else light["position"]
    aim = f"parallel point_at {_vector(place + light['direction'])}" if infinite else ""
    without = "" if shadows and light["shadows"] else "shadowless"
    yield f"light_source {{ {_vector(place)} {_color(light['color'], light['intensity'])} {aim} {without} }}"


def _primitive(ir: SceneIR, row: int) -> Iterator[str]:
    """As an object of POV-Ray's own, or else as the triangles that figures make of it."""
    primitives = ir["primitives"]
    kind = PrimitiveKind(int(primitives["kind"][row]))
    shape = int(primitives["row"][row])
    if kind in OBJECTS:
        yield from OBJECTS[kind](ir, shape)
    else:
        (triangles,) = shape_of(kind).triangles(ir, np.array([row]), np.array([shape]))
        yield from _triangles(triangles)
    yield from _surface(ir, int(primitives["solid"][row]), kind, shape)
    yield "}"


def _sphere(ir: SceneIR, row: int) -> Iterator[str]:
    spheres = ir["spheres"]
    yield f"sphere {{ {_vector(spheres['center'][row])}, {spheres['radius'][row]:.10g}"


def _plane(ir: SceneIR, row: int) -> Iterator[str]:
    normal = ir["planes"]["normal"][row]
    normal = normal / np.sqrt(normal @ normal)
    yield f"plane {{ {_vector(normal)}, {normal @ ir['planes']['point'][row]:.10g}"


def _triangle(ir: SceneIR, row: int) -> Iterator[str]:
    point, u, v = (ir["triangles"][column][row] for column in ("point", "u", "v"))
    yield _polygon([point + u, point, point + v])


def _rectangle(ir: SceneIR, row: int) -> Iterator[str]:
    point, u, v = (ir["rectangles"][column][row] for column in ("point", "u", "v"))
    yield _polygon([point + u, point, point + v, point + u + v])


def _polygon(corners: list[NDArray[np.float64]]) -> str:
    closed = [*corners, corners[0]]
    return f"polygon {{ {len(closed)}, {', '.join(map(_vector, closed))}"


def _triangles(triangles: Triangles) -> Iterator[str]:
    yield f"mesh2 {{ vertex_vectors {{ {len(triangles.points)},"
    yield ",\n".join(_rows("<%.10g,%.10g,%.10g>", triangles.points))
    yield f"}} face_indices {{ {len(triangles.corners)},"
    yield ",\n".join(_rows("<%d,%d,%d>", triangles.corners))
    yield "}"


def _mesh(ir: SceneIR, row: int) -> Iterator[str]:
    mesh = {name: int(column[row]) for name, column in ir["meshes"].items()}
    vertices = slice(mesh["first_vertex"], mesh["first_vertex"] + mesh["vertex_count"])
    facets = slice(mesh["first_facet"], mesh["first_facet"] + mesh["facet_count"])
    yield f"mesh2 {{ vertex_vectors {{ {mesh['vertex_count']},"
    yield ",\n".join(_rows("<%.10g,%.10g,%.10g>", ir["vertices"]["position"][vertices]))
    normals = ir["facets"]["normal"][facets]
    smooth = bool(mesh["phong"]) and len(normals) > 0 and normals[0, 0] >= 0
    if smooth:
        yield f"}} normal_vectors {{ {len(ir['normals']['direction'])},"
        yield ",\n".join(_rows("<%.10g,%.10g,%.10g>", ir["normals"]["direction"]))
    yield f"}} face_indices {{ {mesh['facet_count']},"
    yield ",\n".join(_rows("<%d,%d,%d>", ir["facets"]["vertex"][facets] - mesh["first_vertex"]))
    if smooth:
        yield f"}} normal_indices {{ {mesh['facet_count']},"
        yield ",\n".join(_rows("<%d,%d,%d>", normals))
    yield "}"


OBJECTS: Mapping[PrimitiveKind, Callable[[SceneIR, int], Iterator[str]]] = {
    PrimitiveKind.SPHERE: _sphere,
    PrimitiveKind.PLANE: _plane,
    PrimitiveKind.TRIANGLE: _triangle,
    PrimitiveKind.RECTANGLE: _rectangle,
    PrimitiveKind.POLYGONS: _mesh,
    PrimitiveKind.TERRAIN: _mesh,
}
"""The beginning of an object, up to its texture."""


def _rows(form: str, rows: NDArray[np.float64] | NDArray[np.int32] | NDArray[np.int64]) -> Iterator[str]:
    each: list[list[float]] = rows.tolist()
    return (form % tuple(row) for row in each)


def _surface(ir: SceneIR, solid: int, kind: PrimitiveKind, shape: int) -> Iterator[str]:
    surface = {name: column[solid] for name, column in ir["surfaces"].items()}
    yield f"  pigment {{ {_pigment(ir, surface, kind, shape)} }}"
    ambient = float(surface["ambient"]) * ir.scene.ambient.intensity
    highlight = f"specular {surface['specular']:.6g} roughness {max(float(surface['rough']), 1e-4):.6g}"
    mirror = float(surface["hard"]) * float(surface["specular"])
    yield (
        f"  finish {{ ambient {_color(ir.scene.ambient.color, ambient)} diffuse {surface['diffuse']:.6g} "
        f"{highlight if surface['specular'] > 0 else ''} {f'reflection {mirror:.6g}' if mirror > 0 else ''} }}"
    )


def _pigment(ir: SceneIR, surface: dict[str, NDArray[np.float64]], kind: PrimitiveKind, shape: int) -> str:
    """The surface's colour under its first texture: a checker as it is, a blend as a gradient, no other."""
    plain = _color(surface["color"])
    if not surface["texture_count"]:
        return plain
    texture = {name: column[int(surface["first_texture"])] for name, column in ir["textures"].items()}
    other = _color(texture["color"])
    match TextureKind(int(texture["kind"])):
        case TextureKind.CHECKER:
            values = ",".join(f"{value:.10g}" for value in texture["transform"][:, :3].ravel())
            return f"checker {plain}, {other} matrix <{values}>"
        case TextureKind.UBLEND | TextureKind.VBLEND if kind is PrimitiveKind.SPHERE:
            radius = float(ir["spheres"]["radius"][shape])
            low = ir["spheres"]["center"][shape] - radius
            ramp = f"gradient z color_map {{ [0 {other}] [1 {plain}] }}"
            return f"{ramp} scale {2.001 * radius:.6g} translate {_vector(low)}"
        case _:
            return plain


def silhouette(ir: SceneIR) -> SceneIR:
    """The scene with every object white, unlit, and the rest black: what is hit, and nothing else."""
    tables = dict(ir.tables)
    tables["lights"] = empty_tables()["lights"]
    surfaces = dict(ir["surfaces"])
    for name, value in (("color", 1.0), ("ambient", 1.0), ("diffuse", 0.0), ("specular", 0.0), ("hard", 0.0)):
        surfaces[name] = np.full_like(surfaces[name], value)
    surfaces["texture_count"] = np.zeros_like(surfaces["texture_count"])
    tables["surfaces"] = surfaces
    black = (0.0, 0.0, 0.0)
    scene = ir.scene._replace(
        shadows=False,
        log_scale=0.0,
        depth=1,
        background=black,
        ambient=Ambient(1.0, (1.0, 1.0, 1.0), 0, 0),
        haze=Haze(False, 0.0, black, 0.0),
        sky=None,
    )
    return SceneIR(scene, tables, ir.source)


def read_picture(path: Path) -> NDArray[np.uint8]:
    """A PPM file as POV-Ray writes it: rows x columns x 3."""
    data = path.read_bytes()
    header = re.match(rb"P6\s+(?:#.*\n)*(\d+)\s+(\d+)\s+(\d+)\s", data)
    if header is None:
        raise ValueError(f"{path} is not a PPM picture")
    columns, rows, largest = (int(number) for number in header.groups())
    samples = np.frombuffer(data, ">u2" if largest > 255 else np.uint8, offset=header.end())
    return (samples.reshape(rows, columns, 3) >> (8 if largest > 255 else 0)).astype(np.uint8)


def main() -> None:
    """Translate one scene."""
    parser = argparse.ArgumentParser(prog="python -m bench.povray", description="Translate a scene for POV-Ray.")
    parser.add_argument("scene", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--shadows", action="store_true", help="cast shadows, whatever the scene says")
    options = parser.parse_args()
    ir = m3dc.compile(options.scene.read_bytes(), options.scene.name).ir
    write(ir, options.output, shadows=options.shadows or ir.scene.shadows)


if __name__ == "__main__":
    main()
