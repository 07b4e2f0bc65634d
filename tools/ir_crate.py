"""Writes renderer/crates/ir/src/generated.rs from compiler/m3dc/ir/tables.py: part of `make generate`.

It holds what the Rust side has to know of the IR by name: the kinds with their numbers, and the header's structures.
"""

from __future__ import annotations

import re
from enum import IntEnum
from types import UnionType
from typing import Annotated, Any, NamedTuple, get_args, get_origin

from m3dc import ir
from m3dc.ir.m3ir import VERSION

from .generated import ROOT, write

PAGE = ROOT / "renderer/crates/ir/src/generated.rs"

KINDS: tuple[type[IntEnum], ...] = (ir.PrimitiveKind, ir.TextureKind, ir.LightKind)
_TYPES = {float: "f64", int: "i64", bool: "bool", ir.Triple: "[f64; 3]"}

_HEAD = f"""\
//! Made by `make generate` from compiler/m3dc/ir/tables.py: the kinds of rows, and what a scene says once.

use serde::Deserialize;

/// Version of the .m3ir format.
pub const VERSION: u64 = {VERSION};
"""


def page() -> str:
    """The whole file, as rustfmt lays it out."""
    return "\n".join([_HEAD, *map(_kind, KINDS), *_structures(ir.Globals)])


def _kind(kind: type[IntEnum]) -> str:
    names = [(member.value, member.name.capitalize()) for member in kind]
    return "\n".join([
        f"/// {_says(kind)}",
        "#[derive(Clone, Copy, PartialEq, Eq, Debug)]",
        f"pub enum {kind.__name__} {{",
        *(f"    {name}," for _, name in names),
        "}",
        "",
        f"impl {kind.__name__} {{",
        "    /// The kind with this number in a table; None where there is none.",
        "    pub fn numbered(number: i32) -> Option<Self> {",
        "        match number {",
        *(f"            {value} => Some(Self::{name})," for value, name in names),
        "            _ => None,",
        "        }",
        "    }",
        "}",
        "",
    ])  # fmt: skip


def _structures(kind: type[NamedTuple]) -> list[str]:
    """The structure of a named tuple, after those of its members."""
    parts: list[str] = []
    fields: list[str] = []
    for name, annotation in kind.__annotations__.items():
        one, form = annotation, "{}"
        if isinstance(annotation, UnionType):
            one, form = get_args(annotation)[0], "Option<{}>"
        if get_origin(one) is Annotated:
            one = get_args(one)[0]
        if hasattr(one, "_fields"):
            parts += _structures(one)
            fields.append(f"    pub {name}: {form.format(_name(one))},")
        elif one in _TYPES:
            fields.append(f"    pub {name}: {form.format(_TYPES[one])},")
    parts.append("\n".join([
        f"/// {_says(kind)}",
        "#[derive(Clone, PartialEq, Debug, Deserialize)]",
        f"pub struct {_name(kind)} {{",
        *fields,
        "}",
        "",
    ]))  # fmt: skip
    return parts


def _name(kind: type[Any]) -> str:
    return kind.__name__


def _says(kind: type[Any]) -> str:
    """The first sentence of a docstring."""
    return re.split(r"(?<=\.) |\n", kind.__doc__ or "")[0]


if __name__ == "__main__":
    write({PAGE: page()})
