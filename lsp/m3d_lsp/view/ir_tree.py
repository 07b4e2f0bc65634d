"""`m3d/irTree`: the compiled scene as a tree: what it says once, and its tables, row by row and column by column.

One sees what a renderer is given, and for each row where in the text it comes from.
"""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Mapping
from enum import IntEnum
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from m3dc.ir import Columns, LightKind, PrimitiveKind, SceneIR, TextureKind

from ..given import Given
from ..good import Good, last_good
from ..registry import server_request

if TYPE_CHECKING:
    from ..server import Server

Node = dict[str, Any]

MOST_ROWS = 500  # of one table
KINDS: Mapping[str, type[IntEnum]] = {"primitives": PrimitiveKind, "textures": TextureKind, "lights": LightKind}


@server_request("m3d/irTree")
async def ir_tree(server: Server, params: Any) -> SimpleNamespace:
    """The IR of a document, of its last version without errors."""
    good = await last_good(server, Given(params).uri())
    nodes = await asyncio.to_thread(lambda: list(_tree(good)))
    return SimpleNamespace(version=good.snapshot.version, stale=good.stale, nodes=nodes)


def _tree(good: Good) -> Iterator[Node]:
    ir = good.snapshot.analysis.ir
    yield {**_fields("scene", ir.scene, good, ir), **_place(good, ir.scene.spans.get("SCENE"))}
    for name, table in ir.tables.items():
        count = len(next(iter(table.values())))
        children = [_row(name, table, row, good) for row in range(min(count, MOST_ROWS))]
        if count > MOST_ROWS:
            children.append({"label": f"... and {count - MOST_ROWS} more"})
        yield {"label": name, "description": "1 row" if count == 1 else f"{count} rows", "children": children}


def _fields(label: str, record: Any, good: Good, ir: SceneIR) -> Node:
    """A record of what the scene says once; a record within it is a node with the place of its block."""
    children: list[Node] = []
    for name, value in record._asdict().items():
        if name == "spans":
            continue
        if hasattr(value, "_asdict"):
            inner = _fields(name, value, good, ir)
            children.append({**inner, **_place(good, ir.scene.spans.get(name.upper()))})
        else:
            children.append({"label": name, "description": _shown(value)})
    return {"label": label, "children": children}


def _row(name: str, table: Columns, row: int, good: Good) -> Node:
    """A row of a table: what it is, for one that can be several things, and its columns."""
    node: Node = {"label": str(row)}
    columns: list[Node] = []
    for column, values in table.items():
        if column == "span":
            start, end = values[row].tolist()
            node.update(_place(good, (start, end)))
        elif column == "offset":
            start = int(values[row])
            node.update(_place(good, (start, start + 1)))
        else:
            value = values[row]
            shown = KINDS[name](int(value)).name if column == "kind" else _shown(value)
            columns.append({"label": column, "description": shown})
            if column == "kind":
                node["description"] = shown
    return {**node, "children": columns}


def _place(good: Good, span: tuple[int, int] | None) -> Node:
    return {} if span in (None, (0, 0)) else {"range": good.range(span)}


def _shown(value: Any) -> str:
    """A value for people: a matrix row by row, an unknown as such."""
    match value:
        case None:
            return "none"
        case bool() | np.bool_():
            return "yes" if bool(value) else "no"
        case tuple() | np.ndarray():
            array = cast("NDArray[Any]", value)
            parts = [_shown(part) for part in array]
            if np.ndim(array) == 2:
                return "; ".join(parts)
            return f"<{', '.join(parts)}>" if len(parts) == 3 else ", ".join(parts)
        case float() | np.floating():
            return f"{cast(Any, value) + 0.0:g}"
        case _:
            return str(cast(object, value))
