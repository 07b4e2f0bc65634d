"""One canonical layout for scenes."""

from .atoms import FormatError
from .edits import Edit, edits, format, format_range

__all__ = ["Edit", "FormatError", "edits", "format", "format_range"]
