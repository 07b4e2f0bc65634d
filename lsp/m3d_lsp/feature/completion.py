"""Completion, `textDocument/completion`: exactly what may stand at the cursor, says the formal grammar.

- keywords of the block, with what they do, and ready to be filled in; blocks with their usual statements. Before what
  they would be filled in with they are the bare word; those that the block has and can not have twice come last
- after the keyword of a block, its braces
- variables of the type that is wanted, with what they are worth
- values that are often wanted: colours, directions, the default

It works in text that is being typed: what is broken further up does not matter.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsprotocol import types

from m3d_language.formal import END
from m3d_language.phrases import written
from m3d_language.table import LANGUAGE, Argument, Block, Default, Statement
from m3dc.meaning.values import Value
from m3dc.syntax import ast
from m3dc.syntax.recovery import lexer

from .. import cursor, explain, snippets
from ..comments import about_variable, comments
from ..cursor import Cursor
from ..markdown import escaped, fenced, markup, shown
from ..names import names
from ..registry import request
from ..snapshot import Snapshot
from ..summary import value_text

# The order in which kinds of proposals are listed.
FIRST, SECOND, THIRD, LAST = "1", "2", "3", "4"

# What a block may hold more than once, besides the blocks that add something: these add to one another.
REPEATED = {"TRANSFORM", "COLORS"}

# The tokens that a keyword or a target is filled in with.
FILLING = frozenset(("{", "<", "=", "number", "word", "+", "-", "."))
_BRACE_OR_WORD = re.compile(rb"[{}]|\b[A-Z][A-Z0-9]*\b")
# How far around the cursor the members of its block are looked for, in bytes.
NEAR = 20_000


@request(
    types.TEXT_DOCUMENT_COMPLETION,
    types.CompletionOptions(trigger_characters=[" ", "<", ","], resolve_provider=False),
    nothing=types.CompletionList(is_incomplete=False, items=[]),
)
def completion(snapshot: Snapshot, params: types.CompletionParams) -> types.CompletionList:
    """What may stand at the cursor."""
    offset = snapshot.offset(params.position)
    place = cursor.read(snapshot, offset)
    typed = snapshot.text.data[place.word[0] : offset]
    # A number that is being typed is complete as it is.
    begins = typed[:1].isalpha() or not typed
    items = list(_proposals(snapshot, place)) if begins and _is_asked_for(place, params.context) else []
    if typed and begins and not any(_fits(item, typed) for item in items):
        # What was begun can not go on so: another member may begin here.
        items += [item for item in _proposals(snapshot, cursor.instead(place)) if _fits(item, typed)]
    insert, replace = snapshot.range(place.word), snapshot.range((place.word[0], _word_end(snapshot, place)))
    for item in items:
        text = item.insert_text or item.label
        both = snapshot.client.insert_replace
        item.text_edit = types.InsertReplaceEdit(text, insert, replace) if both else types.TextEdit(insert, text)
        item.insert_text = None
    for item in items:
        if isinstance(item.kind, types.CompletionItemKind):
            item.kind = snapshot.client.shown(item.kind)
    return types.CompletionList(is_incomplete=False, items=items)


def _fits(item: types.CompletionItem, typed: bytes) -> bool:
    """Whether a proposal begins with what is typed, whatever its letters."""
    return (item.filter_text or item.label).casefold().startswith(typed.decode("ascii", "replace").casefold())


def _is_asked_for(place: Cursor, context: types.CompletionContext | None) -> bool:
    """Whether a space was typed where a value must follow; after any other, nobody asked for proposals."""
    if context is None or context.trigger_character != " ":
        return True
    return place.last is not None and (place.last.terminal in LANGUAGE.keywords or place.last.terminal == "EQUAL")


def _proposals(snapshot: Snapshot, place: Cursor) -> Iterator[types.CompletionItem]:
    expected = place.prefix.expected
    if "IDENTIFIER" in expected or "LANGLE" in expected or "NUMERAL" in expected:
        yield from _values(snapshot, place)
        yield from _variables(snapshot, place)
    allowed = _members(place)
    there = _there_already(snapshot, place)
    present = _present(snapshot, place)
    filled = _is_followed(snapshot, place)
    for word in sorted((expected & LANGUAGE.keywords) - there):
        if allowed is None or word in allowed:
            item = _keyword(snapshot, place, word, bare=filled)
            item.sort_text = (LAST if word in present else _order(place, word)) + word
            yield item
    if "LBRACE" in expected and place.word[0] == place.word[1] and not filled:
        yield from _braces(snapshot, place)


def _word_end(snapshot: Snapshot, place: Cursor) -> int:
    return lexer.word_end(snapshot.text.data, place.word[1])


def _is_followed(snapshot: Snapshot, place: Cursor, what: frozenset[str] = FILLING) -> bool:
    """Whether what a keyword or a target would be filled in with stands behind the cursor's word already: a brace, an
    argument, the name that a block copies, an equals sign. `what` are the kinds of tokens that count. A word that is
    assigned to is none of them: it begins an item."""
    ahead = lexer.next_tokens(snapshot.text.data, _word_end(snapshot, place), 2)
    if not ahead:
        return False
    is_target = ahead[0].kind == "word" and len(ahead) > 1 and ahead[1].kind == "="
    return not is_target and (ahead[0].kind if ahead[0].kind != "other" else ahead[0].text) in what


# --- keywords -----------------------------------------------------------------------------------------------------


def _members(place: Cursor) -> set[str] | None:
    """What the body around the cursor may hold, where the grammar alone can not tell: what is assigned to a variable
    depends on its type."""
    inside = place.prefix.opened and place.prefix.opened[-1].target is not None
    return set(place.block.members()) if inside and place.block is not None else None


def _there_already(snapshot: Snapshot, place: Cursor) -> set[str]:
    """The blocks around the cursor that a scene has once, and has."""
    found: set[str] = set()
    if not place.prefix.opened:
        for top in snapshot.analysis.items:
            # What is being typed may be taken for what it is on the way to.
            if isinstance(top.item, (ast.Block, ast.Variables)) and top.start != place.word[0]:
                found.add(top.item.keyword.text)
    elif place.block is not None and place.block.keyword == "SCENE":
        for top in snapshot.analysis.items:
            if isinstance(top.item, ast.Block) and top.item.keyword.text == "SCENE" and top.item.body is not None:
                found |= {item.keyword.text for item in top.item.body.items if isinstance(item, ast.Block)}
    return {word for word in found if word == "VARIABLES" or LANGUAGE.blocks[word].once}


def _present(snapshot: Snapshot, place: Cursor) -> set[str]:
    """The keywords that the block around the cursor holds and can not well hold again."""
    if not place.prefix.opened or place.block is None or place.block.keyword in REPEATED or _declares(place):
        return set()
    data, remarks = snapshot.text.data, comments(snapshot.analysis)
    start, end = place.word[0], _word_end(snapshot, place)
    found: set[str] = set()
    before = list(_BRACE_OR_WORD.finditer(data, max(start - NEAR, 0), start))
    for matches, opening in ((reversed(before), b"}"), (_BRACE_OR_WORD.finditer(data, end, end + NEAR), b"{")):
        depth = 0
        for match in matches:
            if remarks.at(match.start()) is not None:
                continue
            text = match[0].decode("ascii")
            if match[0] in b"{}":
                depth += 1 if match[0] == opening else -1
                if depth < 0:
                    break
            elif depth == 0:
                if text in LANGUAGE.top:
                    break
                found.add(text)
    adding = {keyword for keyword, block in LANGUAGE.blocks.items() if block.adds}
    return found - adding - REPEATED


def _braces(snapshot: Snapshot, place: Cursor) -> Iterator[types.CompletionItem]:
    """After the keyword of a block or table, or the name that it copies, what stands in its braces."""
    last = place.last
    if last is None or (last.terminal != "IDENTIFIER" and last.terminal not in LANGUAGE.keywords):
        return
    if last.terminal == "IDENTIFIER":
        snippet, detail = "{ $0 }", "what changes the copy"
    else:
        snippet, detail = _snippet(last.text, place.block), f"what stands in {last.text}"
    yield _in_braces(snapshot, snippet.removeprefix(last.text).lstrip(), detail)


def _in_braces(snapshot: Snapshot, snippet: str, detail: str) -> types.CompletionItem:
    """Braces with a snippet in them; an empty pair for a client that knows no snippets."""
    item = types.CompletionItem(
        "{ ... }", kind=types.CompletionItemKind.Snippet, detail=detail, sort_text=THIRD, insert_text="{ }"
    )
    if snapshot.client.snippets:
        item.insert_text, item.insert_text_format = snippet, types.InsertTextFormat.Snippet
    return item


def _keyword(snapshot: Snapshot, place: Cursor, word: str, *, bare: bool) -> types.CompletionItem:
    client = snapshot.client
    block = None if _declares(place) else place.block
    said = explain.keyword(word, block.keyword if block else None)
    snippet = word if _declares(place) else _snippet(word, block)
    flag = snippet == word
    item = types.CompletionItem(
        word,
        kind=_kind(word, block),
        documentation=markup(said, markdown=client.completion_markdown) if said else None,
    )
    if client.snippets and not flag and not bare:
        item.insert_text, item.insert_text_format = snippet, types.InsertTextFormat.Snippet
    entry = block.statements.get(word) if block else None
    if entry is not None:
        item.detail = explain.form(entry)
    return item


def _declares(place: Cursor) -> bool:
    """Whether the cursor is among declarations, where the keyword of a block is a type."""
    return bool(place.prefix.opened) and place.prefix.opened[-1].keyword == "VARIABLES"


def _snippet(word: str, block: Block | None) -> str:
    if block is not None and word in block.statements:
        return snippets.statement(block.statements[word], block)
    if block is not None and word in block.tables:
        return snippets.table(block.tables[word], block)
    if word in LANGUAGE.blocks:
        return snippets.of_block(LANGUAGE.blocks[word])
    return snippets.variables() if word == "VARIABLES" else word


def _kind(word: str, block: Block | None) -> types.CompletionItemKind:
    if block is not None and word in block.statements:
        flag = block.statements[word].is_flag
        return types.CompletionItemKind.Keyword if flag else types.CompletionItemKind.Property
    if block is not None and word in block.tables:
        return types.CompletionItemKind.Struct
    return types.CompletionItemKind.Class if word in LANGUAGE.blocks else types.CompletionItemKind.Keyword


def _order(place: Cursor, word: str) -> str:
    """What a block usually holds comes first, what a texture makes no use of last."""
    if place.block is None:
        return FIRST
    if place.block.uses and word not in place.block.uses:
        return THIRD
    return FIRST if word in place.block.usual else SECOND


# --- variables ----------------------------------------------------------------------------------------------------


def _variables(snapshot: Snapshot, place: Cursor) -> Iterator[types.CompletionItem]:
    wanted = _wanted_type(snapshot, place)
    if "IDENTIFIER" not in place.prefix.expected or wanted is None:
        return
    known = names(snapshot.analysis)
    start = place.word[0]
    target = place.prefix.member[0].text if wanted and place.prefix.member else None
    for name, declaration in known.declared().items():
        if declaration.span[0] > start or (wanted and declaration.type != wanted) or name == target:
            continue
        value = snapshot.analysis.variable(name, start)
        last = known.last_assignment(name, start)
        said = about_variable(snapshot.analysis, name, last.span if last is not None else None)
        text = "\n\n".join(escaped(remark) for remark in said)
        item = types.CompletionItem(
            name,
            kind=_variable_kind(value),
            documentation=markup(text, markdown=snapshot.client.completion_markdown) if said else None,
            detail=declaration.type if value is None else f"{declaration.type} = {value_text(value)}",
            sort_text=FIRST + name,
        )
        if not wanted and snapshot.client.snippets and not _is_followed(snapshot, place):
            item.insert_text, item.insert_text_format = f"{name} = $0", types.InsertTextFormat.Snippet
        yield item


def _wanted_type(snapshot: Snapshot, place: Cursor) -> str | None:
    """The type of variable that may stand at the cursor: '' for any, None for none."""
    last = place.last
    if _declares(place):
        return None
    if place.slot is not None:
        return "VECTOR" if place.slot.argument.components and place.slot.component is None else "NUMBER"
    if END in place.prefix.expected:
        return ""
    if last is None:
        return None
    target = place.prefix.member[0]
    if target.terminal == "IDENTIFIER":
        if any(token.terminal == "LANGLE" for token in place.prefix.member):
            return "NUMBER"
        return names(snapshot.analysis).type(target.text) or ""
    if last.terminal in LANGUAGE.blocks and LANGUAGE.blocks[last.text].variable:
        return last.text
    return None


def _variable_kind(value: Value | None) -> types.CompletionItemKind:
    return types.CompletionItemKind.Constant if isinstance(value, (int, float)) else types.CompletionItemKind.Variable


# --- values -------------------------------------------------------------------------------------------------------


def _values(snapshot: Snapshot, place: Cursor) -> Iterator[types.CompletionItem]:
    """Values that are often wanted, by what they mean, and the default; for an assignment, the form of its value."""
    slot, entry = place.slot, place.entry
    if slot is None:
        yield from _assigned(snapshot, place)
        return
    if slot.component is not None:
        return
    often: dict[str, Default] = dict(entry.often if isinstance(entry, Statement) else slot.argument.often)
    default = entry.default if isinstance(entry, Statement) and len(entry.arguments) == 1 else None
    if default is not None and default not in often.values():
        often["the default"] = default
    if slot.argument.components and _is_followed(snapshot, place, frozenset("<")):
        return
    for number, (label, value) in enumerate(often.items()):
        yield _value(snapshot, slot.argument, label, value, number)
    if slot.argument.components:
        yield _form(snapshot, slot.argument)


def _value(snapshot: Snapshot, argument: Argument, label: str, value: Default, number: int) -> types.CompletionItem:
    text = written(value)
    color = value if argument.kind == "color" and isinstance(value, tuple) else None
    return types.CompletionItem(
        label if argument.components else text,
        kind=types.CompletionItemKind.Color if color else types.CompletionItemKind.Value,
        detail=text if argument.components else label,
        documentation=None if color is None else _swatch(snapshot, color),
        insert_text=text,
        filter_text=f"{label} {text}",
        sort_text=f"{SECOND}{number:03}",
    )


def _swatch(snapshot: Snapshot, color: tuple[float, ...]) -> str | types.MarkupContent:
    """The number of a colour: clients that show a swatch of their own look for it in plain text."""
    if not snapshot.client.images:
        return shown(color, images=False).strip("`")
    return markup(f"{shown(color, images=True)}\n\n{fenced(written(color))}", markdown=True)


def _form(snapshot: Snapshot, argument: Argument) -> types.CompletionItem:
    """The vector to be filled in."""
    form = f"< {', '.join(argument.components)} >"
    item = types.CompletionItem(
        form, kind=types.CompletionItemKind.Snippet, detail=argument.says, sort_text=THIRD, insert_text="< "
    )
    if snapshot.client.snippets:
        item.insert_text, item.insert_text_format = snippets.vector((0.0, 0.0, 0.0)), types.InsertTextFormat.Snippet
    return item


def _assigned(snapshot: Snapshot, place: Cursor) -> Iterator[types.CompletionItem]:
    """After `name =`: what a value of the variable's type looks like."""
    if place.last is None or place.last.terminal != "EQUAL" or _is_followed(snapshot, place, frozenset("{<")):
        return
    type_ = names(snapshot.analysis).type(place.prefix.member[0].text) or ""
    if type_ == "VECTOR":
        yield _form(snapshot, LANGUAGE.kinds["point"])
    elif type_ in LANGUAGE.blocks:
        snippet = snippets.of_block(LANGUAGE.blocks[type_]).removeprefix(type_).lstrip()
        yield _in_braces(snapshot, snippet, f"the statements of a {type_}")
