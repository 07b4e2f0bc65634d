"""Writes docs/m3ir.md from the description of the tables in compiler/m3dc/ir/tables.py: part of `make generate`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import UnionType
from typing import Annotated, NamedTuple, get_args, get_origin

from m3dc import ir
from m3dc.ir.m3ir import VERSION
from m3dc.text.span import Span

from .generated import ROOT, write

PAGE = ROOT / "docs/m3ir.md"

INTRODUCTION = f"""\
# The .m3ir file

*Made by `make generate` from compiler/m3dc/ir/tables.py.*

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
reader must refuse a version it does not know; `m3dc.ir.m3ir.read` does, and says so. It also refuses a file that is
compressed, cut short or has other bytes than this page says: every number is finite, unless it may be infinite, and
within the bounds given here; every row that is named is there.

Geometry is in world space. Matrices are 4x4, for row vectors: P' = P M. Rows are in the order of the scene file. A
`span` is the half-open range of bytes of the source that a row came from. Rows that belong to a row of another table
follow one another: `first_...` is the first, `..._count` how many there are.
"""


_ALIASES = {ir.Triple: "triple", Mapping[str, Span]: "by keyword, a pair of bytes"}


def page() -> str:
    """The whole page."""
    parts = [INTRODUCTION, "## header: scene\n", *_members(ir.Globals, "scene")]
    for name, columns in ir.TABLES.items():
        parts += [f"\n## {name}\n", "| column | type | |", "|---|---|---|"]
        for column, described in columns.items():
            size = "×".join(str(n) for n in described.shape)
            bounds = _bounds(described.within)
            kind = f"`{described.dtype}`{' ' + size if size else ''}{', ' + bounds if bounds else ''}"
            parts.append(f"| `{column}` | {kind} | {described.says} |")
    for enum in (ir.PrimitiveKind, ir.TextureKind, ir.LightKind):
        parts += [f"\n## {enum.__name__}\n", ", ".join(f"{member.value} {member.name}" for member in enum)]
    return "\n".join(parts) + "\n"


def _bounds(within: ir.Within) -> str:
    if within.least > -math.inf and within.most < math.inf:
        return f"{within.least:.10g} to {within.most:.10g}"
    words = [f"{within.least:g} or more"] if within.least > -math.inf else []
    return ", ".join(words + ["may be infinite"] * within.infinite)


def _members(kind: type[NamedTuple], path: str) -> list[str]:
    """One line a member, nested ones after a dot."""
    lines: list[str] = []
    for member, annotation in kind.__annotations__.items():
        name = f"{path}.{member}"
        one, optional, bounds = annotation, "", ""
        if get_origin(annotation) is Annotated:
            one, within = get_args(annotation)
            bounds = _bounds(within)
        if isinstance(annotation, UnionType):
            one, optional = get_args(annotation)[0], " or null"
        if hasattr(one, "_fields"):
            says = (one.__doc__ or "").split("\n")[0]
            lines.append(f"- `{name}`{optional}: {says}")
            lines += ["  " + line for line in _members(one, name)]
        else:
            lines.append(f"- `{name}`: {_ALIASES.get(one) or one.__name__}{optional}{bounds and ', ' + bounds}")
    return lines


if __name__ == "__main__":
    write({PAGE: page()})
