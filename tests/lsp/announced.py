"""What a server says that it can answer, as requests to ask it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from lsprotocol import types

Place = tuple[types.TextDocumentIdentifier, types.Position]

# What each capability of a server promises: a request, and its parameters for a place in a document.
PROMISES: dict[str, tuple[str, Callable[[types.TextDocumentIdentifier, types.Position], Any]]] = {
    "diagnostic_provider": (types.TEXT_DOCUMENT_DIAGNOSTIC, lambda text, at: types.DocumentDiagnosticParams(text)),
    "hover_provider": (types.TEXT_DOCUMENT_HOVER, types.HoverParams),
    "completion_provider": (types.TEXT_DOCUMENT_COMPLETION, types.CompletionParams),
    "signature_help_provider": (types.TEXT_DOCUMENT_SIGNATURE_HELP, types.SignatureHelpParams),
    "definition_provider": (types.TEXT_DOCUMENT_DEFINITION, types.DefinitionParams),
    "declaration_provider": (types.TEXT_DOCUMENT_DECLARATION, types.DeclarationParams),
    "references_provider": (
        types.TEXT_DOCUMENT_REFERENCES,
        lambda text, at: types.ReferenceParams(types.ReferenceContext(True), text, at),
    ),
    "document_highlight_provider": (types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, types.DocumentHighlightParams),
    "document_symbol_provider": (
        types.TEXT_DOCUMENT_DOCUMENT_SYMBOL,
        lambda text, at: types.DocumentSymbolParams(text),
    ),
    "workspace_symbol_provider": (types.WORKSPACE_SYMBOL, lambda text, at: types.WorkspaceSymbolParams("a")),
    "code_action_provider": (
        types.TEXT_DOCUMENT_CODE_ACTION,
        lambda text, at: types.CodeActionParams(text, types.Range(at, at), types.CodeActionContext([])),
    ),
    "code_lens_provider": (types.TEXT_DOCUMENT_CODE_LENS, lambda text, at: types.CodeLensParams(text)),
    "document_link_provider": (types.TEXT_DOCUMENT_DOCUMENT_LINK, lambda text, at: types.DocumentLinkParams(text)),
    "color_provider": (types.TEXT_DOCUMENT_DOCUMENT_COLOR, lambda text, at: types.DocumentColorParams(text)),
    "document_formatting_provider": (
        types.TEXT_DOCUMENT_FORMATTING,
        lambda text, at: types.DocumentFormattingParams(text, types.FormattingOptions(2, True)),
    ),
    "document_range_formatting_provider": (
        types.TEXT_DOCUMENT_RANGE_FORMATTING,
        lambda text, at: types.DocumentRangeFormattingParams(
            text, types.Range(types.Position(0, 0), at), types.FormattingOptions(2, True)
        ),
    ),
    "rename_provider": (types.TEXT_DOCUMENT_PREPARE_RENAME, types.PrepareRenameParams),
    "folding_range_provider": (types.TEXT_DOCUMENT_FOLDING_RANGE, lambda text, at: types.FoldingRangeParams(text)),
    "selection_range_provider": (
        types.TEXT_DOCUMENT_SELECTION_RANGE,
        lambda text, at: types.SelectionRangeParams(text, [at]),
    ),
    "call_hierarchy_provider": (types.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY, types.CallHierarchyPrepareParams),
    "type_hierarchy_provider": (types.TEXT_DOCUMENT_PREPARE_TYPE_HIERARCHY, types.TypeHierarchyPrepareParams),
    "semantic_tokens_provider": (
        types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL,
        lambda text, at: types.SemanticTokensParams(text),
    ),
    "inlay_hint_provider": (
        types.TEXT_DOCUMENT_INLAY_HINT,
        lambda text, at: types.InlayHintParams(text, types.Range(types.Position(0, 0), at)),
    ),
    "inline_value_provider": (
        types.TEXT_DOCUMENT_INLINE_VALUE,
        lambda text, at: types.InlineValueParams(
            text, types.Range(types.Position(0, 0), at), types.InlineValueContext(0, types.Range(at, at))
        ),
    ),
}
VIEWS = ("m3d/dump", "m3d/irTree", "m3d/syntaxTree")


def announced(
    capabilities: types.ServerCapabilities, text: types.TextDocumentIdentifier, at: types.Position
) -> list[tuple[str, Any]]:
    """A request, and its parameters, for each thing that a server says it can do with a place in a document."""
    return [(method, make(text, at)) for name, (method, make) in PROMISES.items() if getattr(capabilities, name, None)]
