"""Pieces of a scene to be filled in, made of the language table: a statement with its value, a block with its usual
statements. `$0` and `${1:text}` are LSP's tab stops. The values are those of the block's example, or defaults."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count

from m3d_language import example
from m3d_language.phrases import written
from m3d_language.table import LANGUAGE, Argument, Block, Default, Statement, Table

_STOP = re.compile(r"\$\{\d+:([^}]*)\}|\$\d")

# What stands for a value without a default, by the kind of argument, or else by its shape.
_PLAIN: dict[str, Default] = {"factor": 1.0, "factors": (1.0, 1.0, 1.0), "vector": (0.0, 0.0, 0.0)}

# Characters of a block that is put on one line.
_SHORT = 60


def statement(entry: Statement, block: Block) -> str:
    """`RADIUS ${1:5}`"""
    return _statement(entry, block, count(1))


def table(entry: Table, block: Block) -> str:
    """A table with its head and a row or two."""
    return _table(entry, block, count(1))


def of_block(block: Block) -> str:
    """A block with its usual statements: on one line, or each on its own."""
    return "\n".join([*_lines(block, count(1), 0, end="$0")])


def variables() -> str:
    """VARIABLES with one declaration."""
    return f"VARIABLES\n{{\n\t${{1|{','.join(LANGUAGE.types)}|}} ${{2:name}};$0\n}}"


def vector(value: tuple[float, ...]) -> str:
    """`< ${1:0}, ${2:0}, ${3:0} >`"""
    return _filled(written(value), count(1))


def _lines(block: Block, stops: Iterator[int], depth: int, end: str = "") -> Iterator[str]:
    inner = [line for keyword in block.usual for line in _member(block, keyword, stops, depth + 1)]
    inner += [end] if end else []
    line = f"{block.keyword} {{ {' '.join(inner)} }}"
    if len(_STOP.sub(r"\1", line)) <= _SHORT and not any(part == "{" for part in inner):
        yield line
    else:
        yield from (block.keyword, "{", *(f"\t{part}" for part in inner), "}")


def _member(block: Block, keyword: str, stops: Iterator[int], depth: int) -> Iterator[str]:
    if keyword in block.tables:
        yield _table(block.tables[keyword], block, stops)
    elif keyword in block.statements:
        yield _statement(block.statements[keyword], block, stops)
    else:
        yield from _lines(LANGUAGE.blocks[keyword], stops, depth)


def _statement(entry: Statement, block: Block, stops: Iterator[int]) -> str:
    if entry.is_flag:
        return entry.keyword
    return f"{entry.keyword} {_filled(example.values(block, entry) or _values(entry), stops)}"


def _values(entry: Statement) -> str:
    if entry.default is not None:
        return written(entry.default)
    return ", ".join(written(_value(argument)) for argument in entry.arguments)


def _value(argument: Argument) -> Default:
    return _PLAIN.get(argument.kind, _PLAIN.get(argument.shape, 0.0))


def _table(entry: Table, block: Block, stops: Iterator[int]) -> str:
    shown = example.table(block, entry.keyword)
    if shown is not None:
        return f"{entry.keyword} {_filled(shown, stops)}"
    head = ["1" for _ in entry.head]
    return f"{entry.keyword} {{ {_filled(' '.join([*head, *(written(_value(a)) for a in entry.row)]), stops)} }}"


def _filled(values: str, stops: Iterator[int]) -> str:
    """The text with each number a tab stop."""
    return example.NUMBER.sub(lambda number: f"${{{next(stops)}:{number[0]}}}", values)
