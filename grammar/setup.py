"""Builds the C extension (parser, scanner, reader of big tables), and takes the grammar's data into the package."""

import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_py import build_py


class BuildWithData(build_py):
    """Adds to the package what lies beside it in the source tree: the formal grammar and the queries."""

    def run(self) -> None:
        super().run()
        if not self.editable_mode:
            package = Path(self.build_lib, "m3d_language")
            (package / "queries").mkdir(parents=True, exist_ok=True)
            for file in ["m3d.lark", *map(str, Path("queries").glob("*.scm"))]:
                self.copy_file(file, str(package / file))


setup(
    cmdclass={"build_py": BuildWithData},
    ext_modules=[
        Extension(
            "m3d_language._binding",
            sources=["src/binding.c", "src/parser.c", "src/scanner.c", "src/table_reader.c"],
            depends=["src/table_reader.h", "src/tree_sitter/parser.h"],
            include_dirs=["src"],
            define_macros=[("Py_LIMITED_API", "0x030B0000")],
            extra_compile_args=["/std:c11", "/utf-8"]
            if sys.platform == "win32"
            else ["-std=c11", "-O2", "-fvisibility=hidden"],
            py_limited_api=True,
        )
    ],
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
