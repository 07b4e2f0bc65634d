"""Values as they are written in a scene, short enough to read at a glance."""

from __future__ import annotations

from collections.abc import Iterable

from m3d_language.table import Default
from m3dc.meaning.transform import IDENTITY
from m3dc.meaning.values import Record, Value

# Parts of a block that are shown; of more only the number is.
MOST_PARTS = 3


def number(value: float) -> str:
    """Six digits; without a negative zero."""
    return f"{value + 0.0:.6g}"


def vector(value: Iterable[float]) -> str:
    """`< 1, 0, 0.5 >`"""
    return f"< {', '.join(number(component) for component in value)} >"


def value_text(value: Value) -> str:
    """A value of any type, on one line."""
    if isinstance(value, Record):
        return body(value)
    return vector(value) if isinstance(value, tuple) else number(value)


def body(record: Record) -> str:
    """What was said of a block: `{ COLOR < 1, 0, 0 > SPECULAR 0.5 }`. Default values are left out."""
    parts = [f"{keyword} {_argument(record.values[keyword])}".rstrip() for keyword in _written(record)]
    parts += [f"{keyword} {body(nested)}" for keyword, nested in record.nested.items()]
    shown = record.parts[:MOST_PARTS]
    parts += [f"{part.block} {body(part)}" for part in shown]
    if len(record.parts) > len(shown):
        parts.append(f"/* and {len(record.parts) - len(shown)} more */")
    for keyword, table in record.tables.items():
        rows = f"{len(table.rows)} row{'' if len(table.rows) == 1 else 's'}"
        parts.append(f"{keyword} {{ /* {rows} */ }}")
    if record.transform is not IDENTITY:
        parts.append("/* transformed */" if record.block == "TRANSFORM" else "TRANSFORM { /* ... */ }")
    return f"{{ {' '.join(parts)} }}" if parts else "{ }"


def _written(record: Record) -> list[str]:
    return [keyword for keyword in record.places if record.values.get(keyword, False) is not False]


def _argument(value: Default) -> str:
    if value is True or value is None:
        return ""
    if isinstance(value, tuple):
        return vector(value) if len(value) == 3 else ", ".join(number(component) for component in value)
    return number(value)
