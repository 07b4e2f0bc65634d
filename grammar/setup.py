"""Builds the C extension: the generated parser, its scanner and the reader of big tables."""

import sys

from setuptools import Extension, setup

setup(
    ext_modules=[
        Extension(
            "tree_sitter_m3d._binding",
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
