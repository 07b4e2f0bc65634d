"""The `.m3ir` file: one NumPy archive that `numpy.load` opens without pickle. docs/m3ir.md describes it.

`header` is a JSON text as bytes: the format's version and all of `ir.Globals`; every column of every table is an array
named `table.column`. Nothing that a file says is trusted: it takes no more memory than the file is long, and what is
read has passed `soundness.fault`.
"""

from __future__ import annotations

import io
import json
import math
import os
import sys
import zipfile
from collections.abc import Mapping
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, BinaryIO, NoReturn, cast, get_args, get_origin, get_type_hints

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from .. import ir
from ..files.artefact import replacing
from .soundness import fault, not_within

VERSION = 2

# A header says what a scene says once, and a file's name.
LONGEST_HEADER = 1 << 20
LONGEST_SHOWN = 120


class FormatError(ValueError):
    """A file that is not a readable `.m3ir`; the message says why, for people."""


def header(scene: ir.SceneIR) -> str:
    """The header: a JSON text. Raises ValueError that names a value that is not finite."""
    said = _plain(scene.scene)
    for name, member in said.items():
        parts = cast("dict[str, Any]", member) if isinstance(member, dict) else {name: member}
        for part, value in parts.items():
            if isinstance(value, (float, tuple)) and not np.isfinite(cast("ir.Triple", value)).all():
                raise ValueError(f"damaged scene: {part} is not finite")
    return json.dumps({"format": "m3ir", "version": VERSION, "source": scene.source, "scene": said})


def write(scene: ir.SceneIR, path: Path) -> None:
    """Write a scene to a file. A failed write leaves the old file. Raises OSError."""
    with replacing(path) as (file,):
        write_to(scene, file)


def write_to(scene: ir.SceneIR, file: BinaryIO) -> None:
    """Write a scene to an open file."""
    arrays = {
        f"{table}.{column}": values for table, columns in scene.tables.items() for column, values in columns.items()
    }
    text = np.frombuffer(header(scene).encode(), np.uint8)
    np.savez(file, allow_pickle=False, header=text, **arrays)


def read(path: Path) -> ir.SceneIR:
    """Read a scene. Raises OSError, or FormatError for anything but a whole and sound file of this version."""
    with path.open("rb") as file:
        archive = _Archive(file)
        said = _header(archive)
        tables = {
            table: {name: archive.column(f"{table}.{name}", column) for name, column in columns.items()}
            for table, columns in ir.TABLES.items()
        }
    scene = ir.SceneIR(
        _member(ir.Globals, said.get("scene"), "scene"), tables, _member(str, said.get("source"), "source")
    )
    wrong = fault(scene)
    if wrong:
        _damaged(wrong)
    return scene


def _damaged(what: str) -> NoReturn:
    raise FormatError(f"it is damaged: {_shown(what)}")


def _shown(what: object) -> str:
    """Something of a file, in a message: short, and without control characters."""
    text = "".join(character if character.isprintable() else "?" for character in str(what)[: LONGEST_SHOWN + 1])
    return text if len(text) <= LONGEST_SHOWN else text[:LONGEST_SHOWN] + "..."


# --- the archive --------------------------------------------------------------------------------------------------


class _Archive:
    """The arrays of an open file, by name."""

    def __init__(self, file: BinaryIO) -> None:
        self._size = os.fstat(file.fileno()).st_size
        try:
            self._zip = zipfile.ZipFile(file)
        except Exception as error:  # as of `_bytes`
            raise FormatError("it is not an .m3ir file, or only a part of one") from error
        self._members = {info.filename: info for info in self._zip.infolist()}
        if "header.npy" not in self._members:
            raise FormatError("it is not an .m3ir file")
        # Of arrays that are stored as they are, all together are no longer than the file: a small file stays small.
        if any(info.compress_type != zipfile.ZIP_STORED for info in self._zip.infolist()):
            raise FormatError("it is compressed; the arrays of an .m3ir file are stored as they are")
        if sum(info.file_size for info in self._zip.infolist()) > self._size:
            _damaged("it is shorter than it says")

    def _bytes(self, name: str) -> bytearray:
        info = self._members.get(f"{name}.npy")
        if info is None:
            _damaged(f"{name} is missing")
        try:
            data = bytearray(self._zip.read(info))
        except Exception as error:
            # Of damaged archives `zipfile` raises a dozen kinds of exceptions, few of them documented.
            _damaged(f"{name} can not be read, {str(error) or type(error).__name__}")
        return data

    def array(self, name: str) -> NDArray[Any]:
        """An array, which may be written to."""
        data = self._bytes(name)
        file = io.BytesIO(data)
        try:
            version = npy.read_magic(file)
            reader = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
            shape, backwards, dtype = reader(file)
        except Exception:
            # An array's header is a Python expression: there is no end to what is wrong with one.
            _damaged(f"{name} is no array")
        start = file.tell()
        if dtype.hasobject or min(shape, default=0) < 0 or math.prod(shape) * dtype.itemsize != len(data) - start:
            _damaged(f"{name} is not as long as it says")
        values = np.frombuffer(data, dtype, offset=start)
        return values.reshape(shape, order="F" if backwards else "C")

    def column(self, name: str, column: ir.Column) -> NDArray[Any]:
        """A column of a table."""
        values = self.array(name)
        if values.dtype != np.dtype(column.dtype) or values.shape[1:] != column.shape or not values.ndim:
            _damaged(f"{name} has the wrong type or shape")
        if values.dtype == np.bool_ and values.size and int(values.view(np.uint8).max()) > 1:
            _damaged(f"{name} holds what is neither true nor false")
        return values


# --- the header ---------------------------------------------------------------------------------------------------


def _header(archive: _Archive) -> dict[str, Any]:
    text = archive.array("header").tobytes()
    if len(text) > LONGEST_HEADER:
        _damaged(f"its header is longer than {LONGEST_HEADER} bytes")
    try:
        said = json.loads(text)
    except (ValueError, RecursionError) as error:
        _damaged(f"its header is no JSON, {error}")
    if not isinstance(said, dict) or cast("dict[str, Any]", said).get("format") != "m3ir":
        raise FormatError("it is not an .m3ir file")
    said = cast("dict[str, Any]", said)
    version = said.get("version")
    if type(version) is not int:
        _damaged("version is not a whole number")
    if version != VERSION:
        raise FormatError(
            f"its format version is {_shown(version)}, this program reads version {VERSION}; "
            "compile the scene again with m3dc"
        )
    return said


def _plain(scene: ir.Globals) -> dict[str, Any]:
    """Their JSON form."""
    return {
        name: member._asdict() if hasattr(member, "_asdict") else member for name, member in scene._asdict().items()
    }


_KINDS = {bool: "true or false", int: "a whole number", str: "a text"}


def _member(kind: Any, data: Any, name: str) -> Any:
    """A member of the header, from its JSON form. `kind` is what scene.py says of it."""
    if get_origin(kind) is Annotated:
        base, within = get_args(kind)
        value = _member(base, data, name)
        numbers: tuple[float, ...] = cast("Any", value) if isinstance(value, tuple) else (value,)
        for number in numbers:
            wrong = not_within(number, within)
            if wrong:
                _damaged(f"{name} {wrong}")
        return cast("Any", value)
    if isinstance(kind, UnionType):
        (present,) = (other for other in get_args(kind) if other is not NoneType)
        return None if data is None else _member(present, data, name)
    if kind in _KINDS:
        if type(data) is not kind:
            _damaged(f"{name} is not {_KINDS[kind]}")
        return data
    if kind is float:
        # A whole number of any length is one in JSON.
        if type(data) not in (int, float) or not abs(data) <= sys.float_info.max:
            _damaged(f"{name} is not a finite number")
        return float(data)
    if hasattr(kind, "_fields"):
        return _members(kind, data, name)
    if get_origin(kind) is tuple:
        kinds = get_args(kind)
        values = cast("list[Any]", data) if isinstance(data, list) else []
        if len(values) != len(kinds):
            _damaged(f"{name} is not {len(kinds)} numbers")
        return tuple(_member(one, value, name) for one, value in zip(kinds, values, strict=True))
    assert get_origin(kind) is Mapping, kind
    return {key: _member(get_args(kind)[1], value, f"{name}.{key}") for key, value in _object(data, name).items()}


def _members(kind: Any, data: Any, name: str) -> Any:
    """The named tuple of a JSON object."""
    given = _object(data, name)
    unknown = sorted(given.keys() - set(kind._fields))
    if unknown:
        _damaged(f"there is no {name}.{unknown[0]}")
    missing = [member for member in kind._fields if member not in given and member not in kind._field_defaults]
    if missing:
        _damaged(f"{name}.{missing[0]} is missing")
    hints = get_type_hints(kind, include_extras=True)
    return kind(**{member: _member(hints[member], value, f"{name}.{member}") for member, value in given.items()})


def _object(data: Any, name: str) -> dict[str, Any]:
    if not isinstance(data, dict):
        _damaged(f"{name} is not an object")
    return cast("dict[str, Any]", data)
