"""What blocks are called."""

from __future__ import annotations

import pytest

from m3dc.text.caption import Caption, caption


@pytest.mark.parametrize(
    ("text", "title", "variable"),
    [
        ("SOLID { SPHERE { } }", "", ""),
        ("SOLID ball", "", "ball"),
        ("SOLID ball { RADIUS 2 }", "", "ball"),
        ("SOLID /* a mirror */ { }", "a mirror", ""),
        ("SOLID /* a mirror */ ball { }", "a mirror", "ball"),
        ("SOLID ball /* a /* nested */ mirror. Second sentence */ { }", "a /* nested */ mirror", "ball"),
        ("SOLID { /* within */ SPHERE { } }", "", ""),
        ("SOLID/**/ball{}", "", "ball"),
        ("SOLID", "", ""),
    ],
)
def test_a_block_is_called_by_what_stands_in_its_head(text: str, title: str, variable: str) -> None:
    assert caption(text.encode(), (0, len(text))) == Caption(title, variable)


@pytest.mark.parametrize(
    ("before", "after", "title"),
    [
        ("/* the wall */ ", "", "the wall"),
        ("/* the wall */\n", "", "the wall"),
        ("/*\n * the wall,\n * in brick\n */\n", "", "the wall,"),
        ("/* of the file */\n\n", "", ""),
        ("SOLID { } /* of the one before */\n", "", ""),
        ("/* m3d: allow M3D0505 */\n", "", ""),
        ("", " /* the wall */\nSOLID { }", "the wall"),
        ("", " /* of the next */ SOLID { }", ""),
        ("", "\n/* of the next */", ""),
    ],
)
def test_a_comment_beside_a_block_is_its_title(before: str, after: str, title: str) -> None:
    block = "SOLID { }"
    found = caption((before + block + after).encode(), (len(before), len(before + block)))
    assert found == Caption(title, "")
