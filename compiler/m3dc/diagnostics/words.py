"""What to say of a keyword: where it belongs, what it takes, what stands in its block."""

from __future__ import annotations

from collections.abc import Sequence

from m3d_language.table import LANGUAGE, Block, Statement

CAPITALS = "keywords are in capitals"


def place_of(keyword: str, around: Sequence[str]) -> str:
    """Where a keyword belongs that can not stand in the innermost of the blocks `around` it: in a block that may stand
    in one of them, if there is such a block, else in any."""
    if keyword in LANGUAGE.reserved:
        return f"{keyword} is reserved, but has no meaning"
    if keyword in LANGUAGE.top or keyword == "VARIABLES":
        return f"{keyword} stands at the top level of the file"
    if keyword in LANGUAGE.basics:
        return f"{keyword} stands in VARIABLES"
    parents = LANGUAGE.parents.get(keyword, ())
    for depth, block in reversed([*enumerate(around)]):
        if block not in LANGUAGE.blocks:
            continue
        near = [parent for parent in LANGUAGE.blocks[block].holds if parent in parents]
        if near:
            innermost = depth == len(around) - 1
            within = f", in {block}" if innermost else f", beside {around[depth + 1]}"
            return f"{keyword} stands in {_listed(near)}{within}"
    return f"{keyword} stands in {_listed(parents)}" if parents else f"{keyword} can not stand here"


def _listed(parents: Sequence[str]) -> str:
    """Blocks by name; those of all textures as one."""
    textures = set(LANGUAGE.blocks["TEXTURE"].holds)
    names = [parent for parent in parents if parent not in textures]
    if len(names) < len(parents):
        names.append("the blocks of TEXTURE" if textures <= set(parents) else ", ".join(set(parents) & textures))
    return ", ".join(names)


def statement_of(block: str) -> str:
    """What the thesis calls a statement of a block: those of all textures alike."""
    return "TEXTURE Info" if block in LANGUAGE.blocks["TEXTURE"].holds else block


def takes(entry: Statement) -> str:
    """What a statement takes: `one number (radius)`."""
    if entry.is_flag:
        return "takes no argument"
    shape = {"integer": "whole number"}.get(entry.arguments[0].shape, entry.arguments[0].shape)
    names = ", ".join(argument.name.replace("_", " ") for argument in entry.arguments)
    count = {1: "one", 2: "two", 3: "three", 4: "four"}[len(entry.arguments)]
    return f"takes {count} {shape}{'s' * (len(entry.arguments) > 1)} ({names})"


def members(block: Block | None) -> tuple[str, ...]:
    """The keywords that may stand in a block, or at the top level."""
    return (*LANGUAGE.top, "VARIABLES") if block is None else block.members()
