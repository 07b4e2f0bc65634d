"""What lies between two versions of a text is as many stretches as there were edits."""

from __future__ import annotations

import random

import pytest

from m3dc.text.differences import Differences

LINES = [
    "SCENE { LOGSCALE 4 }",
    "SOLID { SPHERE { CENTER < 0, -2, 1 > } }",
    "SOLID { SPHERE { CENTER < 0, 0, 1 > } }",
    "SOLID { SPHERE { CENTER < 0, 2, 1 > } }",
    "LIGHT { SOURCE { FROM < 9, 9, 9 > } }",
    "",
]
TEXT = "\n".join(LINES).encode()


def stretches(old: bytes, new: bytes) -> list[tuple[bytes, bytes]]:
    """What has gone, and what has come in its place."""
    return [(old[slice(*gone)], new[slice(*come)]) for gone, come in Differences.between(old, new).stretches]


def moved(old: bytes, new: bytes, part: bytes) -> bytes:
    """The text of the newer version where a part of the older one is said to be."""
    start = old.index(part)
    return new[slice(*Differences.between(old, new).span((start, start + len(part))))]


def test_edits_far_apart_are_stretches_of_their_own() -> None:
    new = b"/* one */\n" + TEXT.replace(b"-2", b"-3") + b"SOLID {"
    assert stretches(TEXT, new) == [(b"", b"/* one */\n"), (b"2", b"3"), (b"", b"SOLID {")]
    assert moved(TEXT, new, LINES[2].encode()) == LINES[2].encode()
    two_in_a_line = TEXT.replace(b"SPHERE { CENTER < 0, 0", b"SPHERE { CENTRE < 0, 7")
    assert stretches(TEXT, two_in_a_line) == [(b"CENTER", b"CENTRE"), (b"0", b"7")]
    assert stretches(TEXT, TEXT) == []


def test_a_line_before_a_block_is_not_part_of_it() -> None:
    line = LINES[2].encode()
    for before in (b"/* one */\n", b"SOLID { SPHERE { } }\n", b"\n", LINES[1].encode() + b"\n"):
        new = TEXT.replace(line, before + line)
        assert moved(TEXT, new, line) == line
        assert moved(new, TEXT, line) == line
    assert moved(TEXT, TEXT.replace(line, line + b" /* one */"), line) == line
    assert moved(TEXT, TEXT.replace(line, b"/* one */ " + line), line) == line


def test_what_was_changed_within_a_block_is_part_of_it() -> None:
    line = LINES[2].encode()
    for old, new in ((b"0, 0, 1", b"0, 0"), (b"CENTER", b"RADIUS 2 CENTER"), (b" < 0, 0, 1 >", b"\n< 0,\n 0, 1 >")):
        changed = line.replace(old, new)
        assert moved(TEXT, TEXT.replace(line, changed), line) == changed


def test_where_a_place_was() -> None:
    line = LINES[2].encode()
    start = TEXT.index(line)
    end = start + len(line)

    def held(new: bytes, at: int) -> bool:
        low, high = Differences.between(TEXT, new).back(at)
        return start <= low and high <= end

    before = TEXT.replace(line, b"/* one */\n" + line)
    assert [held(before, at) for at in (start - 1, start, start + 3, start + 9)] == [False] * 4
    assert [held(before, at + 10) for at in (start, start + 3, end, end + 1)] == [True, True, True, False]
    within = TEXT.replace(line, line.replace(b"CENTER", b"RADIUS 2 CENTER"))
    assert all(held(within, at) for at in range(start, end + 9))
    gone = TEXT.replace(LINES[1].encode() + b"\n", b"")
    assert held(gone, gone.index(line))


def edited(text: bytes, chance: random.Random, differences: Differences) -> tuple[bytes, Differences]:
    start = chance.randint(0, len(text))
    end = min(len(text), start + chance.choice((0, 0, 1, 5, 40)))
    new = chance.choice((b"", b"x", b"\n", b"SOLID { }\n", b"/* one */", LINES[1].encode()))
    return text[:start] + new + text[end:], differences.then(start, end, len(new))


@pytest.mark.parametrize("seed", range(200))
def test_what_is_in_no_stretch_is_the_same_in_both(seed: int) -> None:
    """Recorded edit by edit, or found between the two texts; and what was not touched is where it is said to be."""
    chance = random.Random(seed)
    text, recorded = TEXT, Differences()
    for _ in range(chance.randint(1, 6)):
        text, recorded = edited(text, chance, recorded)
    for found in (recorded, Differences.between(TEXT, text)):
        made, done = b"", 0
        place = -1
        for (old_start, old_end), (new_start, new_end) in found.stretches:
            assert place < old_start <= old_end
            assert old_start < old_end or new_start < new_end
            made += TEXT[done:old_start]
            assert len(made) == new_start
            made += text[new_start:new_end]
            done = place = old_end
        assert made + TEXT[done:] == text
        for line in LINES[:-1]:
            start = TEXT.index(line.encode())
            end = start + len(line)
            if all(gone[1] <= start or gone[0] >= end for gone, _ in found.stretches):
                low, high = found.span((start, end))
                assert text[low:high] == line.encode()
                for at in range(low, high + 1):
                    where = found.back(at)
                    assert start <= where[0] <= end or start <= where[1] <= end
                assert found.back(low + 1) == (start + 1, start + 1)


@pytest.mark.parametrize("seed", range(50))
def test_lines_that_were_not_touched_are_found(seed: int) -> None:
    """Lines that all differ; some are taken out, changed, or put in."""
    chance = random.Random(seed)
    old = [f"SOLID {{ SPHERE {{ RADIUS {number} }} }}\n".encode() for number in range(60)]
    new: list[bytes] = []
    kept: list[bytes] = []
    for line in old:
        match chance.choice(("kept", "kept", "kept", "gone", "changed", "after")):
            case "kept":
                new.append(line)
                kept.append(line)
            case "changed":
                new.append(line.replace(b"SPHERE", b"CUBE"))
            case "after":
                new += [b"/* new */\n" * chance.randint(1, 3), line]
                kept.append(line)
            case _:
                pass
    for line in kept:
        assert moved(b"".join(old), b"".join(new), line) == line


def test_a_long_text_of_nothing_but_the_same() -> None:
    old, new = b"} {\n" * 100_000, b"/* */\n" + b"{ }\n" * 100_000
    ((gone, come),) = Differences.between(old, new).stretches
    assert (gone, come) == ((0, len(old)), (0, len(new)))
