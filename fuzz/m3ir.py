"""A damaged `.m3ir` is read as a sound scene or refused with a reason, and takes no more memory than it is long."""

from __future__ import annotations

import io
import json
import random
import tempfile
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

import m3dc
from m3dc.ir import m3ir
from m3dc.ir.soundness import fault

from . import repeating
from .json_values import is_container, keys
from .scenes import Scenes

SUFFIX = ".m3ir"
CASES = 80

NUMBERS = (float("nan"), float("inf"), -float("inf"), 0, -1, 1, 2**31 - 1, -(2**31), 1e308, 1e-320)
VALUES: tuple[Any, ...] = (*NUMBERS, None, True, "", "x", [], {}, [1, 2], {"a": 1}, 10**400, [[[]]], -0.5)
TYPES = ("f4", ">f8", "i8", "u1", "?", "S3", "U2", "c16", "M8[s]")


def make(chance: random.Random) -> bytes:
    result = m3dc.compile(Scenes(chance, 0.1).scene())
    while not result.ok:
        result = m3dc.compile(Scenes(chance, 0.1).scene())
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "a.m3ir")
        m3ir.write(result.ir, path)
        data = path.read_bytes()
    for _ in range(chance.randint(1, 3)):
        try:
            data = chance.choices(DAMAGE, (1, 1, 3, 3))[0](data, chance)
        except Exception:
            break  # it is so damaged already that NumPy does not read it
    return data


def _bytes_changed(data: bytes, chance: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(chance.choice((1, 1, 4, 40))):
        changed[chance.randrange(len(changed))] = chance.choice((0, 1, 0x7F, 0xFF, chance.randrange(256)))
    return bytes(changed)


def _shortened(data: bytes, chance: random.Random) -> bytes:
    start, end = sorted(chance.randrange(len(data) + 1) for _ in range(2))
    return chance.choice((data[:start], data[start:], data[:start] + data[end:], data + data[start:end]))


def _rewritten(data: bytes, change: Any) -> bytes:
    """The archive with its arrays changed, in good form otherwise."""
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        arrays: dict[str, Any] = dict(archive)
    change(arrays)
    file = io.BytesIO()
    np.savez(file, allow_pickle=False, **arrays)
    return file.getvalue()


def _header_changed(data: bytes, chance: random.Random) -> bytes:
    def change(arrays: dict[str, Any]) -> None:
        text = arrays["header"].tobytes()
        if chance.random() < 0.2:
            text = _bytes_changed(text, chance)
        else:
            header = json.loads(text)
            place: Any = header
            while True:
                key = chance.choice(keys(place))
                inner = place[key]
                if not is_container(inner) or not inner or chance.random() < 0.2:
                    break
                place = inner
            if chance.random() < 0.2:
                del place[key]
            elif chance.random() < 0.1 and isinstance(place, dict):
                place["more"] = 1
            else:
                place[key] = chance.choice(VALUES)
            text = json.dumps(header).encode()
        arrays["header"] = np.frombuffer(text, np.uint8)

    return _rewritten(data, change)


def _array_changed(data: bytes, chance: random.Random) -> bytes:
    def change(arrays: dict[str, Any]) -> None:
        name = chance.choice([name for name in arrays if chance.random() < 0.2 or arrays[name].size] or list(arrays))
        values = arrays[name]
        match chance.randrange(6):
            case 0:
                del arrays[name]
            case 1:
                arrays[name] = values[: chance.randrange(len(values) + 1)]
            case 2:
                arrays[name] = values.astype(chance.choice(TYPES))
            case 3:
                arrays[name] = (
                    values.reshape(chance.choice(((-1,), (1, -1), (-1, 1, 1)))) if values.size else values[None]
                )
            case _ if values.size:
                changed = values.copy()
                flat = changed.reshape(-1)
                number = chance.choice(NUMBERS)
                with np.errstate(all="ignore"):
                    flat[chance.randrange(flat.size)] = np.array(number).astype(values.dtype)
                arrays[name] = changed
            case _:
                arrays[name] = np.zeros((3, *values.shape[1:]), values.dtype)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return _rewritten(data, change)


DAMAGE = (_bytes_changed, _shortened, _header_changed, _array_changed)


def check(data: bytes) -> str | None:
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("error")
        path = Path(folder, "a.m3ir")
        path.write_bytes(data)
        try:
            scene = m3ir.read(path)
        except m3ir.FormatError as error:
            return None if str(error).isprintable() and len(str(error)) < 300 else f"a bad message: {error}"
        size = sum(column.nbytes for columns in scene.tables.values() for column in columns.values())
        if size > len(data):
            return f"{len(data)} bytes became {size}"
        m3ir.write(scene, path)  # what is sound can be written again
        with zipfile.ZipFile(path) as archive:
            assert archive.testzip() is None
    return fault(scene)


run = repeating(make, check)
