"""Long tables of numbers are left out of the parse: the result is the same as if they were not."""

from __future__ import annotations

import numpy as np
import pytest

import m3dc
from m3dc.ir import TABLES
from m3dc.text import long_tables


def scene(rows: int = 9000, *, broken: str = "", before: str = "", after: str = "") -> str:
    vertices = "\n".join(f"< {i % 97}.5, {i // 97}, {i * i % 13} >" for i in range(rows))
    facets = "\n".join(f"{i} {i + 1} {i + 100}" for i in range(rows - 101))
    return f"""{before}
/* {{ a comment with braces, {"1 2 3 " * 20000} }} */
SOLID {{ POLYGONS {{ VERTICES {{ {rows} {vertices} {broken} }} FACETS {{ {rows - 101} {facets} }} }} }}
{after}
SOLID {{ SPHERE {{ RADIUS 2 }} }}
"""


def assert_same_as_whole(text: str, monkeypatch: pytest.MonkeyPatch) -> m3dc.Result:
    assert long_tables.insides(text.encode())
    result = m3dc.compile(text)
    monkeypatch.setattr(long_tables, "LONG", len(text))
    whole = m3dc.compile(text)
    assert result.diagnostics == whole.diagnostics
    for table, columns in TABLES.items():
        for column in columns:
            np.testing.assert_array_equal(result.ir[table][column], whole.ir[table][column])
    return result


def test_the_ir_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    assert assert_same_as_whole(scene(), monkeypatch).ok


@pytest.mark.parametrize(
    ("broken", "code"),
    [
        ("< 1, 2 >", "M3D0101"),
        ("5", "M3D0102"),
        ("< 1, 2, 3. >", "M3D0104"),
        ("name", "M3D0102"),
        ("< 1, 2, 3 >", "M3D0405"),
    ],
)
def test_an_error_in_a_long_table_is_on_its_place(broken: str, code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text = scene(broken=broken)
    result = assert_same_as_whole(text, monkeypatch)
    first = result.diagnostics[0]
    assert first.code in {code, "M3D0202"}
    assert text.index(f"{broken} }} FACETS") <= first.span.start < text.index("FACETS")


def test_errors_around_long_tables_are_on_their_places(monkeypatch: pytest.MonkeyPatch) -> None:
    text = scene(before="SOLID { SPHERE { RADIUS -1 } }", after="SOLID { SPHERE { RADIUS -2 } SPHERE { RADUIS 3 } }")
    result = assert_same_as_whole(text, monkeypatch)
    assert [text[slice(*d.span.bytes)] for d in result.diagnostics] == ["-1", "-2", "RADUIS"]
    assert (
        result.source.position(result.diagnostics[1].span.start).line
        == text[: result.diagnostics[1].span.start].count("\n") + 1
    )


def test_what_is_not_a_long_table_is_left_alone() -> None:
    assert long_tables.insides(b"{ 1 2 3 }") == []
    assert long_tables.insides(b"{ " + b"1 " * 40000 + b"x }") == []
    assert long_tables.insides(b"{ " + b"1" * 400000 + b" }") == []
    assert long_tables.insides(b"1 " * 40000) == []
