"""What the server answers, a module a feature. Adding one is a module, and its name below."""

from . import (
    configuration,
    definition,
    diagnostics,
    references,
    rename,
    symbols,
)

MODULES = (
    configuration,
    definition,
    diagnostics,
    references,
    rename,
    symbols,
)
