"""What the client can show, as far as answers depend on it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from lsprotocol import types

Kind = TypeVar("Kind", types.SymbolKind, types.CompletionItemKind)

# The command by which a client that takes no code actions has edits made.
APPLY_EDIT = "m3d.applyEdit"

# What every client knows, and what stands for what only some do.
FIRST_SYMBOLS = frozenset(range(types.SymbolKind.File, types.SymbolKind.Array + 1))
FIRST_ITEMS = frozenset(range(types.CompletionItemKind.Text, types.CompletionItemKind.Reference + 1))
PLAINER = {
    types.SymbolKind.Object: types.SymbolKind.Class,
    types.CompletionItemKind.Struct: types.CompletionItemKind.Class,
    types.CompletionItemKind.Constant: types.CompletionItemKind.Variable,
}


@dataclass(frozen=True)
class Client:
    """`images` is whether pictures in Markdown are shown as such and not as their text; `resolves_edits` whether the
    edits of a code action can be asked for when it is chosen; `action_literals` whether it takes actions, and not only
    commands; `applies_edits` whether it changes a text when it is asked to; `most_folds` how many folding
    ranges it takes of a document, None for any number. `commands` are those of its own that a code lens may have,
    `is_told` whether it wants to hear when a document has been looked at (docs/protocol.md)."""

    hover_markdown: bool = False
    completion_markdown: bool = False
    signature_markdown: bool = False
    images: bool = False
    snippets: bool = False
    insert_replace: bool = False
    label_offsets: bool = False
    resolves_edits: bool = False
    action_literals: bool = False
    applies_edits: bool = False
    preferred_actions: bool = False
    symbol_trees: bool = False
    symbol_kinds: frozenset[int] = FIRST_SYMBOLS
    item_kinds: frozenset[int] = FIRST_ITEMS
    most_folds: int | None = None
    related_places: bool = False
    unnecessary: bool = False
    pages_of_codes: bool = False
    commands: frozenset[str] = frozenset()
    is_told: bool = False

    @classmethod
    def of(cls, capabilities: types.ClientCapabilities) -> Client:
        """From what a client says of itself at the start."""
        document = capabilities.text_document or types.TextDocumentClientCapabilities()
        item = document.completion.completion_item if document.completion else None
        signature = document.signature_help.signature_information if document.signature_help else None
        parameter = signature.parameter_information if signature else None
        action = document.code_action
        resolve = action.resolve_support if action and action.data_support else None
        symbols = document.document_symbol
        kinds = symbols.symbol_kind if symbols else None
        items = document.completion.completion_item_kind if document.completion else None
        # What it can show of a diagnostic, however it gets them.
        found = [each for each in (document.publish_diagnostics, document.diagnostic) if each is not None]
        folding = document.folding_range
        workspace = capabilities.workspace
        own = _own(capabilities.experimental)
        commands = own.get("commands")
        general = capabilities.general
        return cls(
            hover_markdown=bool(document.hover and _markdown(document.hover.content_format)),
            completion_markdown=bool(item and _markdown(item.documentation_format)),
            signature_markdown=bool(signature and _markdown(signature.documentation_format)),
            images=bool(general and general.markdown and general.markdown.parser),
            snippets=bool(item and item.snippet_support),
            label_offsets=bool(parameter and parameter.label_offset_support),
            insert_replace=bool(item and item.insert_replace_support),
            resolves_edits=bool(resolve and "edit" in resolve.properties),
            action_literals=bool(action and action.code_action_literal_support),
            applies_edits=bool(workspace and workspace.apply_edit),
            preferred_actions=bool(action and action.is_preferred_support),
            symbol_trees=bool(symbols and symbols.hierarchical_document_symbol_support),
            symbol_kinds=_numbers(kinds.value_set) if kinds and kinds.value_set else FIRST_SYMBOLS,
            item_kinds=_numbers(items.value_set) if items and items.value_set else FIRST_ITEMS,
            most_folds=folding.range_limit if folding else None,
            related_places=any(each.related_information for each in found),
            unnecessary=any(
                each.tag_support and types.DiagnosticTag.Unnecessary in each.tag_support.value_set for each in found
            ),
            pages_of_codes=any(each.code_description_support for each in found),
            commands=frozenset(map(str, cast("list[Any]", commands)) if isinstance(commands, list) else ()),
            is_told=own.get("analysed") is True,
        )

    def shown(self, kind: Kind) -> Kind:
        """A kind of symbol or completion item as this client can show it."""
        known = self.symbol_kinds if isinstance(kind, types.SymbolKind) else self.item_kinds
        return kind if kind in known else cast("Kind", PLAINER.get(kind, kind))


def _own(experimental: object) -> Mapping[str, Any]:
    """What a client says of how it gets on with this server."""
    own = cast("Mapping[str, Any]", experimental).get("m3d") if isinstance(experimental, Mapping) else None
    return cast("Mapping[str, Any]", own) if isinstance(own, Mapping) else dict[str, Any]()


def _numbers(kinds: Iterable[int]) -> frozenset[int]:
    return frozenset(map(int, kinds))


def _markdown(formats: object) -> bool:
    return isinstance(formats, (list, tuple)) and types.MarkupKind.Markdown in formats
