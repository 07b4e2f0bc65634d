"""The outline of a scene: what its parts are called, and where they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import pytest
from editor import Editor, Scene
from lsprotocol import types

pytestmark = pytest.mark.asyncio(loop_scope="session")


async def outline(editor: Editor, scene: Scene) -> list[types.DocumentSymbol]:
    params = types.DocumentSymbolParams(scene.identifier)
    found = await editor.client.text_document_document_symbol_async(params)
    symbols = [symbol for symbol in found or () if isinstance(symbol, types.DocumentSymbol)]
    check_nesting(symbols)
    return symbols


def check_nesting(symbols: Sequence[types.DocumentSymbol]) -> None:
    for symbol in symbols:
        for inner in (symbol.selection_range, *(child.range for child in symbol.children or ())):
            assert ends(symbol.range)[0] <= ends(inner)[0] <= ends(inner)[1] <= ends(symbol.range)[1]
        check_nesting(symbol.children or ())


def ends(range_: types.Range) -> list[tuple[int, int]]:
    return [(place.line, place.character) for place in (range_.start, range_.end)]


def lines(symbols: Sequence[types.DocumentSymbol], depth: int = 0) -> Iterator[str]:
    """The outline as an editor shows it."""
    for symbol in symbols:
        yield f"{'  ' * depth}{symbol.name}{f' ({symbol.detail})' if symbol.detail else ''}"
        yield from lines(symbol.children or (), depth + 1)


async def check(editor: Editor, text: str, expected: str) -> None:
    scene = editor.open(text)
    assert list(lines(await outline(editor, scene))) == expected.strip("\n").split("\n")


async def test_variables_blocks_and_tables(editor: Editor) -> None:
    await check(
        editor,
        """\
VARIABLES { VECTOR sand, red; SOLID pair; }
sand = < 0.8, 0.7,  0.5 >
pair = { SPHERE { RADIUS 2 } PLANE { } SPHERE { } SURFACE { COLOR sand } }
SCENE { SHADOWS SKY { SUN { ZENITH 5 } } MIRAGE { PROFILE { 0 1 5 2 9 3 } } }
SOLID pair { TRANSFORM { TRANSX 1 } }
SOLID { SPHERE { } PLANE { } SPHERE { } }
""",
        """
VARIABLES
  sand (VECTOR)
  red (VECTOR)
  pair (SOLID)
sand (< 0.8, 0.7, 0.5 >)
pair (SOLID)
  SPHERE
  PLANE
  SPHERE
  SURFACE
SCENE
  SKY
    SUN
  MIRAGE
    PROFILE
SOLID pair (TRANSX 1)
  TRANSFORM
SOLID (SPHERE, PLANE)
  SPHERE
  PLANE
  SPHERE
""",
    )


async def test_a_comment_is_the_name_of_what_it_stands_with(editor: Editor) -> None:
    await check(
        editor,
        """\
/* Everything about this file. */

/* The ball: it is red. */
SOLID { SPHERE { } } /* not its name */
SOLID /* a plane */ { PLANE { } }
SOLID { SPHERE { } } /* the last ball */
SOLID { /* at the axle */ SPHERE { } }
/*****
 * Far away.
 *****/
LIGHT { }
/* m3d: allow M3D0505 */
LIGHT { }

/* Nobody's. */

LIGHT { }
""",
        """
The ball (SOLID)
  SPHERE
a plane (SOLID)
  PLANE
the last ball (SOLID)
  SPHERE
SOLID (SPHERE)
  at the axle (SPHERE)
Far away (LIGHT)
LIGHT
LIGHT
""",
    )


async def test_equal_blocks_are_told_apart(editor: Editor) -> None:
    await check(
        editor,
        """\
VARIABLES { VECTOR place; SURFACE matt; SPHERE ball; }
SOLID { SPHERE { CENTER < 0, 0, 1 > } SURFACE matt }
SOLID { SPHERE { CENTER place RADIUS 2 } PLANE { } SPHERE { CENTER < 9, 9, 9 > } SURFACE { COLOR < 1, 0, 0 > } }
SOLID { SPHERE { } TRANSFORM { ROTZ 5 TRANSLATE < 3, 0, 0 > } SURFACE matt { AMBIENT 1 } }
SOLID { SPHERE ball { TRANSFORM { TRANSZ 2 } } SURFACE { TEXTURE { WOOD { } } } }
SOLID { RECTANGLE { VERTEX1 < 1, 1, 1 > VERTEX2 < 0, 0, 0 > VERTEX3 < 2, 2, 2 > } }
LIGHT { SOURCE { INTENSITY 2 FROM < 5, 5, 5 > } }
LIGHT { SUN { } }
""",
        """
VARIABLES
  place (VECTOR)
  matt (SURFACE)
  ball (SPHERE)
SOLID (SPHERE at < 0, 0, 1 >, matt)
  SPHERE (at < 0, 0, 1 >)
  SURFACE matt
SOLID (SPHERE at place, PLANE, COLOR < 1, 0, 0 >)
  SPHERE (at place)
  PLANE
  SPHERE (at < 9, 9, 9 >)
  SURFACE
SOLID (at < 3, 0, 0 >, SPHERE, matt)
  SPHERE
  TRANSFORM
  SURFACE matt
SOLID (SPHERE TRANSZ 2, WOOD)
  SPHERE ball (TRANSZ 2)
    TRANSFORM
  SURFACE
    TEXTURE (WOOD)
      WOOD
SOLID (RECTANGLE at < 1, 1, 1 >)
  RECTANGLE (at < 1, 1, 1 >)
LIGHT (SOURCE at < 5, 5, 5 >)
  SOURCE (at < 5, 5, 5 >)
LIGHT
  SUN
""",
    )


async def test_half_typed_text(editor: Editor) -> None:
    await check(
        editor,
        """\
SOLID { SPHERE { RADIUS } PLANE { } }
SOLID { SURFACE { COLOR < 1, 0 } PLANE { } }
LIGHT { SOURCE { } }
""",
        """
SOLID (SPHERE, PLANE)
  SPHERE
  PLANE
SOLID (PLANE)
  SURFACE
  PLANE
LIGHT
  SOURCE
""",
    )
    await check(editor, "SOLID { PLANE { } }\nLIGHT { SOURCE {\n", "SOLID (PLANE)\n  PLANE\nLIGHT\n  SOURCE")


async def test_where_a_symbol_is(editor: Editor) -> None:
    scene = editor.open("/* \N{SNOWMAN}\N{MILKY WAY} */ $[SOLID { /* \N{MILKY WAY} */ SPHERE { } }$] /* end */\n")
    (solid,) = await outline(editor, scene)
    assert solid.range == scene.range
    assert solid.selection_range.start == scene.range.start
    assert solid.kind == types.SymbolKind.Object
