"""The invariants of ARCHITECTURE.md that a program can check."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGES = {
    "m3d_language": ROOT / "grammar/m3d_language",
    "m3dc": ROOT / "compiler/m3dc",
    "m3d_render": ROOT / "renderer/m3d_render",
    "m3d_lsp": ROOT / "lsp/m3d_lsp",
    "mirage3d": ROOT / "suite/mirage3d",
}
FIGURES = {"matplotlib", "PIL"}
MAY_IMPORT = {
    "m3d_language": {"lark"},
    "m3dc": {"m3dc_command", "m3d_language", "tree_sitter", "numpy"},
    "m3d_render": {"m3dc", "m3dc_command", "numpy", "OpenImageIO", *FIGURES, "pyvista"},
    "m3d_lsp": {
        "m3dc",
        "m3dc_command",
        "m3d_render",
        "m3d_language",
        "tree_sitter",
        "numpy",
        "pygls",
        "lsprotocol",
        "attrs",
        "cattrs",
    },
    "mirage3d": {"m3d_render", "m3dc", "m3dc_command", "numpy"},
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


def graph(package: str) -> dict[str, set[str]]:
    """Which modules of a package import which others of it, be it within a function or for their types alone."""
    folder = PACKAGES[package]
    modules: dict[str, tuple[ast.Module, list[str]]] = {}
    for file in folder.rglob("*.py"):
        path = [package, *file.relative_to(folder).with_suffix("").parts]
        inside = path[:-1]
        name = ".".join(inside if path[-1] == "__init__" else path)
        modules[name] = ast.parse(file.read_text(encoding="utf-8")), inside
    native = {f"{package}.{file.stem}" for file in folder.rglob("*.pyi")}
    found: dict[str, set[str]] = {}
    for name, (tree, inside) in modules.items():
        named: set[str] = set()
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                named.update(alias.name for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                base = inside[: len(inside) + 1 - node.level] if node.level else []
                origin = ".".join([*base, *([node.module] if node.module else [])])
                each = {f"{origin}.{alias.name}" for alias in node.names}
                known = each & (modules.keys() | native)
                named |= known if known == each else known | {origin}
        found[name] = (named & modules.keys()) - {name}
    return found


def circle(arrows: Mapping[str, set[str]]) -> list[str]:
    """Names that lead to one another, or none."""
    done: set[str] = set()

    def follow(name: str, way: list[str]) -> list[str]:
        if name in way:
            return [*way[way.index(name) :], name]
        if name in done:
            return []
        for other in sorted(arrows.get(name, ())):
            if found := follow(other, [*way, name]):
                return found
        done.add(name)
        return []

    none: list[str] = []
    return next(filter(None, (follow(name, []) for name in sorted(arrows))), none)


@pytest.mark.parametrize("package", PACKAGES)
def test_no_modules_import_each_other(package: str) -> None:
    assert circle(graph(package)) == []


ROOMS = ("text", "diagnostics", "syntax", "meaning", "ir")
"""The compiler's folders from the ground up: each imports from those before it alone."""


def test_the_compilers_rooms_stand_one_upon_another() -> None:
    arrows: dict[str, set[str]] = {}
    for name, others in graph("m3dc").items():
        room = name.split(".")[1] if "." in name else ""
        arrows.setdefault(room, set()).update(other.split(".")[1] for other in others if "." in other)
    for below, room in enumerate(ROOMS):
        assert arrows[room] - {room} <= {*ROOMS[:below], "files"}, room
    assert arrows["format"] - {"format"} <= {"text", "diagnostics", "syntax"}
    assert arrows["files"] <= {"files"}


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
    compiler = loaded("import m3dc.commands.m3dc; m3dc.commands.m3dc.compile('SOLID { SPHERE { } }')")
    assert not compiler & {"pygls", "lsprotocol", "pyvista", "vtkmodules", "OpenImageIO", "lark", "m3d_render"}
    renderer = loaded("import m3d_render.cli")
    assert not renderer & {"pygls", "lsprotocol", "pyvista", "vtkmodules", "OpenImageIO", "lark"}
    assert not loaded("import m3d_render.plot.cli") & (FIGURES | {"OpenImageIO", "lark"})
    assert not loaded("import m3d_render.view.cli") & (FIGURES | {"pyvista", "vtkmodules", "OpenImageIO", "lark"})


def test_the_tree_knows_no_keyword() -> None:
    """No node of the syntax tree is named after a block or statement of the language."""
    from m3d_language.table import LANGUAGE

    tree = ast.parse((PACKAGES["m3dc"] / "syntax/ast.py").read_text(encoding="utf-8"))
    names = {node.name.upper() for node in ast.walk(tree) if isinstance(node, ast.ClassDef)}
    # What a number, a vector and a declaration look like is form; the types' names happen to be the same.
    assert names & LANGUAGE.keywords == {"NUMBER", "VECTOR", "VARIABLES"}
