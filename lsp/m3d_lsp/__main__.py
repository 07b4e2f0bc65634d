"""`python -m m3d_lsp`."""

from .cli import run

run()
