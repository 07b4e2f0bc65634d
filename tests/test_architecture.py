"""The invariants of ARCHITECTURE.md that a program can check."""

from __future__ import annotations

import ast
import importlib
import itertools
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

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


CRATES = sorted(folder.parent for folder in (ROOT / "renderer/crates").glob("*/src"))


def module_of(file: Path, source: Path) -> str:
    """A Rust file's module: `texture::wood` of texture/wood.rs, "" of lib.rs."""
    parts = file.relative_to(source).with_suffix("").parts
    return "::".join(parts[:-1] if parts[-1] in {"lib", "mod"} else parts)


def spread(path: str) -> Iterator[str]:
    """The single paths of one of a `use`: a::{b, c::d} is a::b and a::c::d."""
    before, opening, inside = path.partition("{")
    if not opening:
        yield path.partition(" as ")[0].strip()
        return
    depth, part = 0, ""
    for sign in inside.rstrip().removesuffix("}") + ",":
        if sign == "," and depth == 0:
            if part.strip():
                yield from spread(before + part.strip())
            part = ""
        else:
            depth += (sign == "{") - (sign == "}")
            part += sign


def rust_graph(crate: Path) -> dict[str, set[str]]:
    """Which modules of a crate name which others of it: in a `use`, or by a path within the code.

    A module that declares another (`mod wood;`) does not name it, but one that re-exports from it (`pub use`) does.
    What is for tests alone does not count.
    """
    source = crate / "src"
    files = {module_of(file, source): file for file in source.rglob("*.rs")}
    found: dict[str, set[str]] = {}
    for module, file in files.items():
        text = re.sub(r"//.*", "", file.read_text(encoding="utf-8")).split("#[cfg(test)]\nmod tests")[0]
        used = re.findall(r"\buse ((?:[^;{]|\{(?:[^{}]|\{[^{}]*\})*\})+);", text)
        code = re.sub(r"\buse [^;]+;", "", text)
        paths = [path for tree in used for path in spread(re.sub(r"\s+", " ", tree))]
        paths += re.findall(r"(?<![\w:])(?:\w+::)+\w+", code)
        children = {name.rpartition("::")[2] for name in files if name and name.rpartition("::")[0] == module}
        found[module] = set()
        for path in paths:
            first, *rest = path.split("::")
            here = module.split("::") if module else []
            if first in children:
                rest = [*here, first, *rest]
            elif first == "self":
                rest = [*here, *rest]
            elif first == "super":
                above = 1 + sum(1 for _ in itertools.takewhile("super".__eq__, rest))
                rest = [*here[: len(here) - above], *rest[above - 1 :]]
            elif first != "crate":
                continue
            named = ("::".join(rest[:length]) for length in range(len(rest), -1, -1))
            found[module].add(next(name for name in named if name in files))
        found[module] -= {module}
    return found


@pytest.mark.parametrize("crate", CRATES, ids=lambda crate: crate.name)
def test_no_modules_of_a_crate_name_each_other(crate: Path) -> None:
    assert circle(rust_graph(crate)) == []


def test_the_graph_of_a_crate_is_all_of_it(tmp_path: Path) -> None:
    files = {
        "lib.rs": "mod shape;\nmod ray;\npub use shape::{Bounds, sphere::Sphere};",
        "ray.rs": "use crate::shape::{self, sphere::{Circle, Sphere}};\nfn f() { crate::shape::cut(); }",
        "shape/mod.rs": "pub mod sphere;\n// use crate::ray;\nfn g() { sphere::h(std::mem::take) }",
        "shape/sphere.rs": "use super::super::ray::Ray;\n#[cfg(test)]\nmod tests { use crate::shape::Bounds; }",
    }
    for name, text in files.items():
        file = tmp_path / "src" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    arrows = rust_graph(tmp_path)
    assert arrows == {
        "": {"shape", "shape::sphere"},
        "ray": {"shape", "shape::sphere"},
        "shape": {"shape::sphere"},
        "shape::sphere": {"ray"},
    }
    assert circle(arrows) == ["shape", "shape::sphere", "ray", "shape"]


MAY_DEPEND = {
    "kernel": {"glam", "obvhs", "serde", "wide"},
    "ir": {"m3d-kernel", "glam", "rawzip", "serde", "serde_json"},
    "work": {"m3d-kernel", "rayon", "serde"},
    "python": {"m3d-kernel", "m3d-ir", "m3d-work", "glam", "numpy", "pyo3", "rayon"},
    "web": {"m3d-kernel", "m3d-ir"},
}


@pytest.mark.parametrize("crate", CRATES, ids=lambda crate: crate.name)
def test_crates_stand_one_upon_another(crate: Path) -> None:
    """The kernel and what reads scenes for it know no Python and no threads; `work` knows threads, `python` Python."""
    assert tomllib.loads((crate / "Cargo.toml").read_text())["dependencies"].keys() <= MAY_DEPEND[crate.name]


ROOMS = ("text", "columns", "diagnostics", "syntax", "meaning", "ir")
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


NUMERALS = ("1", "-12.50", ".5", "+1e-9")
OTHERS = ("any line of text", "../name.txt")


def test_the_server_reads_no_numerals() -> None:
    """What a number is worth it asks the analysis, and where numerals stand the compiler: no regular expression of the
    server matches one but not other things as well, and only `reading`, which reads JSON, converts to `float`."""
    folder = PACKAGES["m3d_lsp"]
    for file in folder.rglob("*.py"):
        name = ".".join(file.relative_to(folder.parent).with_suffix("").parts)
        if name.startswith("m3d_lsp.preview") or name in ("m3d_lsp.__main__", "m3d_lsp.frames"):
            continue  # `frames` reads the lengths of messages
        tree = ast.parse(file.read_text(encoding="utf-8"))
        calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
        floats = [call.lineno for call in calls if isinstance(call.func, ast.Name) and call.func.id == "float"]
        assert not floats or name == "m3d_lsp.reading", f"{file}:{floats}"
        given = [call.args[0] for call in calls if call.args and ast.unparse(call.func).startswith("re.")]
        inline = [argument.value for argument in given if isinstance(argument, ast.Constant)]
        held: list[Any] = list(vars(importlib.import_module(name)).values())
        patterns: list[re.Pattern[Any]] = [each for each in held if isinstance(each, re.Pattern)]
        patterns += [re.compile(text) for text in inline if isinstance(text, (str, bytes))]
        for pattern in patterns:
            if not any(_matches(pattern, other) for other in OTHERS):
                assert not any(_matches(pattern, numeral) for numeral in NUMERALS), f"{file}: {pattern.pattern!r}"


def _matches(pattern: re.Pattern[Any], text: str) -> bool:
    return bool(pattern.fullmatch(text if isinstance(pattern.pattern, str) else text.encode()))
