"""Writes what follows from the lists of render options and of picture formats: part of `make generate`.

From m3d_render/options.py and formats.py that is what the kernel's crates know of options, and the tables in
docs/rendering.md.
"""

from __future__ import annotations

import re
from pathlib import Path

from m3d_render.formats import FORMATS
from m3d_render.options import KERNEL, OPTIONS, Kind, Option, Real, Switch, Whole

from .generated import ROOT, write

CRATES = ROOT / "renderer/crates"
DOCS = ROOT / "docs/rendering.md"

_MADE = "Made by `make generate` from renderer/m3d_render/options.py"
_OPTIONS = re.compile(r"(?<=<!-- options -->\n).*?(?=<!-- /options -->)", re.DOTALL)
_FORMATS = re.compile(r"(?<=<!-- formats -->\n).*?(?=<!-- /formats -->)", re.DOTALL)


def texts() -> dict[Path, str]:
    """Every file that is made, with what it should be."""
    return {
        CRATES / "kernel/src/options.rs": _kernel(),
        CRATES / "ir/src/options.rs": _ir(),
        CRATES / "python/src/options.rs": _python(),
        DOCS: _FORMATS.sub(lambda _: _formats(), _OPTIONS.sub(lambda _: _options(), DOCS.read_text(encoding="utf-8"))),
    }


def _kernel() -> str:
    fields = "\n".join(
        f"    /// {option.help[0].upper()}{option.help[1:]}.\n    pub {name}: {_rust(option.kind)},"
        for name, option in KERNEL.items()
    )
    return f"""\
//! What may be asked of every pixel. {_MADE}.

#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Options {{
{fields}
}}
"""


def _ir() -> str:
    fields = "\n".join(f"        {name}: {_said(name, option)}," for name, option in KERNEL.items())
    return f"""\
//! Render options as a scene has them. {_MADE}.

use m3d_kernel::options::Options;

use crate::ir::Ir;

/// What the scene says, and what is meant where nothing is asked for.
pub fn options(ir: &Ir) -> Options {{
    let said = &ir.globals;
    Options {{
{fields}
    }}
}}
"""


def _said(name: str, option: Option) -> str:
    if option.default is not None:
        return str(option.default).lower()
    return f"usize::try_from(said.{name}).unwrap_or(1)" if isinstance(option.kind, Whole) else f"said.{name}"


def _python() -> str:
    fields = "\n".join(f'        {name}: given.get_item("{name}")?.extract()?,' for name in KERNEL)
    return f"""\
//! Render options from Python. {_MADE}.

use m3d_kernel::options::Options;
use pyo3::prelude::*;

/// The options in a dictionary.
pub fn options(given: &Bound<PyAny>) -> PyResult<Options> {{
    Ok(Options {{
{fields}
    }})
}}
"""


def _rust(kind: Kind) -> str:
    match kind:
        case Whole():
            return "usize"
        case Real():
            return "f64"
        case Switch():
            return "bool"
        case _:
            raise TypeError(f"the kernel knows no option of the kind {kind}")


def _options() -> str:
    rows = "".join(f"| {_flag(name, option)} | `{name}` | {option.help} |\n" for name, option in OPTIONS.items())
    return f"\n| `m3d-render` | Python | what |\n|---|---|---|\n{rows}\n"


def _formats() -> str:
    rows = "".join(
        f"| {', '.join(f'`{suffix}`' for suffix in format_.suffixes)} | {format_.holds} |\n" for format_ in FORMATS
    )
    return f"\n| suffix | what the file holds |\n|---|---|\n{rows}\n"


def _flag(name: str, option: Option) -> str:
    value = "" if isinstance(option.kind, Switch) else f" {option.kind.metavar}"
    return f"`--{name.replace('_', '-')}{value}`"


if __name__ == "__main__":
    write(texts())
