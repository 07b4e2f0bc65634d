"""`m3d/syntaxTree`: the concrete syntax tree of a document as it stands, errors and all.

For those who work on the grammar, and those who wonder how a text is read.
"""

from __future__ import annotations

import asyncio
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from tree_sitter import Node, TreeCursor

from ..given import Given
from ..good import newest, plain
from ..registry import server_request
from ..snapshot import Snapshot

if TYPE_CHECKING:
    from ..server import Server

MOST_NODES = 20_000
LONGEST_TEXT = 60  # of a leaf, in characters


@server_request("m3d/syntaxTree")
async def syntax_tree(server: Server, params: Any) -> SimpleNamespace:
    """The tree of a document's newest version."""
    snapshot = await newest(server, Given(params).uri())
    nodes = await asyncio.to_thread(_tree, snapshot)
    return SimpleNamespace(version=snapshot.version, stale=False, nodes=nodes)


def _tree(snapshot: Snapshot) -> list[dict[str, Any]]:
    """The top-level nodes with what is in them; after `MOST_NODES` it is said that there are more."""
    cursor = snapshot.analysis.tree.walk()
    root: dict[str, Any] = _shown(snapshot, cursor)
    path: list[dict[str, Any]] = [root]
    for _ in range(MOST_NODES):
        if cursor.goto_first_child():
            path[-1]["children"] = list[dict[str, Any]]()
        else:
            path.pop()
            while not cursor.goto_next_sibling():
                if not cursor.goto_parent():
                    return root.get("children", [])
                path.pop()
        node = _shown(snapshot, cursor)
        path[-1]["children"].append(node)
        path.append(node)
    root.setdefault("children", []).append({"label": "... and more"})
    return root["children"]


def _shown(snapshot: Snapshot, cursor: TreeCursor) -> dict[str, Any]:
    node = cursor.node
    assert node is not None
    label = node.type if node.is_named else f'"{node.type}"'
    shown: dict[str, Any] = {"label": f"missing {label}" if node.is_missing else label}
    described = [f"{cursor.field_name}:"] if cursor.field_name else []
    if node.is_named and not node.child_count:
        described.append(_text(snapshot, node))
    if described:
        shown["description"] = " ".join(described)
    shown["range"] = plain(snapshot.range((node.start_byte, node.end_byte)))
    return shown


def _text(snapshot: Snapshot, node: Node) -> str:
    text = snapshot.text.part((node.start_byte, min(node.end_byte, node.start_byte + 4 * LONGEST_TEXT)))
    text = " ".join(text.split())
    return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}..."
