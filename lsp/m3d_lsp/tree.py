"""Looking about in the concrete syntax tree: what stands at a place of the text, and in what."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node, Tree

from tree_sitter_m3d.table import LANGUAGE, Block


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


def keyword_of(node: Node) -> str | None:
    """The keyword that a block, statement, table or VARIABLES begins with."""
    keyword = node.child_by_field_name("keyword")
    return keyword.type if keyword is not None else None


def block_around(node: Node | None) -> Block | None:
    """The block of the language whose body, or whose member, a node is in: for a keyword, the block it belongs to.

    None at top level, in VARIABLES, and in the body of an assignment, whose type only the variables tell."""
    inside = False
    for outer in ancestors(node):
        if outer.type == "body":
            inside = True
        elif inside and outer.type in ("block", "assignment"):
            return LANGUAGE.blocks.get(keyword_of(outer) or "")
    return None


def assignment_around(node: Node | None) -> Node | None:
    """The assignment in whose body a node stands directly, not in a block of it."""
    inside = False
    for outer in ancestors(node):
        if outer.type == "body":
            inside = True
        elif inside and outer.type == "block":
            return None
        elif inside and outer.type == "assignment":
            return outer
    return None
