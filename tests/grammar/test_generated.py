"""What is made of language.toml is current, and every keyword of it has arrived everywhere."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tree_sitter import Language, Parser

import m3d_language
from m3d_language.formal import first_error, parser
from m3d_language.table import LANGUAGE

ROOT = Path(__file__).parents[2]
GRAMMAR = ROOT / "grammar"
KEYWORDS = sorted(LANGUAGE.keywords)

# Appendix A of the thesis; it forgets NSAMPLES, a statement of AMBIENT.
APPENDIX_A = """
    AMBIENT AMPLITUDE ANGLE ASPECT ATTENUATION AZIMUTH BACKGROUND BUMPS CENTER CHECKER CLOUDS COLOR COLORS DAMP DENSITY
    DEPTH DIRECTION DISTANCE ELEVATION EXPONENT FACETS FOV FREQ FROM FUZZ GRADIENT GRANITE HARD HAZE HEIGHT HORIZONCOLOR
    ID IDENTITY INFINITE INTENSITY LIGHT LOCAL LOGSCALE LUMINANCE MARBLE METALLIC MIRAGE NOPHONG NOSHADOWS NOSPECULAR
    NUMBER OVERCAST PHASE PHONG PLANE POINT POLYGONS PRIMITIVES PROFILE RADIUS RECTANGLE REFINDEX REGION RIPPLES ROTATE
    ROTX ROTY ROTZ ROUGH SCALE SCALEX SCALEY SCALEZ SCENE SEGMENTS SFACETS SHADOWS SKY SLOPE SNOW SOLID SOURCE SPECULAR
    SPHERE SPOTTED SQUEEZE SUN SURFACE TERRAIN TEXTURE TILT TO TRANSLATE TRANSFORM TRANSX TRANSY TRANSZ TRIANGLE
    TURBULENCE UBLEND VARIABLES VBLEND VECTOR VERTEX1 VERTEX2 VERTEX3 VERTICES VIEW WAVE WAVES WIDTH WIREFRAME WOOD
    ZENITH ZENITHCOLOR
"""


def test_the_generated_files_are_current() -> None:
    check = subprocess.run(
        [sys.executable, "-m", "generate", "--check"], cwd=GRAMMAR, capture_output=True, text=True, check=False
    )
    assert check.returncode == 0, check.stderr


def test_the_check_tells_what_is_not_current(tmp_path: Path) -> None:
    copy = tmp_path / "grammar"
    ignore = shutil.ignore_patterns("parser-generator", "build", "__pycache__", "*.so")
    shutil.copytree(GRAMMAR, copy, ignore=ignore)
    for folder in ("docs/language", "vscode-extension/syntaxes", "vscode-extension/snippets"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    table = copy / "language.toml"
    changed = table.read_text("utf-8").replace("block.SPHERE.statement.RADIUS", "block.SPHERE.statement.SIZE")
    table.write_text(changed.replace('usual = ["CENTER", "RADIUS"]', 'usual = ["CENTER", "SIZE"]'))
    command = [sys.executable, "-P", "-c", "import sys; sys.path.insert(0, '.'); from generate.__main__ import main; "]
    command[-1] += "sys.exit(main())"
    check = subprocess.run([*command, "--check"], cwd=copy, capture_output=True, text=True, check=False)
    assert check.returncode == 1
    files = ["language.json", "keywords.js", "m3d.lark", "automaton.json", "highlights.scm", "primitives.md"]
    for file in (*files, "m3d.tmLanguage.json", "m3d.json"):
        assert f"{file} is not current" in check.stderr
    write = subprocess.run(command, cwd=copy, capture_output=True, text=True, check=False)
    assert write.returncode == 0, write.stderr
    check = subprocess.run([*command, "--check"], cwd=copy, capture_output=True, text=True, check=False)
    assert check.returncode == 0, check.stderr
    assert "SIZE: /SIZE" in (copy / "m3d.lark").read_text("utf-8")


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("cargo") is None, reason="needs cargo")
def test_the_parser_is_current(tmp_path: Path) -> None:
    """Takes a minute the first time, when the parser generator is built."""
    project = GRAMMAR / "parser-generator"
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=project, check=True)
    generator = project / "target/release/m3d-parser-generator"
    source = "grammar.js" if shutil.which("node") else "src/grammar.json"
    subprocess.run([generator, source, tmp_path], cwd=GRAMMAR, check=True)
    written = [file.relative_to(tmp_path) for file in tmp_path.rglob("*") if file.is_file()]
    assert Path("parser.c") in written
    for file in written:
        assert (tmp_path / file).read_text("utf-8") == (GRAMMAR / "src" / file).read_text("utf-8"), file


def test_the_keywords_are_those_of_appendix_a() -> None:
    assert set(APPENDIX_A.split()) | {"NSAMPLES"} == LANGUAGE.keywords


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_the_tree_sitter_grammar_knows_it(keyword: str) -> None:
    language = Language(m3d_language.language())
    assert language.id_for_node_kind(keyword, False) is not None
    assert Parser(language).parse(f"x = {keyword}".encode()).root_node.has_error


def test_the_formal_grammar_knows_every_keyword() -> None:
    assert {terminal.name for terminal in parser().terminals} >= LANGUAGE.keywords - set(LANGUAGE.reserved)
    for keyword in KEYWORDS:
        assert first_error(f"{keyword} = 1") is not None


def test_the_highlight_query_knows_every_keyword() -> None:
    for keyword in KEYWORDS:
        assert f'"{keyword}"' in m3d_language.HIGHLIGHTS_QUERY


def test_the_textmate_grammar_knows_every_keyword() -> None:
    grammar = json.loads((ROOT / "vscode-extension/syntaxes/m3d.tmLanguage.json").read_text("utf-8"))
    rules = [re.compile(rule["match"]) for rule in grammar["repository"]["keyword"]["patterns"]]
    for keyword in KEYWORDS:
        assert any(rule.fullmatch(keyword) for rule in rules), keyword
        assert not any(rule.search(f"{keyword}_2 x{keyword}") for rule in rules), keyword


def test_the_reference_describes_every_keyword() -> None:
    pages = {file.name: file.read_text("utf-8") for file in (ROOT / "docs/language").glob("*.md")}
    text = "\n".join(pages.values())
    for keyword in KEYWORDS:
        assert f"| `{keyword}` |" in pages["README.md"]
    for block in LANGUAGE.blocks.values():
        assert f"\n## {block.keyword}\n" in text
        assert f"\n{block.says}\n" in text
        for member in (*block.statements.values(), *block.tables.values()):
            assert f"\n### `{member.keyword}`" in text
            assert f"\n{member.says}\n" in text


def test_the_links_of_the_reference_lead_somewhere() -> None:
    pages = {file.name: file.read_text("utf-8") for file in (ROOT / "docs/language").glob("*.md")}
    for text in pages.values():
        for page, anchor in re.findall(r"\]\(([\w.]+)(?:#(\w+))?\)", text):
            assert page in pages
            assert not anchor or f"\n## {anchor.upper()}\n" in pages[page]


def test_the_node_types_that_the_compiler_relies_on() -> None:
    types = json.loads((GRAMMAR / "src/node-types.json").read_text("utf-8"))
    fields = {entry["type"]: set(entry.get("fields", {})) for entry in types if entry["named"]}
    assert fields == {
        "source_file": set(),
        "variables": {"keyword"},
        "declaration": {"type", "name"},
        "assignment": {"target", "value", "source", "body"},
        "block": {"keyword", "name", "body"},
        "body": set(),
        "statement": {"keyword", "argument"},
        "table": {"keyword", "data", "entry"},
        "vector": {"component"},
        "number": set(),
        "identifier": set(),
        "comment": set(),
        "numeric_table": set(),
    }


def test_importing_the_package_is_cheap() -> None:
    code = "import sys, m3d_language; print([m for m in ('lark', 'numpy', 'json', 'tree_sitter') if m in sys.modules])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"


def test_an_unknown_attribute_is_an_error() -> None:
    with pytest.raises(AttributeError, match="SONGS_QUERY"):
        _ = m3d_language.SONGS_QUERY
    assert "HIGHLIGHTS_QUERY" in dir(m3d_language)
