"""The snippets of VS Code: what a scene is put together from, ready to be filled in.

There is one for each block of the top level (`scene`, `solid`, `light`) with its usual statements, one more for each
block that it may hold besides (`scene-mirage`, `solid-plane`), and the same of TEXTURE (`texture-wood`). A single block
is offered by the language server, where it may stand. The values are those of the block's example in the table, or
defaults, each a place to stop at.
"""

from __future__ import annotations

import itertools
import json
import re
from collections.abc import Iterator

from m3d_language import example
from m3d_language.table import Block, Language, Statement

_VECTOR = re.compile(r"\t*\w+ <")
_STOP = re.compile(r"\$\{\d+:(.*?)\}")

# Characters of a block that is put on one line.
_SHORT = 60


def text(language: Language) -> str:
    """The text of snippets/m3d.json."""
    snippets = {prefix: _entry(language, prefix, block, members) for prefix, block, members in _choices(language)}
    snippets["variables"] = {
        "prefix": "variables",
        "description": language.variables["says"],
        "body": ["VARIABLES", "{", "\t${1:SURFACE} ${2:name};", "}"],
    }
    return json.dumps(dict(sorted(snippets.items())), indent=2, ensure_ascii=False) + "\n"


def _choices(language: Language) -> Iterator[tuple[str, Block, tuple[str, ...]]]:
    """The prefix, the block, and the members that the snippet shows."""
    heads = [language.blocks[keyword] for keyword in language.top if keyword in language.blocks]
    for head in (*heads, language.blocks["TEXTURE"]):
        yield head.keyword.lower(), head, head.usual
        for keyword in head.holds:
            if keyword not in head.usual:
                yield f"{head.keyword}-{keyword}".lower(), head, _with(language, head, keyword)


def _with(language: Language, head: Block, keyword: str) -> tuple[str, ...]:
    """The usual members and the block; it stands in the place of one that adds to the same list as it does."""
    if not language.blocks[keyword].adds:
        return (*head.usual, keyword)
    kept = [member for member in head.usual if member not in language.blocks or not language.blocks[member].adds]
    return (keyword, *kept)


def _entry(language: Language, prefix: str, block: Block, members: tuple[str, ...]) -> dict[str, str | list[str]]:
    told = language.blocks[members[0] if members[0] not in block.usual else members[-1]]
    plain = members == block.usual
    lines = _Body(language).lines(block, members)
    return {"prefix": prefix, "description": block.says if plain else told.says, "body": lines}


class _Body:
    """The lines of one snippet, its places to stop at numbered as they come."""

    def __init__(self, language: Language) -> None:
        self._language = language
        self._stops = 0

    def lines(self, block: Block, members: tuple[str, ...], depth: int = 0) -> list[str]:
        """The block as the formatter lays it out: on one line if it is short, or with each brace on a line."""
        tabs = "\t" * depth
        inner = [line for member in members for line in self._member(block, member, depth + 1)]
        line = f"{tabs}{block.keyword} {{ {' '.join(part.strip() for part in inner)} }}"
        if depth and len(_STOP.sub(r"\1", line)) <= _SHORT and not any(part.endswith("{") for part in inner):
            return [line]
        return [f"{tabs}{block.keyword}", f"{tabs}{{", *_lined_up(inner), f"{tabs}}}"]

    def _member(self, block: Block, keyword: str, depth: int) -> list[str]:
        tabs = "\t" * depth
        if keyword in block.tables:
            shown = example.table(block, keyword)
            if shown is None:
                raise ValueError(f"the example of {block.keyword} shows no {keyword}, which is usual in it")
            return [f"{tabs}{keyword} {self._filled(shown)}"]
        if keyword in block.statements:
            statement = block.statements[keyword]
            return [f"{tabs}{keyword} {self._filled(_values(block, statement))}".rstrip()]
        inner = self._language.blocks[keyword]
        if not inner.usual:
            return [f"{tabs}{keyword} {{ }}"]
        return self.lines(inner, inner.usual, depth)

    def _filled(self, values: str) -> str:
        """The text with each number a place to stop at."""
        return example.NUMBER.sub(self._stop, values.replace("}", "\\}"))

    def _stop(self, found: re.Match[str]) -> str:
        self._stops += 1
        return f"${{{self._stops}:{found[0]}}}"


def _lined_up(lines: list[str]) -> list[str]:
    """The vectors of consecutive statements begin in one column."""
    result: list[str] = []
    for vectors, group in itertools.groupby(lines, key=lambda line: _VECTOR.match(line) is not None):
        rows = [line.split(" <", 1) for line in group]
        width = max(len(row[0]) for row in rows)
        result += [f"{row[0]:<{width}} <{row[1]}" if vectors else " <".join(row) for row in rows]
    return result


def _values(block: Block, statement: Statement) -> str:
    """The arguments as the block's example has them, or the default's; of a vector without either, zeros."""
    if statement.is_flag:
        return ""
    vector = statement.arguments[0].shape == "vector"
    shown = example.values(block, statement)
    if shown is not None:
        return shown
    if vector:
        numbers = statement.default if isinstance(statement.default, tuple) else (0, 0, 0)
        return f"< {', '.join(f'{number:g}' for number in numbers)} >"
    if isinstance(statement.default, float | int):
        return f"{statement.default:g}"
    raise ValueError(f"{statement.keyword} is usual in {block.keyword}, but has neither an example there nor a default")
