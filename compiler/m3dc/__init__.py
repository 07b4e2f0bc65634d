"""The compiler of the Mirage3D scene language.

>>> result = compile("SOLID { SPHERE { RADIUS 2 } }")
>>> result.ir["spheres"]["radius"].tolist()
[2.0]
"""

from .compiler import Result, compile
from .diagnostics import Diagnostic, Fix, Related
from .ir import SceneIR
from .source import Source

__all__ = ["Diagnostic", "Fix", "Related", "Result", "SceneIR", "Source", "compile"]
