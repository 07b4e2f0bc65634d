"""The tree-sitter corpus: texts and their syntax trees, in grammar/test/corpus, as `tree-sitter test` reads them.

After a change to the grammar `python tests/grammar/test_corpus.py` writes the trees anew; read the difference.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from tree_sitter import Language, Parser

import m3d_language

CORPUS = Path(__file__).parents[2] / "grammar/test/corpus"
CASE = re.compile(
    r"^=+\n(?P<title>.+)\n=+\n\n(?P<text>(?s:.*?))\n\n---\n\n(?P<tree>(?s:.*?))\n*(?=^=+\n.+\n=+\n|\Z)", re.MULTILINE
)
PARSER = Parser(Language(m3d_language.language()))


class Case(NamedTuple):
    file: str
    title: str
    text: str
    tree: str


def cases() -> Iterator[Case]:
    for file in sorted(CORPUS.glob("*.txt")):
        for match in CASE.finditer(file.read_text(encoding="utf-8")):
            yield Case(file.stem, match["title"], match["text"], match["tree"])


def tree(text: str) -> str:
    """The syntax tree as an S-expression, a named node a line."""
    lines: list[str] = []
    depth = 0
    for token in re.findall(
        r"[a-z]+: |\((?:MISSING|UNEXPECTED) [^)]+\)|\(\w+|\)", str(PARSER.parse(text.encode()).root_node)
    ):
        if token.startswith("("):
            field = lines.pop() if lines and lines[-1].endswith(": ") else "  " * depth
            lines.append(field + token)
            depth += not token.endswith(")")
        elif token == ")":
            depth -= 1
            lines[-1] += ")"
        else:
            lines.append("  " * depth + token)
    return "\n".join(lines)


@pytest.mark.parametrize("case", list(cases()), ids=lambda case: f"{case.file}: {case.title}")
def test_the_tree_is_the_expected_one(case: Case) -> None:
    assert tree(case.text) == case.tree


def test_the_corpus_is_read_whole() -> None:
    assert len(list(cases())) == sum(file.read_text(encoding="utf-8").count("\n---\n") for file in CORPUS.glob("*.txt"))


def rewrite() -> None:
    """Puts the trees of today into the corpus."""
    bar = "=" * 80
    for name in {case.file for case in cases()}:
        texts = [
            f"{bar}\n{case.title}\n{bar}\n\n{case.text}\n\n---\n\n{tree(case.text)}\n"
            for case in cases()
            if case.file == name
        ]
        (CORPUS / f"{name}.txt").write_text("\n".join(texts), encoding="utf-8")


if __name__ == "__main__":
    rewrite()
