"""The compiler of the Mirage3D scene language.

>>> result = compile("SOLID { SPHERE { RADIUS 2 } }")
>>> result.ir["spheres"]["radius"].tolist()
[2.0]
"""

# NumPy first: its import is deep. Where the stack of Python crosses the end of a piece, every call there maps a new
# piece and gives it back again, and from within our own imports that comes to a tenth of the start.
import numpy as _numpy  # noqa: F401  # pyright: ignore[reportUnusedImport]

from .compiler import Result, compile
from .diagnostics import Diagnostic, Fix, Related
from .ir import SceneIR
from .text.source import Source

__all__ = ["Diagnostic", "Fix", "Related", "Result", "SceneIR", "Source", "compile"]
