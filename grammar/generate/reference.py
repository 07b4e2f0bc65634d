"""The language reference in docs/language: a page for each part of the language, and an index."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from string import Template

from m3d_language.phrases import facts, listed, table_facts, written
from m3d_language.table import Block, Language, Page, Statement, Table

HEADER = "<!-- Generated from grammar/language.toml by `make generate`. -->\n"


ASSIGNMENTS = """\
A variable gets its value outside the blocks of the file, in one of these forms:

| form | meaning |
|---|---|
| `name = 3.5` | a `NUMBER` variable becomes this number |
| `name = < x, 0, 1 >` | a `VECTOR` variable becomes this vector; a component may be a `NUMBER` variable |
| `name = other` | a copy of another variable of the same type |
| `name = { ... }` | a variable of any other type is modified by the statements of such a block |
| `name = other { ... }` | first a copy, then modified |

In the same way `KEYWORD name` and `KEYWORD name { ... }` use a variable in a block.

Statements are carried out in the order of the file, and values are copied: a later change of a variable does not reach
what was made with it before. A name begins with a letter, goes on with letters, digits and underscores, has at most
$identifier characters and is not a keyword.
"""


def pages(language: Language) -> dict[str, str]:
    """The text of every page by the name of its file."""
    texts = {f"{page.name}.md": _page(language, page) for page in language.pages if page.name != "variables"}
    return {"README.md": _index(language), **texts, "variables.md": _variables(language)}


# --- pages ------------------------------------------------------------------------------------------------------


def _page(language: Language, page: Page) -> str:
    blocks = [block for block in language.blocks.values() if block.thesis == page.thesis]
    parts = [f"{HEADER}\n# {page.title}\n\n{page.says} Thesis: {page.thesis}.\n"]
    shared: list[Block] = []
    for block, following in zip(blocks, [*blocks[1:], None], strict=True):
        parts.append(_block(language, block))
        if not block.uses:
            parts += _members(block)
            continue
        shared.append(block)
        if following is None or not following.uses or following.members() != block.members():
            parts.append(_shared(shared))
            shared = []
    return "\n".join(parts)


def _shared(blocks: Sequence[Block]) -> str:
    """The statements of blocks that have the same ones."""
    names = listed(block.keyword for block in blocks)
    return f"## Statements of {names}\n\nEach may hold all of these, and says which it uses.\n\n" + "\n".join(
        _members(blocks[0])
    )


def _block(language: Language, block: Block) -> str:
    places = language.parents.get(block.keyword, ())
    where = [f"in {_links(language, places)}"] if places else []
    if block.keyword in language.top:
        where.append("at top level")
    about = [f"Stands {' and '.join(where)}."]
    if block.holds:
        about.append(f"Holds {_links(language, block.holds)}.")
    if block.uses:
        about.append(f"Uses {listed(f'`{keyword}`' for keyword in block.uses)}.")
    if block.variable:
        about.append("A variable type.")
    if block.adds:
        about.append("Any number of them.")
    if block.once:
        about.append(f"Only one: *{block.once}*.")
    return f"## {block.keyword}\n\n{block.says}\n\n```m3d\n{block.example}\n```\n\n{' '.join(about)}\n"


def _members(block: Block) -> list[str]:
    parts = [_statement(statement) for statement in block.statements.values()]
    return parts + [_table(table) for table in block.tables.values()]


def _statement(statement: Statement) -> str:
    arguments = ", ".join(f"*{argument.name}*" for argument in statement.arguments)
    head = f"### `{statement.keyword}` {arguments}".rstrip()
    return f"{head}\n\n{statement.says}\n\n{_list(facts(statement), statement.thesis)}"


def _table(table: Table) -> str:
    return f"### `{table.keyword}` {{ ... }}\n\n{table.says}\n\n{_list(table_facts(table), table.thesis)}"


def _list(found: Iterable[str], thesis: str) -> str:
    return "".join(f"- {fact}\n" for fact in [*found, f"Thesis: {thesis}"])


def _variables(language: Language) -> str:
    types = [f"| `{basic.keyword}` | {basic.says} | `{written(basic.default)}` |" for basic in language.basics.values()]
    for block in language.blocks.values():
        if block.variable:
            types.append(f"| {_link(language, block.keyword)} | {block.says} | an empty block |")
    return "\n".join(
        [
            f"{HEADER}\n# Variables\n\n{language.variables['says']} Thesis: {language.variables['thesis']}.\n",
            f"```m3d\n{language.variables['example']}\n```\n",
            "## Types\n\n| type | meaning | value until one is assigned |\n|---|---|---|",
            *types,
            "\n## Assignments\n",
            Template(ASSIGNMENTS).substitute(language.limits),
        ]
    )


def _index(language: Language) -> str:
    blocks = language.blocks.values()
    entries: list[str] = []
    for keyword in sorted(language.keywords):
        within = [block for block in blocks if keyword in block.statements or keyword in block.tables]
        places = [_link(language, block.keyword) for block in within]
        if keyword in language.blocks:
            kind = f"block {_link(language, keyword)}"
        elif keyword in language.basics:
            kind = "[variable type](variables.md)"
        elif keyword == "VARIABLES":
            kind = "[declarations](variables.md)"
        else:
            kind = "reserved, without a meaning" if keyword in language.reserved else ""
        use = f"in {', '.join(places)}" if places else ""
        entries.append(f"| `{keyword}` | {'; '.join(part for part in (kind, use) if part)} |")
    arguments = [
        f"| {kind} | {argument.shape} | {argument.unit} | {argument.says} |"
        for kind, argument in language.kinds.items()
    ]
    return "\n".join(
        [
            f"{HEADER}\n# Language reference\n\n{language.file_says} Thesis: 7.5.3.\n",
            *(f"- [{page.title}]({page.name}.md): {page.says}" for page in language.pages),
            "\nComments stand between `/*` and `*/`, and nest. Keywords are in capitals.\n",
            "## Arguments\n\n| kind | shape | unit | meaning |\n|---|---|---|---|",
            *arguments,
            "\n## Keywords\n\n| keyword | where |\n|---|---|",
            *entries,
            "",
        ]
    )


# --- phrases ----------------------------------------------------------------------------------------------------


def _link(language: Language, keyword: str) -> str:
    section = language.blocks[keyword].thesis
    page = next(page.name for page in language.pages if page.thesis == section)
    return f"[`{keyword}`]({page}.md#{keyword.lower()})"


def _links(language: Language, keywords: Iterable[str]) -> str:
    return listed(_link(language, keyword) for keyword in keywords)
