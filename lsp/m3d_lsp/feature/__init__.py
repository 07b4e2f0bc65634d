"""What the server answers, a module a feature. Adding one is a module, and its name below."""

from . import (
    code_lens,
    colour,
    configuration,
    definition,
    diagnostics,
    folding,
    hierarchy,
    hover,
    inline_values,
    links,
    references,
    rename,
    selection,
    semantic_tokens,
    symbols,
    workspace_symbols,
)

MODULES = (
    code_lens,
    colour,
    configuration,
    definition,
    diagnostics,
    folding,
    hierarchy,
    hover,
    inline_values,
    links,
    references,
    rename,
    selection,
    semantic_tokens,
    symbols,
    workspace_symbols,
)
