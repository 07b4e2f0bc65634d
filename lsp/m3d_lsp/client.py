"""What the client can show, as far as answers depend on it."""

from __future__ import annotations

from dataclasses import dataclass

from lsprotocol import types


@dataclass(frozen=True)
class Client:
    """`images` is whether pictures in Markdown are shown as such and not as their text; `resolves_edits` whether the
    edits of a code action can be asked for when it is chosen."""

    hover_markdown: bool = False
    completion_markdown: bool = False
    signature_markdown: bool = False
    images: bool = False
    snippets: bool = False
    insert_replace: bool = False
    label_offsets: bool = False
    resolves_edits: bool = False

    @classmethod
    def of(cls, capabilities: types.ClientCapabilities) -> Client:
        """From what a client says of itself at the start."""
        document = capabilities.text_document or types.TextDocumentClientCapabilities()
        item = document.completion.completion_item if document.completion else None
        signature = document.signature_help.signature_information if document.signature_help else None
        parameter = signature.parameter_information if signature else None
        resolve = document.code_action.resolve_support if document.code_action else None
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
        )


def _markdown(formats: object) -> bool:
    return isinstance(formats, (list, tuple)) and types.MarkupKind.Markdown in formats
