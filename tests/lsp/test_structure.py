"""What folds, how a selection grows, and what is a link."""

from __future__ import annotations

from pathlib import Path

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")


async def folds(editor: Editor, scene: Scene) -> list[str]:
    """What can be folded: each as its first line, how many lines it hides, and its kind."""
    params = types.FoldingRangeParams(scene.identifier)
    found = await editor.client.text_document_folding_range_async(params) or ()
    lines = scene.text.split("\n")
    return [
        f"{lines[fold.start_line].strip()} +{fold.end_line - fold.start_line}{f' {fold.kind}' if fold.kind else ''}"
        for fold in found
    ]


async def test_folding(editor: Editor) -> None:
    scene = editor.open(
        """\
/* What it is,
   in two lines. */
/* And a third. */

VARIABLES {
    SPHERE ball;
}
ball =
{
    RADIUS 2
} /* after it */
SOLID { SPHERE { } }
SOLID { POLYGONS {
    VERTICES
    {
        3
    } FACETS {
        1
    }
} }
/* one */
/* two */
LIGHT /* three */
{
"""
    )
    assert await folds(editor, scene) == [
        "/* What it is, +2 comment",
        "VARIABLES { +2",
        "ball = +2",
        "SOLID { POLYGONS { +7",
        "VERTICES +2",
        "} FACETS { +2",
        "/* one */ +1 comment",
        "LIGHT /* three */ +1",
    ]


async def grown(editor: Editor, marked: str) -> list[str]:
    """What is selected step by step."""
    scene = editor.open(marked)
    params = types.SelectionRangeParams(scene.identifier, [scene.cursor])
    (found,) = await editor.client.text_document_selection_range_async(params) or []
    steps: list[str] = []
    step: types.SelectionRange | None = found
    while step is not None:
        steps.append(scene.part(step.range))
        step = step.parent
    assert steps[-1] == scene.text
    return steps[:-1]


async def test_a_selection_grows(editor: Editor) -> None:
    assert await grown(editor, "SOLID { SPHERE { CENTER < 0, 1$0.5, 0 > RADIUS 2 } }\nLIGHT { }") == [
        "1.5",
        "< 0, 1.5, 0 >",
        "CENTER < 0, 1.5, 0 >",
        "CENTER < 0, 1.5, 0 > RADIUS 2",
        "{ CENTER < 0, 1.5, 0 > RADIUS 2 }",
        "SPHERE { CENTER < 0, 1.5, 0 > RADIUS 2 }",
        "{ SPHERE { CENTER < 0, 1.5, 0 > RADIUS 2 } }",
        "SOLID { SPHERE { CENTER < 0, 1.5, 0 > RADIUS 2 } }",
    ]


async def test_a_selection_grows_in_a_table(editor: Editor) -> None:
    table = "SOLID { POLYGONS { VERTICES {\n 3 < 0, 0, 0 >\n < 1, 2$0, 3 > < 4, 5, 6 >\n } } }"
    assert (await grown(editor, table))[:5] == [
        "2",
        "< 1, 2, 3 >",
        "< 1, 2, 3 > < 4, 5, 6 >",
        "3 < 0, 0, 0 >\n < 1, 2, 3 > < 4, 5, 6 >",
        "VERTICES {\n 3 < 0, 0, 0 >\n < 1, 2, 3 > < 4, 5, 6 >\n }",
    ]


async def test_a_selection_grows_in_a_comment_and_in_broken_text(editor: Editor) -> None:
    assert await grown(editor, "/* one\n   two th$0ree */\nLIGHT { }") == [
        "three",
        "two three",
        "one\n   two three",
        "/* one\n   two three */",
    ]
    assert (await grown(editor, "SOLID { SPHERE { RADIUS $05"))[0] == "5"
    assert await grown(editor, "$0") == []


async def test_links(editor: Editor, tmp_path: Path) -> None:
    for name in ("other.m3d", "sub/picture.png", "two words.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    text = """\
/* Like other.m3d, but see "two words.txt" and ./sub/picture.png; not missing.m3d.
   After https://example.org/mirage?x=1. */
LIGHT { } /* sub/picture.png */
"""
    scene = editor.open(text, uri=(tmp_path / "scene.m3d").as_uri())
    params = types.DocumentLinkParams(scene.identifier)
    found = await editor.client.text_document_document_link_async(params) or ()
    assert [(scene.part(link.range), link.target) for link in found] == [
        ("other.m3d", (tmp_path / "other.m3d").as_uri()),
        ("two words.txt", (tmp_path / "two words.txt").as_uri()),
        ("./sub/picture.png", (tmp_path / "sub/picture.png").as_uri()),
        ("https://example.org/mirage?x=1", "https://example.org/mirage?x=1"),
        ("sub/picture.png", (tmp_path / "sub/picture.png").as_uri()),
    ]
    elsewhere = types.DocumentLinkParams(editor.open(text).identifier)
    assert len(await editor.client.text_document_document_link_async(elsewhere) or ()) == 1
