"""Diagnostics: what `m3dc` says, as the text is typed. Pushed after each look, or pulled by the client."""

from __future__ import annotations

from lsprotocol import types

from m3dc import Diagnostic
from m3dc.diagnostics import catalogue

from ..documentation import page_of
from ..registry import request
from ..snapshot import Snapshot

SOURCE = "m3dc"
SEVERITY = {
    "error": types.DiagnosticSeverity.Error,
    "warning": types.DiagnosticSeverity.Warning,
    "hint": types.DiagnosticSeverity.Hint,
}
# What has no effect is shown faded.
WITHOUT_EFFECT = {
    entry.code
    for entry in (
        catalogue.ASSIGNED_TO_ITSELF,
        catalogue.UNUSED_VARIABLE,
        catalogue.OVERWRITTEN,
        catalogue.PHONG_WITHOUT_NORMALS,
        catalogue.IDLE_IN_LIGHT,
        catalogue.NO_WAVE,
        catalogue.IDLE_IN_TEXTURE,
        catalogue.BLEND_ON_PLANE,
        catalogue.BACKGROUND_NEVER_SEEN,
        catalogue.AMBIENT_NOT_SAMPLED,
        catalogue.NOSHADOWS_WITHOUT_SHADOWS,
        catalogue.IDLE_IN_SURFACE,
        catalogue.UNUSED_VALUE,
        catalogue.HEIGHTS_OF_PLANES,
    )
}


def of(snapshot: Snapshot) -> list[types.Diagnostic]:
    """All diagnostics of a document, by the levels that are set; hints too."""
    levels = snapshot.settings.diagnostics.levels
    found: list[types.Diagnostic] = []
    for diagnostic in snapshot.analysis.diagnostics:
        shown = levels.apply([diagnostic])
        if not shown and diagnostic.severity == "hint" and not levels.allow & {diagnostic.code, "all"}:
            shown = [diagnostic]
        found.extend(lsp_diagnostic(snapshot, each) for each in shown)
    return found


def lsp_diagnostic(snapshot: Snapshot, diagnostic: Diagnostic) -> types.Diagnostic:
    """A diagnostic in LSP's form."""
    client = snapshot.client
    page = page_of(diagnostic.code) if client.pages_of_codes else None
    # A file that is still empty is no mistake while it is edited.
    empty = diagnostic.code == catalogue.EMPTY_FILE.code
    return types.Diagnostic(
        snapshot.range(diagnostic.span.bytes),
        diagnostic.message,
        severity=types.DiagnosticSeverity.Information if empty else SEVERITY[diagnostic.severity],
        code=diagnostic.code,
        code_description=types.CodeDescription(page) if page else None,
        source=SOURCE,
        tags=[types.DiagnosticTag.Unnecessary] if client.unnecessary and diagnostic.code in WITHOUT_EFFECT else None,
        related_information=[
            types.DiagnosticRelatedInformation(snapshot.location(place.span.bytes), place.message)
            for place in (diagnostic.related if client.related_places else ())
        ]
        or None,
    )


@request(
    types.TEXT_DOCUMENT_DIAGNOSTIC,
    types.DiagnosticOptions(inter_file_dependencies=False, workspace_diagnostics=False, identifier=SOURCE),
    nothing=types.RelatedFullDocumentDiagnosticReport([]),
)
def pull(snapshot: Snapshot, params: types.DocumentDiagnosticParams) -> types.DocumentDiagnosticReport:
    """The diagnostics of a document; that they are the same still, where the client has them already."""
    # By the text: a document that is closed and opened again may have the version it had with another text.
    known = f"{hash(snapshot.text.data)}:{hash(snapshot.settings.diagnostics)}"
    if params.previous_result_id == known:
        return types.RelatedUnchangedDocumentDiagnosticReport(known)
    return types.RelatedFullDocumentDiagnosticReport(of(snapshot), result_id=known)
