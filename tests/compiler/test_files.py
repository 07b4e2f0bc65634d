"""The compiler gets its text from `Files`, and what it says of a place names the file."""

from __future__ import annotations

import io

import m3dc
from m3dc.analysis import Analyser
from m3dc.diagnostics import report
from m3dc.text.files import OneText
from m3dc.text.places import Places
from m3dc.text.source import Source
from m3dc.text.span import MAIN, REACH, Absolute, FileId, Local, Placed

OTHER = FileId(1)


class Shelf:
    """Files that count how often each is read."""

    def __init__(self, *texts: bytes) -> None:
        self.sources = [Source(text, f"{number}.m3d", FileId(number)) for number, text in enumerate(texts)]
        self.asked: list[FileId] = []

    def resolve(self, name: str, beside: FileId) -> FileId | None:
        del beside
        return next((source.file for source in self.sources if source.name == name), None)

    def read(self, file: FileId) -> Source:
        self.asked.append(file)
        return self.sources[file]


def test_no_file_but_the_scene_is_read() -> None:
    shelf = Shelf(b"SOLID { SPHERE { RADIUS 2 } }\nLIGHT { SOURCE { } }\n", b"SOLID {")
    assert m3dc.compile(shelf).ir["spheres"]["radius"].tolist() == [2.0]
    assert Analyser().analyse(shelf).ok
    assert set(shelf.asked) == {MAIN}


def test_a_text_leads_to_no_other_file() -> None:
    text = OneText(Source(b"SOLID { }", "a.m3d"))
    assert text.resolve("b.m3d", MAIN) is None
    assert text.read(MAIN).name == "a.m3d"
    assert m3dc.compile(text).diagnostics == m3dc.compile(b"SOLID { }").diagnostics


def test_a_diagnostic_is_shown_from_the_file_that_it_names() -> None:
    """As it will be when a scene has several: the excerpt, line and name are those of the file at the place."""
    shelf = Shelf(b"SOLID { }", b"\n\n    SPHERE { }\n")
    (found, *_) = m3dc.compile(shelf).diagnostics
    moved = found._replace(span=Absolute(OTHER, 6, 12), related=(m3dc.Related(found.span, "the block about it"),))
    printed = io.StringIO()
    report.print_human([moved], shelf, printed)
    first, excerpt, carets, *rest = printed.getvalue().splitlines()
    assert first.startswith("1.m3d:3:5: ")
    assert excerpt.endswith("|     SPHERE { }")
    assert carets.endswith("     ^^^^^^")
    assert any(line.endswith("the block about it: 0.m3d:1:1") for line in rest)
    assert '"file": "1.m3d"' in report.json_lines([([moved], shelf)])
    assert '"uri": "1.m3d"' in report.sarif([([moved], shelf)])


def test_items_of_several_files_have_places_of_their_own() -> None:
    places = Places()
    here, there = places.new(MAIN, 10), places.new(OTHER, 10)
    span = Local(2, 5)
    assert places.absolute(span.at(here)) == Absolute(MAIN, 12, 15)
    assert places.absolute(span.at(there)) == Absolute(OTHER, 12, 15)
    assert span.within(10) == (12, 15)


def test_an_item_keeps_its_number_when_it_moves() -> None:
    before = Places()
    base = before.new(MAIN, 100)
    place = Local(0, 4).at(base)
    after = Places(before)
    after.put(base, MAIN, 130)
    assert before.absolute(place).bytes == (100, 104)
    assert after.absolute(place).bytes == (130, 134)
    assert after.new(MAIN, 0) == 2 * REACH


def test_places_are_never_taken_for_one_another() -> None:
    values = [Local(3, 4), Placed(3, 4), Absolute(MAIN, 3, 4), (3, 4)]
    assert len(set(values)) == len(values)
