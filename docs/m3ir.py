"""Writes docs/m3ir.md from the description of the tables in compiler/m3dc/ir.py: part of `make generate`."""

from __future__ import annotations

import dataclasses
from pathlib import Path

from m3dc import ir
from m3dc.m3ir import VERSION

PAGE = Path(__file__).with_suffix(".md")

INTRODUCTION = f"""\
# The .m3ir file

*Made by `make generate` from compiler/m3dc/ir.py.*

A compiled scene is one NumPy archive (`.npz`, stored without compression) that NumPy alone opens, without pickle:

```python
import json
import numpy as np

with np.load("out/merman.m3ir", allow_pickle=False) as archive:
    header = json.loads(archive["header"].tobytes())
    print(header["version"], header["scene"]["view"]["fov"], archive["spheres.radius"])
```

`header` is a JSON text as bytes: `format` is `"m3ir"`, `version` is {VERSION}, `source` the scene file's name, `scene`
the things a scene says once. Every other array is a column of a table, named `table.column`, with one entry a row. A
reader must refuse a version it does not know; `m3dc.m3ir.read` does, and says so.

Geometry is in world space. Matrices are 4x4, for row vectors: P' = P M. Rows are in the order of the scene file. A
`span` is the half-open range of bytes of the source that a row came from. Rows that belong to a row of another table
follow one another: `first_...` is the first, `..._count` how many there are.
"""


def page() -> str:
    """The whole page."""
    parts = [INTRODUCTION, "## header: scene\n", *_dataclass(ir.Scene, "scene")]
    for name, columns in ir.TABLES.items():
        parts += [f"\n## {name}\n", "| column | type | |", "|---|---|---|"]
        for column, (dtype, shape, says) in columns.items():
            size = "×".join(str(n) for n in shape)
            parts.append(f"| `{column}` | `{dtype}`{' ' + size if size else ''} | {says} |")
    for enum in (ir.PrimitiveKind, ir.TextureKind, ir.LightKind):
        parts += [f"\n## {enum.__name__}\n", ", ".join(f"{member.value} {member.name}" for member in enum)]
    return "\n".join(parts) + "\n"


def _dataclass(kind: type, path: str) -> list[str]:
    """One line a member, nested ones after a dot."""
    lines: list[str] = []
    for member in dataclasses.fields(kind):
        name = f"{path}.{member.name}"
        optional = " or null" if "None" in str(member.type) else ""
        nested = getattr(ir, str(member.type).split(" |")[0], None)
        if dataclasses.is_dataclass(nested):
            says = (nested.__doc__ or "").split("\n")[0]
            lines.append(f"- `{name}`{optional}: {says}")
            lines += ["  " + line for line in _dataclass(nested, name)]
        else:
            lines.append(f"- `{name}`: {str(member.type).removesuffix(' | None').lower()}{optional}")
    return lines


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
