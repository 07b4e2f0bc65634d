"""What the language table says of a keyword, in Markdown: for hover, completion and signature help."""

from __future__ import annotations

import re
from functools import cache

from m3d_language.phrases import facts, listed, table_facts, written
from m3d_language.table import LANGUAGE, Argument, Block, Statement, Table

from .documentation import page_of_block, page_of_variables
from .markdown import fenced


@cache
def keyword(word: str, block: str | None) -> str | None:
    """What a keyword means in a block, or at top level; where it may stand, if it may not stand there."""
    around = LANGUAGE.blocks.get(block or "")
    if around is not None and word in around.statements:
        return statement(around.statements[word], around)
    if around is not None and word in around.tables:
        return table(around.tables[word], around)
    if word in LANGUAGE.blocks:
        return of_block(LANGUAGE.blocks[word])
    if word in LANGUAGE.basics or word == "VARIABLES":
        return variables(word)
    parents = LANGUAGE.parents.get(word, ())
    if not parents:
        return f"`{word}` is reserved, and has no meaning." if word in LANGUAGE.reserved else None
    first = LANGUAGE.blocks[parents[0]]
    places = listed(f"`{parent}`" for parent in parents)
    says = first.statements[word].says if word in first.statements else first.tables[word].says
    return f"{fenced(word)}\nStands in {places}.\n\n{says}"


def statement(entry: Statement, block: Block) -> str:
    """A statement of a block."""
    unused = block.uses and entry.keyword not in block.uses
    return _card(
        form(entry),
        entry.says + (f" `{block.keyword}` makes no use of it." if unused else ""),
        facts(entry) or ["A flag: it takes no argument"],
        _example(entry.keyword, block) or _written(entry),
        _source(page_of_block(block.keyword), block.keyword, entry.thesis),
    )


def table(entry: Table, block: Block) -> str:
    """A table of a block."""
    source = _source(page_of_block(block.keyword), block.keyword, entry.thesis)
    return _card(table_form(entry), entry.says, table_facts(entry), _example(entry.keyword, block), source)


def of_block(block: Block) -> str:
    """A block, with all that may stand in it."""
    members = [*block.uses] if block.uses else [*block.members()]
    found = [f"{'Uses' if block.uses else 'Holds'} {', '.join(f'`{member}`' for member in members)}"]
    if parents := LANGUAGE.parents.get(block.keyword):
        found.append(f"Stands in {', '.join(f'`{parent}`' for parent in parents)}")
    if block.variable:
        found.append(f"A variable type: `{block.keyword} name` is a copy of a variable")
    if block.once:
        found.append("Only one")
    head = f"{block.keyword} name {{ ... }}" if block.variable else f"{block.keyword} {{ ... }}"
    return _card(head, block.says, found, block.example, _source(page_of_block(block.keyword), None, block.thesis))


def variables(word: str) -> str:
    """VARIABLES, or one of the two basic types."""
    basic = LANGUAGE.basics.get(word)
    if basic is None:
        about = LANGUAGE.variables
        types = "Types: " + ", ".join(f"`{name}`" for name in LANGUAGE.types)
        source = _source(page_of_variables(), None, about["thesis"])
        return _card("VARIABLES { TYPE name, name; }", about["says"], [types], about["example"], source)
    found = [f"Until one is assigned: `{written(basic.default)}`"]
    return _card(f"{word} name;", basic.says, found, "", _source(page_of_variables(), None, basic.thesis))


def form(entry: Statement) -> str:
    """How a statement is written: `REGION top, left, bottom, right`."""
    return f"{entry.keyword} {', '.join(_argument(argument) for argument in entry.arguments)}".rstrip()


def table_form(entry: Table) -> str:
    """How a table is written: `FACETS { facets  first second third  ... }`."""
    head, row = ([_argument(argument) for argument in part] for part in (entry.head, entry.row))
    return f"{entry.keyword} {{ {' '.join(head)}{'  ' if head else ''}{' '.join(row)}  ... }}"


def argument_name(argument: Argument) -> str:
    """What a person calls an argument."""
    return argument.name.replace("_", " ")


def _argument(argument: Argument) -> str:
    return f"< {', '.join(argument.components)} >" if argument.components else argument_name(argument)


def _card(head: str, says: str, found: list[str], example: str, source: str) -> str:
    parts = [fenced(head), says, "\n".join(f"- {fact}" for fact in found)]
    if example:
        parts.append(fenced(example))
    return "\n\n".join([*parts, source])


def _source(page: str | None, name: str | None, thesis: str) -> str:
    section = f"thesis {thesis}"
    return f"[Reference{f': {name}' if name else ''}]({page}), {section}" if page else section.capitalize()


def _example(word: str, block: Block) -> str:
    """The block's example, if the keyword is in it."""
    return block.example if re.search(rf"\b{word}\b", block.example) else ""


def _written(entry: Statement) -> str:
    """A statement with a value that it may well have."""
    value = next(iter(entry.often.values()), entry.default)
    if entry.is_flag or value is None:
        return ""
    return f"{entry.keyword} {written(value)}"
