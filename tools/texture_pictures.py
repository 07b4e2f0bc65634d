"""Renders a picture of every texture and writes docs/textures.md around them: part of `make gallery`.

All show the same sphere on the same plane in the same light, and what the page says of a texture is the comment at the
top of its file in renderer/crates/kernel/src/texture/. tests/test_texture_pictures.py checks that page and pictures are
current.
"""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import NamedTuple

import numpy as np

import m3d_render
import m3dc

ROOT = Path(__file__).parent.parent
IMAGES = ROOT / "docs" / "images" / "textures"
PAGE = ROOT / "docs" / "textures.md"
KERNEL = ROOT / "renderer/crates/kernel/src/texture"

WIDTH, HEIGHT = 160, 120
SHARED = {"WAVE": "wave", "SQUEEZE": "squeeze", "Noise": "../noise"}
"""Sections without a picture, and their files."""

SHEET = "all.png"
FINER = 3
"""Each pixel is the mean of FINER x FINER rays."""
COLUMNS = 5
"""Pictures in a row of the contact sheet, each half as wide and high as its own."""

SCENE = """\
VARIABLES {{ SURFACE skin; }}

skin =
{{
    {surface}
    TEXTURE
    {{
        {texture}
    }}
}}

SCENE
{{
    SHADOWS
    AMBIENT {{ INTENSITY 0.9 }}
    BACKGROUND < 0.6, 0.75, 0.95 >
    VIEW {{ FROM < 9, -6, 6.5 > TO < 0, 0.1, 1.65 > FOV 36 WIDTH 480 HEIGHT 360 }}
}}

LIGHT {{ SOURCE {{ INFINITE AZIMUTH -70 ZENITH 42 }} }}

SOLID {{ PLANE {{ }} SURFACE skin }}
SOLID {{ SPHERE {{ CENTER < 0, 0, 2 > RADIUS 2 }} SURFACE skin }}
"""


INTRODUCTION = """\
# Textures

<!-- Made by tools/texture_pictures.py: `make gallery` -->

![all textures](images/textures/all.png)

A texture changes the colour of a surface, or its normal, from point to point. A surface may have any number of them.
They apply in the order written: each blends its colour with that which the one before has left, and tilts the normal
that the one before has left.

- **Where it is.** A texture fills space, and a surface shows the part it passes through. It is fixed in the scene, or
  with `LOCAL` in its object, and moved, turned and sized by its own `TRANSFORM`.
- **Which colour.** Its function has a value t from 0 to 1. `COLOR` is blended with the surface's colour, by t. `COLORS`
  divides 0 to 1 into ranges, each from one colour to another; where t falls in no range the surface keeps its colour.
- **Which side.** Where a texture has a step, between CHECKER's cubes, between two ranges, or at the edge of SNOW, a
  surface that lies in it has what is above: the step belongs to the cube, range or snow that begins there.
- **How much.** `TURBULENCE`, `SQUEEZE`, `SCALE` and the like are 1 if not given, which is a lot; 0 is none.

All pictures below are of one scene, each with its own surface:

```m3d
{scene}
```

The reference of all statements is in [the language](language/attributes.md).
"""

SECTION = """\
## {keyword}

<table><tr><td><img src="images/textures/{image}" alt="{keyword}"></td><td>

```
{text}
```

</td></tr></table>

{says}
"""


class Example(NamedTuple):
    """A texture as its picture shows it: its keyword, its file, the surface it is on, and its text."""

    keyword: str
    file: str
    surface: str
    texture: str

    @property
    def image(self) -> str:
        return f"{self.keyword.lower()}.png"


EXAMPLES = (
    Example(
        "CHECKER", "checker",
        "COLOR < 0.85, 0.8, 0.7 > AMBIENT 0.3 HARD 0",
        "CHECKER { COLOR < 0.25, 0.3, 0.35 > }",
    ),
    Example(
        "WOOD", "wood",
        "COLOR < 0.85, 0.6, 0.35 > AMBIENT 0.3 ROUGH 0.3 HARD 0",
        """WOOD
        {
            COLOR < 0.45, 0.24, 0.1 >
            TURBULENCE 0.8
            SQUEEZE 0.3
            TRANSFORM { SCALE < 0.4, 0.4, 0.4 > ROTY 80 ROTZ 20 TRANSZ 0.6 }
        }""",
    ),
    Example(
        "MARBLE", "marble",
        "COLOR < 0.93, 0.92, 0.88 > AMBIENT 0.3 SPECULAR 0.3 ROUGH 0.15 HARD 0.2",
        "MARBLE { COLOR < 0.25, 0.3, 0.33 > }",
    ),
    Example(
        "SPOTTED", "spotted",
        "COLOR < 0.9, 0.75, 0.45 > AMBIENT 0.3 HARD 0",
        "SPOTTED { COLOR < 0.3, 0.15, 0.05 > TRANSFORM { SCALE < 0.5, 0.5, 0.5 > } }",
    ),
    Example(
        "GRANITE", "granite",
        "COLOR < 0.85, 0.75, 0.7 > AMBIENT 0.3 ROUGH 0.2 HARD 0.2",
        "GRANITE { COLOR < 0.2, 0.18, 0.2 > TURBULENCE 1.5 TRANSFORM { SCALE < 0.5, 0.5, 0.5 > } }",
    ),
    Example(
        "CLOUDS", "clouds",
        "COLOR < 0.25, 0.5, 0.85 > AMBIENT 0.3 HARD 0",
        "CLOUDS { COLOR < 1, 1, 1 > TURBULENCE 1 SQUEEZE 0.7 }",
    ),
    Example(
        "SNOW", "snow",
        "COLOR < 0.4, 0.38, 0.33 > AMBIENT 0.3 HARD 0",
        """SNOW
        {
            ELEVATION 0.75
            SLOPE 80
            SCALE 0.2
            TURBULENCE 0.6
            TRANSFORM { SCALE < 0.5, 0.5, 0.5 > }
        }""",
    ),
    Example(
        "GRADIENT", "gradient",
        "COLOR < 0.2, 0.35, 0.5 > AMBIENT 0.3 HARD 0",
        """GRADIENT
        {
            TURBULENCE 0.2
            COLORS
            {
                0.05 0.45 < 0.15, 0.4, 0.1 > < 0.45, 0.5, 0.2 >
                0.45 0.8 < 0.5, 0.4, 0.25 > < 0.5, 0.45, 0.4 >
                0.8 1.0 < 0.9, 0.9, 0.95 > < 1, 1, 1 >
            }
            TRANSFORM { SCALE < 0.5, 0.5, 0.5 > }
        }""",
    ),
    Example(
        "BUMPS", "bumps",
        "COLOR < 0.8, 0.45, 0.15 > AMBIENT 0.3 SPECULAR 0.3 ROUGH 0.3 HARD 0",
        "BUMPS { SQUEEZE 0 TURBULENCE 0.3 TRANSFORM { SCALE < 0.4, 0.4, 0.4 > } }",
    ),
    Example(
        "WAVES", "waves",
        "COLOR < 0.1, 0.45, 0.55 > AMBIENT 0.3 SPECULAR 0.35 ROUGH 0.2 HARD 0.4",
        """WAVES
        {
            WAVE { CENTER < 30, 5, 0 > AMPLITUDE 0.15 FREQ 2 }
            WAVE { CENTER < 10, -20, 0 > AMPLITUDE 0.15 FREQ 3 }
            WAVE { CENTER < -5, -30, 0 > AMPLITUDE 0.15 FREQ 5 }
            WAVE { CENTER < 20, -9, 0 > AMPLITUDE 0.15 FREQ 8 }
        }""",
    ),
    Example(
        "RIPPLES", "ripples",
        "COLOR < 0.1, 0.45, 0.55 > AMBIENT 0.3 SPECULAR 0.35 ROUGH 0.2 HARD 0.4",
        """RIPPLES
        {
            WAVE { CENTER < 3, -2, 0 > AMPLITUDE 0.03 FREQ 12 DAMP 0.02 }
            WAVE { CENTER < 1, 2, 4 > AMPLITUDE 0.03 FREQ 12 DAMP 0.02 }
        }""",
    ),
    Example(
        "UBLEND", "blend",
        "COLOR < 0.9, 0.1, 0.1 > AMBIENT 0.3 HARD 0",
        "UBLEND { COLOR < 0.1, 0.1, 0.9 > }",
    ),
    Example(
        "VBLEND", "blend",
        "COLOR < 0.9, 0.8, 0.6 > AMBIENT 0.3 HARD 0",
        """VBLEND
        {
            COLORS
            {
                0.75 0.84 < 0.8, 0.1, 0.1 > < 0.9, 0.7, 0.1 >
                0.88 0.97 < 0.1, 0.5, 0.3 > < 0.1, 0.3, 0.7 >
            }
        }""",
    ),
)  # fmt: skip


def scene(example: Example) -> str:
    """The text of the whole scene."""
    return SCENE.format(surface=example.surface, texture=example.texture)


def render(example: Example) -> np.ndarray:
    """The picture as an array (H, W, 3) of values 0..1."""
    result = m3dc.compile(scene(example), f"{example.keyword.lower()}.m3d")
    assert not result.diagnostics, result.diagnostics
    return shrunk(m3d_render.render(result.ir, width=FINER * WIDTH, height=FINER * HEIGHT), FINER)


def shrunk(picture: np.ndarray, factor: int) -> np.ndarray:
    """Means of squares of factor x factor pixels."""
    rows, columns, channels = picture.shape
    return picture.reshape(rows // factor, factor, columns // factor, factor, channels).mean(axis=(1, 3))


def contact_sheet(pictures: list[np.ndarray]) -> np.ndarray:
    """All pictures at half their size, in rows."""
    gap = 4
    height, width = HEIGHT // 2 + gap, WIDTH // 2 + gap
    rows = -(-len(pictures) // COLUMNS)
    sheet = np.ones((rows * height + gap, COLUMNS * width + gap, 3), np.float32)
    for i, picture in enumerate(pictures):
        top, left = gap + i // COLUMNS * height, gap + i % COLUMNS * width
        sheet[top : top + HEIGHT // 2, left : left + WIDTH // 2] = shrunk(picture, 2)
    return sheet


def comment(file: str) -> str:
    """What the comment at the top of a file of the kernel says, without the name before it."""
    lines = (KERNEL / f"{file}.rs").read_text(encoding="utf-8").splitlines()
    text = "\n".join(line[3:].strip() for line in lines if line.startswith("//!"))
    _, _, said = text.partition(": ")
    return said[0].upper() + said[1:]


def page() -> str:
    """docs/textures.md."""
    parts = [INTRODUCTION.replace("{scene}", scene(EXAMPLES[0]).strip())]
    shown: dict[str, str] = {}
    for example in EXAMPLES:
        says = comment(example.file) if example.file not in shown else f"See {shown[example.file]}."
        shown.setdefault(example.file, example.keyword)
        texture = textwrap.indent(textwrap.dedent(" " * 8 + example.texture), "    ")
        text = f"{example.surface}\nTEXTURE\n{{\n{texture}\n}}"
        parts.append(SECTION.format(keyword=example.keyword, image=example.image, text=text, says=says))
    shared = {name: comment(file) for name, file in SHARED.items()}
    return "\n".join([*parts, *(f"## {name}\n\n{says}\n" for name, says in shared.items())])


def main() -> None:
    IMAGES.mkdir(parents=True, exist_ok=True)
    pictures = [render(example) for example in EXAMPLES]
    for example, picture in zip(EXAMPLES, pictures, strict=True):
        m3d_render.write_picture(IMAGES / example.image, picture)
    m3d_render.write_picture(IMAGES / SHEET, contact_sheet(pictures))
    PAGE.write_text(page(), encoding="utf-8")
    print(PAGE.relative_to(ROOT))


if __name__ == "__main__":
    main()
