"""What the tests of requests that LSP does not know share."""

from __future__ import annotations

import sys
from typing import Any

from editor import Editor, Scene, position
from lsprotocol import types

COMMAND = [sys.executable, "-m", "m3d_lsp"]


def to_range(given: Any) -> types.Range:
    """A range as the client gets it in an answer whose form it does not know."""
    return types.Range(
        types.Position(given.start.line, given.start.character), types.Position(given.end.line, given.end.character)
    )


def edit(editor: Editor, scene: Scene, old: str, new: str) -> Scene:
    """Put other words in place of some that stand in a scene once."""
    assert scene.text.count(old) == 1
    start = scene.text.index(old)
    range_ = types.Range(position(scene.text, start), position(scene.text, start + len(old)))
    editor.change(scene, types.TextDocumentContentChangePartial(range_, new))
    return scene._replace(text=scene.text.replace(old, new))
