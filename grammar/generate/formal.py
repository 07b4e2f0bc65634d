"""The formal grammar, m3d.lark: a hand-written part, and a production for every block, statement and table.

A statement with the same arguments in several blocks is one production, named as its keyword. Where one keyword has
several forms, a production's name says which: `scale_vector` and `scale_number`, `polygons_vertices` and
`terrain_vertices`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from string import Template

from m3d_language.table import Argument, Block, Language, Statement, Table

SHAPES = {"number": "number", "integer": "number", "vector": "vector"}
WIDTH = 100


@dataclass
class Rules:
    """The productions so far, and what they are called."""

    language: Language
    statements: dict[str, str] = field(default_factory=dict[str, str])
    tables: dict[str, str] = field(default_factory=dict[str, str])

    def member(self, block: Block, keyword: str) -> str:
        """The name of the production for a member of a block; the production is added."""
        if statement := block.statements.get(keyword):
            name = self._statement_name(statement)
            arguments = ' "," '.join(_shape(argument) for argument in statement.arguments)
            self.statements[name] = f"{name}: {keyword} {arguments}".rstrip()
            return name
        if table := block.tables.get(keyword):
            name = self._table_name(block, table)
            head = [_shape(argument) for argument in table.head]
            row = [_shape(argument) for argument in table.row]
            rows = f"{row[0]}*" if len(row) == 1 else f"({' '.join(row)})*"
            self.tables[name] = " ".join([f"{name}:", keyword, '"{"', *head, rows, '"}"'])
            return name
        return keyword.lower()

    def _statement_name(self, statement: Statement) -> str:
        keyword = statement.keyword
        forms = {
            tuple(_shape(argument) for argument in block.statements[keyword].arguments)
            for block in self.language.blocks.values()
            if keyword in block.statements
        }
        if len(forms) == 1 and keyword not in self.language.blocks:
            return keyword.lower()
        return "_".join([keyword.lower(), *(_shape(argument) for argument in statement.arguments)])

    def _table_name(self, block: Block, table: Table) -> str:
        tables = [
            other.tables[table.keyword] for other in self.language.blocks.values() if table.keyword in other.tables
        ]
        same = all(other.head == table.head and other.row == table.row for other in tables)
        return table.keyword.lower() if same else f"{block.keyword}_{table.keyword}".lower()


def _shape(argument: Argument) -> str:
    return SHAPES[argument.shape]


def _alternatives(names: Iterable[str], indent: str) -> str:
    """`a | b | c`, broken into lines."""
    lines = [""]
    for name in names:
        if len(lines[-1]) + len(name) > WIDTH:
            lines.append("")
        lines[-1] += f"{' | ' if lines[-1] else ''}{name}"
    return f"\n{indent}| ".join(lines)


def _blocks(rules: Rules) -> str:
    """Every block's production, and that of its members; blocks with the same members share the first one's."""
    shared: dict[tuple[str, ...], list[Block]] = {}
    members = {
        block.keyword: tuple(rules.member(block, keyword) for keyword in block.members())
        for block in rules.language.blocks.values()
    }
    for block in rules.language.blocks.values():
        shared.setdefault(members[block.keyword], []).append(block)
    parts: list[str] = []
    for names, blocks in shared.items():
        member = f"{blocks[0].keyword.lower()}_member"
        body = '"{" ' + member + '* "}"'
        for block in blocks:
            form = f"(IDENTIFIER | [IDENTIFIER] {body})" if block.variable else body
            parts.append(f"{block.keyword.lower()}: {block.keyword} {form}\n")
        parts.append(f"?{member}: {_alternatives(names, ' ' * (len(member) + 1))}\n\n")
    return "".join(parts).rstrip()


def text(language: Language, template: str) -> str:
    """The text of m3d.lark."""
    rules = Rules(language)
    blocks = _blocks(rules)
    assigned: dict[str, None] = {}
    for block in language.blocks.values():
        if block.variable:
            assigned |= dict.fromkeys(rules.member(block, keyword) for keyword in block.members())
    return Template(template).substitute(
        top="\n     | ".join(keyword.lower() for keyword in language.top if keyword != "VARIABLES"),
        types=_alternatives(language.types, "    "),
        assigned=_alternatives(assigned, " " * 16),
        keywords="|".join(sorted(language.keywords)),
        blocks=blocks,
        statements="\n".join(sorted(rules.statements.values())),
        tables="\n".join(sorted(rules.tables.values())),
        terminals="\n".join(f"{word}: /{word}(?![A-Za-z0-9_])/" for word in sorted(language.keywords)),
    )
