"""What is found after edits is what is found from the start: diagnostics, IR, items and tree."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import m3dc
from m3dc import SceneIR, Source
from m3dc.analysis import Analyser, Analysis
from m3dc.meaning.values import Record, Value
from m3dc.syntax import ast

SCENE = """\
/* A scene to be edited. */
VARIABLES { NUMBER size, far; VECTOR red; SURFACE skin; SPHERE ball; SOLID thing; TRANSFORM turn; }
size = 0.5 far = 30 red = < 1, 0, 0 >
skin = { COLOR red TEXTURE { CHECKER { COLOR < 0, size, 1 > } } }
turn = { ROTATE < 0, 0, 30 > }
ball = { RADIUS size }
thing = { SPHERE ball { CENTER < far, 0, 0 > } SURFACE skin TRANSFORM turn }
SOLID thing
SOLID thing { SURFACE { SPECULAR 0.5 } }
SOLID thing
ball = { RADIUS 3 }
SOLID { SPHERE ball SURFACE skin { TEXTURE { UBLEND { COLORS { 0 0.5 < 1, 0, 0 > < 0, 1, 0 > } } } } }
SOLID { SPHERE ball { TRANSFORM { TRANSX far } } SPHERE { CENTER < 1, 2, 3 > RADIUS size }
        SPHERE { TRANSFORM { SCALE < 2, 2, 2 > } TRANSFORM turn { ROTX 20 } } SURFACE skin }
SOLID { POLYGONS { VERTICES { 3 < 0, 0, 0 > < 1, 0, 0 > < 0, 1, 1 > } FACETS { 1 0 1 2 } } TRANSFORM { IDENTITY } }
SCENE { SHADOWS SKY { SUN { ZENITH 30 } } VIEW { FROM < far, 0, 2 > TO < 0, 0, 0 > }
        MIRAGE { PROFILE { 0 20 size 19 9 18 } } }
LIGHT { SOURCE { FROM < 0, 0, 9 > TO < 0, 0, 0 > } }
"""
PIECES = (
    "{", "}", "<", ",", ";", "=", "/*", "*/", "\n", " ", "0", "-1", "1e9", "x", "é",
    "size", "ball", "skin", "red", "thing", "size = 5", "NUMBER", "SPHERE", "RADIUS", "RADIUS -1", "SOLID thing",
    "SCENE { }", "VARIABLES { NUMBER more; }", "more = 1", "SOLID { SPHERE { } }", "\x00", "SPHERE ball",
)  # fmt: skip


def spread(ir: SceneIR) -> list[tuple[str, str, str]]:
    """Everything in an IR, comparable."""
    tables = [(t, c, repr(column.tolist())) for t, columns in ir.tables.items() for c, column in columns.items()]
    return [("", "", repr(ir.scene)), *tables]


def worths(analysis: Analysis) -> list[object]:
    """What every name, vector, statement and block of the tree is worth, comparable, and the matrices of the blocks."""

    def plain(value: Value | None) -> object:
        if not isinstance(value, Record):
            return value
        return value.block, analysis.places.absolute(value.span), value.values, len(value.parts), [*value.nested]

    found: list[object] = []
    for at in ast.walk(analysis.items, ast.Name, ast.Vector, ast.Statement):
        worth = analysis.statement_value(at) if isinstance(at.node, ast.Statement) else plain(analysis.value_of(at))
        found.append((at.span, worth))
    for at in ast.walk(analysis.items, ast.Block):
        here = analysis.enclosing(at)
        matrix = None if here is None else here.transform.matrix.tolist()
        found.append((at.span, plain(analysis.value_of(at)), matrix))
    return found


def check_same(analysis: Analysis, text: bytes) -> None:
    fresh = m3dc.compile(text)
    assert analysis.diagnostics == fresh.diagnostics
    assert spread(analysis.ir) == spread(fresh.ir)
    anew = Analyser().analyse(Source(text))
    assert str(analysis.tree.root_node) == str(anew.tree.root_node)
    assert [(top.start, top.item) for top in analysis.items] == [(top.start, top.item) for top in anew.items]
    assert [item.start for item in analysis.program] == [item.start for item in anew.program]
    assert worths(analysis) == worths(anew)


edits = st.lists(
    st.tuples(
        st.integers(0, len(SCENE)), st.sampled_from([0, 0, 1, 2, 7, 40]), st.lists(st.sampled_from(PIECES), max_size=2)
    ),
    min_size=1,
    max_size=8,
)


@pytest.mark.slow
@given(edits)
@example([(SCENE.index("far = 30"), 9, [])])  # a variable is assigned to no more
@example([(SCENE.index("NUMBER size"), 0, ["/*"]), (SCENE.index("NUMBER size"), 2, [])])
@example([(SCENE.index("SOLID thing"), 12, []), (0, 0, ["\n"])])  # the others of its like stay
@example([(SCENE.index("SCENE"), 0, ["SCENE { }"]), (SCENE.index("SCENE"), 9, [])])  # the first counts, and goes
@example([(0, 0, ["VARIABLES { NUMBER more; }"])])
# One comes to stand where another of its length was.
@example([(SCENE.index("turn ="), 0, ["size = 7 more = 7 "]), (SCENE.index("turn ="), 9, [])])
def test_after_edits_all_is_as_from_the_start(changes: list[tuple[int, int, list[str]]]) -> None:
    analyser = Analyser()
    text = SCENE
    check_same(analyser.analyse(Source(text.encode())), text.encode())
    for start, length, new in changes:
        start = min(start, len(text))
        text = text[:start] + " ".join(new) + text[start + length :]
        check_same(analyser.analyse(Source(text.encode())), text.encode())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["merman", "wheel", "terrain", "runway"])
def test_a_scene_typed_word_by_word(name: str, examples: Path) -> None:
    """Every few words the text so far is looked at, as an editor would."""
    words = (examples / f"{name}.m3d").read_bytes().split(b" ")
    analyser = Analyser()
    for number in range(0, len(words), max(1, len(words) // 40)):
        text = b" ".join(words[:number])
        check_same(analyser.analyse(Source(text)), text)


def test_a_text_with_a_long_table(examples: Path) -> None:
    rows = "".join(f"< {x}, {y}, {np.sin(x + y):.6f} >\n" for x in range(100) for y in range(100))
    text = f"SOLID {{ TERRAIN {{ VERTICES {{ 100 100 {rows} }} }} }}\nLIGHT {{ }}\n"
    analyser = Analyser()
    for change in ("", "/* moved */ ", "SOLID { SPHERE { RADIUS x } } "):
        check_same(analyser.analyse(Source((change + text).encode())), (change + text).encode())
    broken = text.replace("< 50, 50,", "< 50 50,")
    check_same(analyser.analyse(Source(broken.encode())), broken.encode())


def test_what_did_not_change_is_not_made_again() -> None:
    analyser = Analyser()
    first = analyser.analyse(Source(SCENE.encode()))
    assert first.ok
    moved = analyser.analyse(Source(b"\n" + SCENE.encode()))
    assert [id(item.content) for item in first.program] == [id(item.content) for item in moved.program]
    assert [id(made) for made in first.world.made] == [id(made) for made in moved.world.made]
    changed = analyser.analyse(Source(SCENE.replace("size = 0.5", "size = 0.7").encode()))
    kept = [one is other for one, other in zip(moved.world.made, changed.world.made, strict=True)]
    texts = [SCENE[item.start - 1 :].split(" ")[0] for item in moved.program]
    assert [text for text, same in zip(texts, kept, strict=True) if same] == [
        "VARIABLES",
        "far",
        "red",
        "turn",
        "SOLID",
        "LIGHT",
    ]


def test_of_a_solid_only_the_parts_that_change_are_made_again() -> None:
    analyser = Analyser()
    text = """\
VARIABLES { NUMBER size; SPHERE ball; }
size = 2 ball = { RADIUS 3 }
SOLID { SPHERE ball SPHERE { RADIUS size } SPHERE { RADIUS 4 } }
"""
    before = analyser.analyse(Source(text.encode())).world.solids[0].parts
    after = analyser.analyse(Source(text.replace("size = 2", "size = 5").encode())).world.solids[0].parts
    assert [one is other for one, other in zip(before, after, strict=True)] == [True, False, True]
    assert [part.number("RADIUS") for part in after] == [3, 5, 4]
    # What is moved as a whole, and then changed elsewhere, keeps what it was made of long before.
    moved = analyser.analyse(Source(("\n" + text).encode())).world.solids[0].parts
    last = analyser.analyse(Source(("\n" + text.replace("size = 2", "size = 6")).encode())).world.solids[0].parts
    assert [one is other for one, other in zip(moved, last, strict=True)] == [True, False, True]


# --- asking -----------------------------------------------------------------------------------------------------------


def asked(marked: str) -> tuple[Analysis, ast.Located]:
    """An analysed text, and the innermost node that holds what stands between `[` and `]`."""
    start, end = marked.index("["), marked.index("]") - 1
    analysis = Analyser().analyse(Source(marked.replace("[", "").replace("]", "").encode()))
    at = ast.locate(analysis.items, (start, end))
    assert at is not None
    return analysis, at


@pytest.mark.parametrize(
    ("marked", "worth"),
    [
        ("VARIABLES { NUMBER a; } a = [2.5] SOLID { SPHERE { RADIUS a } }", 2.5),
        ("VARIABLES { NUMBER a; } [a] = 2.5 SOLID { SPHERE { RADIUS a } }", 2.5),
        ("VARIABLES { NUMBER a; } a = 2 SOLID { SPHERE { RADIUS [a] } } a = 3", 2.0),
        ("VARIABLES { NUMBER a; } a = 2 SOLID { SPHERE { RADIUS 1 } } a = 3 SOLID { SPHERE { RADIUS [a] } }", 3.0),
        ("VARIABLES { NUMBER a; } SOLID { SPHERE { RADIUS [a] } } a = 3", None),
        ("VARIABLES { NUMBER a; } a = -1 SOLID { SPHERE { CENTER [< a, 2, 1e3 >] } }", (-1.0, 2.0, 1000.0)),
        ("VARIABLES { NUMBER a, b; } a = b SOLID { SPHERE { CENTER [< a, 2, 3 >] } }", (0.0, 2.0, 3.0)),
        ("VARIABLES { VECTOR a, b; } a = < 1, 2, 3 > b = [a] SOLID { SPHERE { CENTER b } }", (1.0, 2.0, 3.0)),
        ("SOLID { SPHERE { RADIUS [1e999] } }", None),
        ("SOLID { SPHERE { RADIUS 1 CENTER [< 1, 2 > } }]", None),
    ],
)
def test_what_an_argument_is_worth(marked: str, worth: Value | None) -> None:
    analysis, at = asked(marked)
    assert analysis.value_of(at) == worth


def test_what_a_block_is_worth() -> None:
    text = "SOLID { SPHERE { RADIUS 1 } [SPHERE { RADIUS 2 RADIUS 3 }] SURFACE { COLOR < 1, 9, 0 > } }"
    analysis, at = asked(text)
    record = analysis.value_of(at)
    assert isinstance(record, Record)
    assert (record.block, record.number("RADIUS")) == ("SPHERE", 3.0)
    held = [analysis.statement_value(each) for each in ast.walk(analysis.items, ast.Statement)]
    assert held == [1.0, None, 3.0, (1.0, 1.0, 0.0)]  # replaced by a later one; set to the nearest limit


@pytest.mark.parametrize(
    ("marked", "x"),
    [
        ("SOLID { SPHERE { TRANSFORM { TRANSX 1 [TRANSX 2] TRANSX 4 } } TRANSFORM { TRANSX 8 } }", 3),
        ("SOLID { SPHERE { [TRANSFORM { TRANSX 1 TRANSX 2 TRANSX 4 }] } TRANSFORM { TRANSX 8 } }", 7),
        ("SOLID { SPHERE { TRANSFORM { TRANSX 1 } [TRANSFORM { TRANSX 2 }] TRANSFORM { TRANSX 4 } } }", 3),
        ("SOLID { SPHERE { RADIUS [2] TRANSFORM { TRANSX 1 } } TRANSFORM { TRANSX 8 } }", 1),
        ("VARIABLES { TRANSFORM t; } t = { TRANSX 1 } t = { TRANSX 2 [TRANSX 4] TRANSX 8 } SOLID { SPHERE { } }", 7),
        ("VARIABLES { SPHERE b; } b = { TRANSFORM { TRANSX 1 } } SOLID { SPHERE b { TRANSFORM { [TRANSX 2] } } }", 3),
        ("VARIABLES { TRANSFORM t; } t = { TRANSX 1 } SOLID { SPHERE { TRANSFORM t { [TRANSX 2] } } }", 3),
    ],
)
def test_the_matrix_up_to_a_place(marked: str, x: float) -> None:
    analysis, at = asked(marked)
    here = analysis.enclosing(at)
    assert here is not None
    assert here.transform.matrix[3].tolist() == [x, 0, 0, 1]


@given(st.data())
def test_every_node_is_found_at_its_place(data: st.DataObject) -> None:
    analysis = Analyser().analyse(Source(SCENE.encode()))
    nodes = list(ast.walk(analysis.items))
    at = data.draw(st.sampled_from(nodes))
    found = ast.locate(analysis.items, at.span)
    assert found is not None
    assert found.span == at.span
    assert at.node in (found.node, *found.around)
    for outer, inner in zip((*at.around, at.node), (*at.around[1:], at.node), strict=False):
        assert inner is outer or any(inner is part for part in ast.children(outer))
    assert [each.span[0] for each in nodes] == sorted(each.span[0] for each in nodes)
