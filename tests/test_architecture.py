"""The invariants of ARCHITECTURE.md that a program can check."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGES = {
    "tree_sitter_m3d": ROOT / "grammar/tree_sitter_m3d",
    "m3dc": ROOT / "compiler/m3dc",
    "m3d_render": ROOT / "renderer/m3d_render",
    "m3d_lsp": ROOT / "lsp/m3d_lsp",
}
FIGURES = {"matplotlib", "PIL"}
MAY_IMPORT = {
    "tree_sitter_m3d": {"lark"},
    "m3dc": {"m3dc_command", "tree_sitter_m3d", "tree_sitter", "numpy"},
    "m3d_render": {"m3dc", "m3dc_command", "numpy", "OpenImageIO", *FIGURES, "pyvista"},
    "m3d_lsp": {
        "m3dc",
        "m3dc_command",
        "m3d_render",
        "tree_sitter_m3d",
        "tree_sitter",
        "numpy",
        "pygls",
        "lsprotocol",
        "attrs",
        "cattrs",
    },
}


def imports(package: str) -> set[str]:
    """The top-level names that a package's modules import, those of the standard library and itself left out."""
    found: set[str] = set()
    for module in PACKAGES[package].rglob("*.py"):
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found.update(alias.name.split(".")[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                found.add(node.module.split(".")[0])
    return found - sys.stdlib_module_names - {package, "typing_extensions"}


@pytest.mark.parametrize("package", PACKAGES)
def test_dependencies_point_one_way(package: str) -> None:
    assert imports(package) <= MAY_IMPORT[package]


def test_only_figures_need_matplotlib() -> None:
    for module in PACKAGES["m3d_render"].rglob("*.py"):
        # Pillow comes with pyvista, too.
        names = {"plot": "none", "view": "matplotlib"}.get(module.parent.name, "matplotlib|PIL")
        assert not re.search(rf"^\s*(import|from) ({names})\b", module.read_text(), re.MULTILINE), module


def loaded(statement: str) -> set[str]:
    script = f"{statement}\nimport sys; print(*sorted({{name.split('.')[0] for name in sys.modules}}))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_a_command_line_loads_only_what_it_needs() -> None:
    compiler = loaded("import m3dc.cli; m3dc.cli.compile('SOLID { SPHERE { } }')")
    assert not compiler & {"pygls", "lsprotocol", "pyvista", "vtkmodules", "OpenImageIO", "lark", "m3d_render"}
    renderer = loaded("import m3d_render.cli")
    assert not renderer & {"pygls", "lsprotocol", "pyvista", "vtkmodules", "OpenImageIO", "lark"}
    assert not loaded("import m3d_render.plot.cli") & (FIGURES | {"OpenImageIO", "lark"})
    assert not loaded("import m3d_render.view.cli") & (FIGURES | {"pyvista", "vtkmodules", "OpenImageIO", "lark"})


def test_the_tree_knows_no_keyword() -> None:
    """No node of the syntax tree is named after a block or statement of the language."""
    from tree_sitter_m3d.table import LANGUAGE

    tree = ast.parse((PACKAGES["m3dc"] / "ast.py").read_text(encoding="utf-8"))
    names = {node.name.upper() for node in ast.walk(tree) if isinstance(node, ast.ClassDef)}
    # What a number, a vector and a declaration look like is form; the types' names happen to be the same.
    assert names & LANGUAGE.keywords == {"NUMBER", "VECTOR", "VARIABLES"}
