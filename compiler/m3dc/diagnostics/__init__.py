"""What is wrong in a scene: the catalogue, findings, levels, directives, and how they are shown."""

from . import catalogue
from .findings import Diagnostic, Finding, Findings, Fix, ItemFindings, Related, TextFindings, all_certain

__all__ = [
    "Diagnostic",
    "Finding",
    "Findings",
    "Fix",
    "ItemFindings",
    "Related",
    "TextFindings",
    "all_certain",
    "catalogue",
]
