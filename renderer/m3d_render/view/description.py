"""What there is to say of a thing that was picked: what it is called, where it is written, its matrices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from m3d_render.view.opening import Opened
from m3dc.ir import PrimitiveKind
from m3dc.text.caption import caption


def describe(opened: Opened, primitive: int) -> str:
    """Lines of text about a row of `primitives` and the solid or light that it is part of.

    A solid is called by the comment that stands with it, or the variable it copies; without either, or in a compiled
    scene, by its number: its row in the IR.
    """
    ir = opened.ir
    row = {column: int(ir["primitives"][column][primitive]) for column in ("kind", "solid", "light")}
    table, number = ("solids", row["solid"]) if row["solid"] >= 0 else ("lights", row["light"])
    owner = ir[table]
    span = _span(owner["span"][number])
    count, first = int(owner["primitive_count"][number]), int(owner["first_primitive"][number])
    which = "" if count == 1 else f" {primitive - first + 1} of {count}"
    kind = PrimitiveKind(row["kind"]).name.lower()
    color = ir["surfaces" if table == "solids" else "lights"]["color"][number]
    lines = [
        name(opened, primitive),
        f"{table[:-1]} {number}, {_place(opened, span)}",
        f"{kind}{which}, {_place(opened, _span(ir['primitives']['span'][primitive]))}",
        f"color < {', '.join(f'{part:.3g}' for part in color)} >",
        "",
        f"matrix of the {table[:-1]}" + _matrix(owner["transform"][number]),
        "matrix of the primitive" + _matrix(ir["primitives"]["transform"][primitive]),
    ]
    return "\n".join(lines)


def name(opened: Opened, primitive: int) -> str:
    """What the solid or light is called that a primitive is part of."""
    ir = opened.ir
    solid, light = (int(ir["primitives"][column][primitive]) for column in ("solid", "light"))
    table, number = ("solids", solid) if solid >= 0 else ("lights", light)
    if opened.source is not None:
        title, variable = caption(opened.source.data, _span(ir[table]["span"][number]))
        if title and variable:
            return f"{title} ({variable})"
        if title or variable:
            return title or variable
    return f"{table[:-1]} {number}"


def _span(row: NDArray[np.int64]) -> tuple[int, int]:
    return int(row[0]), int(row[1])


def _place(opened: Opened, span: tuple[int, int]) -> str:
    if opened.source is None:
        return f"byte {span[0]} of {opened.ir.source or 'its text'}"
    return f"line {opened.source.position(span[0]).line}"


def _matrix(matrix: NDArray[np.float64]) -> str:
    if np.array_equal(matrix, np.eye(4)):
        return ": identity"
    return ":\n" + "\n".join(" ".join(f"{value:10.4g}" for value in row) for row in matrix)
