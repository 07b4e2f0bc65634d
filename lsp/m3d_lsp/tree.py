"""Looking about in the concrete syntax tree: what stands at a place of the text, and in what."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node, Tree


def leaf_at(tree: Tree, offset: int) -> Node | None:
    """The token that holds a byte, or else ends there; None where there is only white space."""
    for start, end in ((offset, offset + 1), (offset - 1, offset)):
        node = tree.root_node.descendant_for_byte_range(max(start, 0), end) if end else None
        if node is not None and node.child_count == 0 and node.parent is not None and not node.is_missing:
            return node
    return None


def ancestors(node: Node | None) -> Iterator[Node]:
    """The node, what it stands in, and so on to the whole text."""
    while node is not None:
        yield node
        node = node.parent
