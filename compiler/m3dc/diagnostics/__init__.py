"""What is wrong in a scene: the catalogue, findings, levels, directives, and how they are shown."""

from . import catalogue
from .findings import Diagnostic, Findings, Fix, Related, all_certain, placed

__all__ = ["Diagnostic", "Findings", "Fix", "Related", "all_certain", "catalogue", "placed"]
