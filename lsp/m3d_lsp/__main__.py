"""`python -m m3d_lsp`."""

import sys

from .cli import main

sys.exit(main())
