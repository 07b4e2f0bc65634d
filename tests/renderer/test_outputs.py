"""Extra outputs agree with each other and with the scene, for any size of picture and eyes on boundaries of the air."""

from __future__ import annotations

import numpy as np
import pytest

import m3d_render
import m3dc
from m3d_render import RenderOptions

OUTPUTS = ["depth", "normal", "position", "solid", "primitive", "uv", "path"]

SCENE = """
SCENE
{{
    {air} SHADOWS AMBIENT {{ INTENSITY 0.5 }}
    VIEW {{ FROM < 0, 0, {eye} > TO < 100, 3, {target} > FOV 20 }}
}}
LIGHT {{ SOURCE {{ INFINITE AZIMUTH 30 ZENITH 40 }} }}
SOLID {{ PLANE {{ }} }}
SOLID {{ SPHERE {{ CENTER < 100, 3, 1 > RADIUS 1 }} SURFACE {{ HARD 0.6 }} }}
SOLID {{ RECTANGLE {{ VERTEX1 < 99, 30, 3 > VERTEX2 < 99, 9, 3 > VERTEX3 < 99, 9, 0 > }} SURFACE {{ HARD 0.6 }} }}
SOLID {{ RECTANGLE {{ VERTEX1 < 60, 9, 2 > VERTEX2 < 60, -9, 2 > VERTEX3 < 80, -9, 2 > }} SURFACE {{ HARD 0.6 }} }}
SOLID {{ TRIANGLE {{ VERTEX1 < 160, 9, 1 > VERTEX2 < 160, -9, 1 > VERTEX3 < 180, -9, 1 > }} }}
"""
AIR = "MIRAGE { PROFILE { 0 25 1 22 2 20 3 21 10 18 100 15 } DISTANCE 5000 SEGMENTS 400 }"
"""Its boundaries lie at the heights of things, of eyes and of what they look at."""

SIZES = [(1, 1), (1, 9), (9, 1), (2, 2), (23, 17)]
OPTIONS: list[RenderOptions] = [{}, {"samples": 3}, {"refract_reflections": True, "depth": 4}]


@pytest.mark.parametrize("target", [0, 1, 1.5])
@pytest.mark.parametrize("eye", [0, 1, 2, 1.5, 100])
@pytest.mark.parametrize("air", ["", AIR], ids=["straight", "bent"])
def test_outputs_agree(air: str, eye: float, target: float) -> None:
    ir = m3dc.compile(SCENE.format(air=air, eye=eye, target=target)).ir
    scene = m3d_render.prepare(ir)
    start, ahead = np.array(ir.scene.view.eye), np.array(ir.scene.view.normal)
    for width, height in SIZES:
        rendering = scene.render(aov=OUTPUTS, width=width, height=height)
        found = rendering.layers
        hit = found["primitive"] >= 0
        way = found["position"][hit] - start
        np.testing.assert_allclose(found["depth"][hit], way @ ahead, rtol=1e-5, atol=1e-5)
        np.testing.assert_allclose(np.linalg.norm(found["normal"][hit], axis=-1), 1, rtol=1e-6)
        assert np.all(found["path"][hit, 0] >= np.linalg.norm(way, axis=-1) * (1 - 1e-6))
        rows = found["primitive"][hit].astype(int)
        np.testing.assert_array_equal(found["solid"][hit], ir["primitives"]["solid"][rows])
        flat = ir["primitives"]["kind"][rows] == m3dc.ir.PrimitiveKind.PLANE
        np.testing.assert_array_equal((found["uv"][hit] == -1).all(axis=-1), flat)
        assert np.isposinf(found["depth"][~hit]).all()
        assert np.isposinf(found["path"][~hit, 0]).all()
        assert not found["normal"][~hit].any()
        assert np.all(found["solid"][~hit] == -1)


@pytest.mark.parametrize("options", OPTIONS)
@pytest.mark.parametrize("eye", [1, 1.5])
def test_a_part_is_that_part_of_the_whole_whatever_is_asked_beside_it(eye: float, options: RenderOptions) -> None:
    scene = m3d_render.prepare(m3dc.compile(SCENE.format(air=AIR, eye=eye, target=1)).ir)
    for width, height in SIZES:
        sized: RenderOptions = {**options, "width": width, "height": height}
        whole = scene.render(aov=OUTPUTS, **sized)
        assert scene.render(**sized).picture.tobytes() == whole.picture.tobytes()
        for y, x in {(0, 0), (height - 1, width - 1), (height // 2, width // 3)}:
            pixel: RenderOptions = {**sized, "region": (y, x, y, x)}
            part = scene.render(aov=OUTPUTS, **pixel)
            np.testing.assert_array_equal(part.picture[0, 0], whole.picture[y, x])
            for name in OUTPUTS:
                np.testing.assert_array_equal(part.layers[name][0, 0], whole.layers[name][y, x])
