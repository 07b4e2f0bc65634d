"""What the server answers, a module a feature. Adding one is a module, and its name below."""

from . import (
    configuration,
    definition,
    diagnostics,
    folding,
    hierarchy,
    hover,
    links,
    references,
    rename,
    selection,
    semantic_tokens,
    symbols,
    workspace_symbols,
)

MODULES = (
    configuration,
    definition,
    diagnostics,
    folding,
    hierarchy,
    hover,
    links,
    references,
    rename,
    selection,
    semantic_tokens,
    symbols,
    workspace_symbols,
)
