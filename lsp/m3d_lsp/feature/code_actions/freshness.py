"""Whether a block starts from nothing: then it is the same to write it out, or to take a copy of a variable.

A SURFACE changes the surface there is, so that a copy of a variable in its place would be something else wherever a
SURFACE came before it, or came along with a copied SOLID.
"""

from __future__ import annotations

from m3d_language.table import LANGUAGE
from m3dc.syntax.parse import ast

from ...names import Role, names
from .action import Site


def is_fresh(site: Site, path: tuple[ast.Item, ...]) -> bool:
    """Whether nothing was there that the innermost block of a path changes."""
    block = path[-1]
    if not isinstance(block, ast.Block):
        return False
    entry = LANGUAGE.blocks.get(block.keyword.text)
    if len(path) == 1 or (entry is not None and entry.adds):
        return True
    outer = path[-2]
    if not isinstance(outer, (ast.Block, ast.Assignment)) or outer.body is None:
        return False
    before = outer.body.items[: outer.body.items.index(block)]
    if any(isinstance(item, ast.Block) and item.keyword.text == block.keyword.text for item in before):
        return False
    if isinstance(outer, ast.Assignment):
        return outer.value is None and is_new(site, outer)
    return outer.name is None and is_fresh(site, path[:-1])


def is_new(site: Site, assignment: ast.Assignment) -> bool:
    """Whether nothing was assigned to the target of the site's item before it."""
    assert site.top is not None
    name = assignment.target.text
    return not any(
        occurrence.role is Role.ASSIGNMENT and occurrence.span[0] < site.top.start
        for occurrence in names(site.analysis).of(name)
    )
