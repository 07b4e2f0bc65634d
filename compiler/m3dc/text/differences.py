"""Where a text differs from an older version of it, edit by edit, and where places have moved to because of it."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from difflib import SequenceMatcher
from itertools import accumulate
from typing import NamedTuple

from .difference import Difference
from .span import Span


class Stretch(NamedTuple):
    """Text of an older version, and what is in its place in the newer one; one of the two may be empty."""

    old: Span
    new: Span


class Differences(NamedTuple):
    """What was changed between two versions of a text: as many stretches as there were edits, in order and apart."""

    stretches: tuple[Stretch, ...] = ()

    @classmethod
    def between(cls, old: bytes, new: bytes) -> Differences:
        """Whole lines that have come or gone, and words in lines that were changed. The effort grows with the text
        between the first and the last difference, in proportion to its length."""
        return cls(tuple(_changed(old, new)))

    def then(self, start: int, end: int, length: int) -> Differences:
        """These, and an edit of the newer text after them: so many bytes in place of those from `start` to `end`."""
        grown = length - (end - start)
        before: list[Stretch] = []
        after: list[Stretch] = []
        old_start, old_end = start, end  # less what the stretches before have added
        new_start, new_end = start, end
        shift = 0
        for stretch in self.stretches:
            (old_from, old_to), (new_from, new_to) = stretch
            if new_to < start:
                before.append(stretch)
                shift = new_to - old_to
                old_start, old_end = start - shift, end - shift
            elif new_from > end:
                after.append(Stretch(stretch.old, (new_from + grown, new_to + grown)))
            else:  # they are one from now on
                if new_from < new_start:
                    old_start, new_start = old_from, new_from
                shift = new_to - old_to
                new_end = max(new_end, new_to)
                old_end = new_end - shift
                old_start = min(old_start, old_from)
        joined = Stretch((old_start, old_end), (new_start, new_end + grown))
        is_there = old_start < old_end or new_start < joined.new[1]
        return Differences((*before, *([joined] if is_there else []), *after))

    def span(self, span: Span) -> Span:
        """Where a range of the older text is in the newer one. What was changed within it is part of it, what has come
        directly before or after it is not; where an end of it was changed, it reaches to the end of that change."""
        start, end = span
        return self._start(start), max(self._start(start), self._end(end))

    def back(self, offset: int) -> Span:
        """Where a place of the newer text was in the older one, as two bytes: what begins at or before the first and
        ends at or after the second held the place. Text that has come was held by what reaches across it on both sides;
        where text has gone, both what ended and what began there holds the place."""
        at = bisect_left(self.stretches, offset, key=lambda stretch: stretch.new[1])
        if at == len(self.stretches) or offset < self.stretches[at].new[0]:
            place = offset - self._grown(at)
            return place, place
        (old_start, old_end), (new_start, new_end) = self.stretches[at]
        if old_start == old_end:
            return old_start - (offset < new_end), old_start + (offset > new_start)
        if new_start == new_end:
            return old_end, old_start
        if offset in (new_start, new_end):
            old_start = old_end = old_start if offset == new_start else old_end
        return old_start, old_end

    def _start(self, offset: int) -> int:
        at = bisect_right(self.stretches, offset, key=lambda stretch: stretch.old[0]) - 1
        if at < 0:
            return offset
        (_, old_end), (new_start, new_end) = self.stretches[at]
        return new_end + offset - old_end if offset >= old_end else new_start

    def _end(self, offset: int) -> int:
        at = bisect_left(self.stretches, offset, key=lambda stretch: stretch.old[0]) - 1
        if at < 0:
            return offset
        (_, old_end), (_, new_end) = self.stretches[at]
        return new_end + max(offset - old_end, 0)

    def _grown(self, count: int) -> int:
        """How much longer the text has become with the first stretches."""
        return self.stretches[count - 1].new[1] - self.stretches[count - 1].old[1] if count else 0


# Two sequences without anything that stands in both once are compared each with each if they are no longer than this.
EACH_WITH_EACH = 200
# Longer changes of lines are not looked into for words.
MOST_WORDS_IN = 20_000

_WORD = re.compile(rb"\w+|\s|[^\w\s]")


def _changed(old: bytes, new: bytes) -> Iterator[Stretch]:
    start, old_end, new_end = Difference.between(old, new)
    if start == old_end == new_end:
        return
    # Whole lines: where a line has come before one that begins alike, it is not the beginning of that one.
    start = old.rfind(b"\n", 0, start) + 1
    tail = len(old) - old_end
    if not (_begins_line(old, old_end) and _begins_line(new, new_end)):
        line = old.find(b"\n", old_end)
        tail = 0 if line < 0 else len(old) - line - 1
    old_lines = old[start : len(old) - tail].splitlines(keepends=True)
    new_lines = new[start : len(new) - tail].splitlines(keepends=True)
    for stretch in _apart(old_lines, new_lines, start):
        (old_from, old_to), (new_from, new_to) = stretch
        if old_from < old_to and new_from < new_to and max(old_to - old_from, new_to - new_from) <= MOST_WORDS_IN:
            words = (_WORD.findall(old[old_from:old_to]), _WORD.findall(new[new_from:new_to]))
            yield from _apart(*words, old_from, new_from)
        else:
            yield stretch


def _begins_line(text: bytes, offset: int) -> bool:
    return offset == 0 or text[offset - 1 : offset] == b"\n"


def _apart(old: list[bytes], new: list[bytes], old_start: int, new_start: int | None = None) -> Iterator[Stretch]:
    """The stretches in which two lists of pieces differ; they start at these bytes."""
    old_places = list(accumulate(map(len, old), initial=old_start))
    new_places = list(accumulate(map(len, new), initial=old_start if new_start is None else new_start))
    i = j = 0
    for same_i, same_j, count in (*_same(old, new), (len(old), len(new), 0)):
        if i < same_i or j < same_j:
            yield Stretch((old_places[i], old_places[same_i]), (new_places[j], new_places[same_j]))
        i, j = same_i + count, same_j + count


def _same(old: list[bytes], new: list[bytes]) -> Iterator[tuple[int, int, int]]:
    """Runs of pieces that two lists have in common, in order: where they begin in each, and how many they are.

    What stands in both once is the same; between two of those it is looked again ("patience diff"). Parts in which
    there is nothing such are compared each with each, or, when they are long, taken to be altogether different.
    """
    parts = [(0, len(old), 0, len(new))]
    while parts:
        i, i_end, j, j_end = parts.pop()
        head = _common(old, new, i, j, min(i_end - i, j_end - j), 1)
        if head:
            yield i, j, head
            i, j = i + head, j + head
        tail = _common(old, new, i_end - 1, j_end - 1, min(i_end - i, j_end - j), -1)
        if tail:  # in its turn, after what comes before it
            parts.append((i_end - tail, i_end, j_end - tail, j_end))
            parts.append((i, i_end - tail, j, j_end - tail))
            continue
        if i == i_end or j == j_end:
            continue
        anchors = _anchors(old, new, i, i_end, j, j_end)
        if anchors:
            ends = [*anchors, (i_end, j_end)]
            between = [(*start, *end) for start, end in zip([(i, j), *anchors], ends, strict=True)]
            parts += [(i1, i2, j1, j2) for i1, j1, i2, j2 in reversed(between)]
        elif i_end - i <= EACH_WITH_EACH and j_end - j <= EACH_WITH_EACH:
            for block in SequenceMatcher(None, old[i:i_end], new[j:j_end], autojunk=False).get_matching_blocks():
                if block.size:
                    yield i + block.a, j + block.b, block.size


def _common(old: list[bytes], new: list[bytes], i: int, j: int, most: int, step: int) -> int:
    """How many pieces are the same from two places on, forwards or backwards."""
    count = 0
    while count < most and old[i + step * count] == new[j + step * count]:
        count += 1
    return count


def _anchors(old: list[bytes], new: list[bytes], i: int, i_end: int, j: int, j_end: int) -> list[tuple[int, int]]:
    """Where pieces are that stand in both parts once; the most of them that come in the same order."""
    once_old, once_new = _once(old, i, i_end), _once(new, j, j_end)
    pairs = [(place, once_new[piece]) for piece, place in once_old.items() if piece in once_new]
    lasts: list[int] = []  # of increasing runs of each length, the smallest last place in the new text
    ends: list[int] = []  # which pair that is
    before: list[int] = []
    for number, (_, place) in enumerate(pairs):
        length = bisect_left(lasts, place)
        before.append(ends[length - 1] if length else -1)
        lasts[length : length + 1] = [place]
        ends[length : length + 1] = [number]
    found: list[tuple[int, int]] = []
    at = ends[-1] if ends else -1
    while at >= 0:
        found.append(pairs[at])
        at = before[at]
    return found[::-1]


def _once(pieces: list[bytes], start: int, end: int) -> dict[bytes, int]:
    """The pieces that stand in a part once, in order, and where."""
    found: dict[bytes, int] = {}
    for place in range(start, end):
        found[pieces[place]] = -1 if pieces[place] in found else place
    return {piece: place for piece, place in found.items() if place >= 0}
