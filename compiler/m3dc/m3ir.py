"""The `.m3ir` file: one NumPy archive that `numpy.load` opens without pickle. docs/m3ir.md describes it.

`header` is a JSON text as bytes: the format's version and all of `ir.Scene`; every column of every table is an array
named `table.column`.
"""

from __future__ import annotations

import json
import zipfile
from pathlib import Path
from typing import Any, cast

import numpy as np

from . import ir
from .artefact import replacing

VERSION = 2


class FormatError(ValueError):
    """A file that is not a readable `.m3ir`; the message says why, for people."""


def write(scene: ir.SceneIR, path: Path) -> None:
    """Write a scene to a file. A failed write leaves the old file. Raises OSError."""
    header = {
        "format": "m3ir",
        "version": VERSION,
        "source": scene.source,
        "scene": _plain(scene.scene),
    }
    arrays = {
        f"{table}.{column}": values for table, columns in scene.tables.items() for column, values in columns.items()
    }
    text = np.frombuffer(json.dumps(header, allow_nan=False).encode(), np.uint8)
    with replacing(path) as (temporary,), temporary.open("wb") as file:
        np.savez(file, allow_pickle=False, header=text, **arrays)


def read(path: Path) -> ir.SceneIR:
    """Read a scene. Raises OSError, or FormatError for anything but a whole file of this version."""
    try:
        with np.load(path, allow_pickle=False) as archive:
            if not isinstance(archive, np.lib.npyio.NpzFile) or "header" not in archive.files:
                raise FormatError("it is not an .m3ir file")
            header = json.loads(archive["header"].tobytes())
            if header.get("format") != "m3ir":
                raise FormatError("it is not an .m3ir file")
            if header.get("version") != VERSION:
                raise FormatError(
                    f"its format version is {header.get('version')}, this program reads version {VERSION}; "
                    "compile the scene again with m3dc"
                )
            tables = {
                table: {name: _column(archive, f"{table}.{name}", column) for name, column in columns.items()}
                for table, columns in ir.TABLES.items()
            }
            for table, columns in tables.items():
                if len({len(values) for values in columns.values()}) != 1:
                    raise FormatError(f"it is damaged: the columns of {table} differ in length")
            return ir.SceneIR(_scene(header["scene"]), tables, str(header["source"]))
    except FormatError:
        raise
    except (zipfile.BadZipFile, EOFError, ValueError, KeyError, TypeError, AttributeError) as error:
        reason = "it is not an .m3ir file" if not zipfile.is_zipfile(path) else f"it is damaged: {error}"
        raise FormatError(reason) from error


def _column(archive: Any, name: str, column: ir.Column) -> Any:
    if name not in archive.files:
        raise FormatError(f"it is damaged: {name} is missing")
    values = archive[name]
    if values.dtype != np.dtype(column.dtype) or values.shape[1:] != column.shape:
        raise FormatError(f"it is damaged: {name} has the wrong type or shape")
    return values


def _plain(scene: ir.Scene) -> dict[str, Any]:
    """A Scene's JSON form."""
    members = scene._asdict()
    return members | {name: members[name]._asdict() for name in _PARTS if members[name] is not None}


def _scene(data: dict[str, Any]) -> ir.Scene:
    """A Scene from its JSON form."""
    made: dict[str, Any] = dict(data)
    for name, kind in _PARTS.items():
        if made[name] is not None:
            made[name] = kind(**{k: _value(v) for k, v in made[name].items()})
    made["spans"] = {keyword: (start, end) for keyword, (start, end) in made["spans"].items()}
    return ir.Scene(**{k: _value(v) for k, v in made.items()})


_PARTS = {
    "ambient": ir.Ambient,
    "haze": ir.Haze,
    "sky": ir.Sky,
    "mirage": ir.Mirage,
    "view": ir.View,
    "extent": ir.Extent,
}


def _value(value: Any) -> Any:
    return tuple(cast("list[Any]", value)) if isinstance(value, list) else value
