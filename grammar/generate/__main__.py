"""`python -m generate [--check]`: writes the files made of language.toml, or says which are not current.

Needs Lark, but not the package's compiled part. src/parser.c is made of grammar.js and keywords.js afterwards, by
parser-generator.
"""

from __future__ import annotations

import argparse
import difflib
import sys
from pathlib import Path

from . import table

GRAMMAR = Path(__file__).resolve().parents[1]
ROOT = GRAMMAR.parent


def outputs() -> dict[Path, str]:
    """Every generated file and its text."""
    from . import automaton, formal, keywords, queries, reference, snippets, textmate, vim

    language = table.load(GRAMMAR / "language.toml")
    files = {GRAMMAR / "keywords.js": keywords.text(language)}
    grammar = formal.text(language, (GRAMMAR / "generate/m3d.lark.template").read_text("utf-8"))
    files[GRAMMAR / "m3d.lark"] = grammar
    files[GRAMMAR / "m3d_language/automaton.json"] = automaton.text(grammar)
    files |= {GRAMMAR / "queries" / name: text for name, text in queries.texts(language).items()}
    files |= {ROOT / "docs/language" / name: text for name, text in reference.pages(language).items()}
    extension = ROOT / "vscode-extension"
    files[extension / "syntaxes/m3d.tmLanguage.json"] = textmate.text(language)
    files[extension / "snippets/m3d.json"] = snippets.text(language)
    files[ROOT / "lsp/editors/vim/syntax/m3d.vim"] = vim.text(language)
    return files


def difference(path: Path, text: str) -> str | None:
    """How the file differs from the text it should have; None: not at all."""
    if not path.exists():
        return f"{path.relative_to(ROOT)} is missing"
    there = path.read_text(encoding="utf-8")
    if there == text:
        return None
    lines = list(difflib.unified_diff(there.splitlines(), text.splitlines(), lineterm="", n=0))[2:]
    shown = "\n".join(f"    {line[:200]}" for line in lines[:10])
    more = f"\n    ... and {len(lines) - 10} more lines" if len(lines) > 10 else ""
    return f"{path.relative_to(ROOT)} is not current:\n{shown}{more}"


def check(files: dict[Path, str]) -> int:
    """Says what is not current. The number of such files."""
    differences = [found for path, text in files.items() if (found := difference(path, text))]
    for found in differences:
        print(found, file=sys.stderr)
    return len(differences)


def write(files: dict[Path, str]) -> None:
    for path, text in files.items():
        if difference(path, text):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            print(f"wrote {path.relative_to(ROOT)}")


def main() -> int:
    parser = argparse.ArgumentParser(prog="generate", description="Writes the files made of grammar/language.toml.")
    parser.add_argument("--check", action="store_true", help="write nothing; exit status 1 if a file is not current")
    run = check if parser.parse_args().check else write
    # The table first: the other modules import the package that reads it.
    stale = run({GRAMMAR / "m3d_language/language.json": table.text(GRAMMAR / "language.toml")}) or 0
    stale += run(outputs()) or 0
    if stale:
        print("Run `make generate` and commit the result.", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
