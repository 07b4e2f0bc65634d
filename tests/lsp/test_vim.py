"""Colours and indentation in Vim, and in Neovim without a parser."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from laid_out import LAID_OUT

from m3dc.format import format

EDITORS = Path(__file__).parents[2] / "lsp/editors"

SCENE = """\
/* one /* in */ SOLID */
VARIABLES { SURFACE matt; }
matt = { COLOR < 1, -2.5, x1e5 > }
SCENE { SHADOWS AMBIENT 0.5 AMBIENT { NSAMPLES 5 } }
SOLID { SPHERE { RADIUS 2. } SURFACE matt } /* two
lines */ LIGHT { }
"""

# By the word and which of its kind it is: what it is coloured as.
COLOURED = {
    ("one", 0): "m3dComment",
    ("SOLID", 0): "m3dComment",
    ("VARIABLES", 0): "m3dKeyword",
    ("SURFACE", 0): "m3dBlock",
    ("matt", 1): "m3dVariable",
    ("=", 0): "m3dOperator",
    ("COLOR", 0): "m3dProperty",
    ("-2.5", 0): "m3dNumber",
    ("x1e5", 0): "m3dVariable",
    ("SHADOWS", 0): "m3dFlag",
    ("AMBIENT", 0): "m3dProperty",
    ("AMBIENT", 1): "m3dBlock",
    ("SPHERE", 0): "m3dBlock",
    ("2.", 1): "m3dNumber",
    ("lines", 0): "m3dComment",
    ("LIGHT", 0): "m3dBlock",
    ("}", 6): "m3dDelimiter",
}

# Run in the editor; the result goes into the file that is named last.
COLOURS = """
let s:found = []
for s:line in range(1, line('$'))
  let s:row = map(range(1, len(getline(s:line))), {_, column ->
        \\ synIDattr(synID(s:line, column, 1), 'name')})
  call add(s:found, s:row)
endfor
call writefile([json_encode(s:found)], $RESULT)
qall!
"""
INDENTED = "normal! gg=G\nwrite! $RESULT\nqall!\n"


@pytest.fixture(params=["vim", "nvim"])
def editor(request: pytest.FixtureRequest) -> str:
    program: str = request.param
    if shutil.which(program) is None:
        if os.environ.get("CI"):
            pytest.fail(f"{request.param} is not installed: apt-get install vim neovim")
        pytest.skip(f"{request.param} is not installed")
    return request.param


def run(editor: str, folder: Path, text: str, script: str) -> str:
    """What a script leaves in $RESULT, run in an editor in which a scene is open."""
    scene, commands, result = folder / "scene.m3d", folder / "script.vim", folder / "result"
    scene.write_text(text, encoding="utf-8")
    commands.write_text(script, encoding="utf-8")
    given = ["nvim", "--headless"] if editor == "nvim" else ["vim", "-N", "-es", "-T", "dumb", "--not-a-term"]
    configuration = EDITORS / ("neovim" if editor == "nvim" else "vim")
    ran = subprocess.run(
        [
            *given, "--clean", "--cmd", f"set runtimepath^={configuration}",
            "--cmd", "filetype plugin indent on", "--cmd", "syntax on", "-S", str(commands), str(scene),
        ],
        env={**os.environ, "RESULT": str(result), "HOME": str(folder), "XDG_STATE_HOME": str(folder)},
        stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60, check=False, cwd=folder,
    )  # fmt: skip
    assert result.exists(), ran.stdout + ran.stderr
    return result.read_text(encoding="utf-8")


def test_colours(editor: str, tmp_path: Path) -> None:
    rows = json.loads(run(editor, tmp_path, SCENE, COLOURS))
    lines = SCENE.splitlines()
    for (word, number), group in COLOURED.items():
        places = [
            (line, match.start())
            for line, text in enumerate(lines)
            for match in re.finditer(rf"(?<!\w){re.escape(word)}", text)
        ]
        line, column = places[number]
        assert set(rows[line][column : column + len(word)]) == {group}, (word, number)


def test_indentation(editor: str, tmp_path: Path) -> None:
    assert format(LAID_OUT.encode()).decode() == LAID_OUT
    lines = LAID_OUT.splitlines(keepends=True)
    flat = "".join([*lines[:2], *(line.lstrip(" ") for line in lines[2:])])
    assert run(editor, tmp_path, flat, INDENTED) == LAID_OUT
    assert run(editor, tmp_path, LAID_OUT, INDENTED) == LAID_OUT
