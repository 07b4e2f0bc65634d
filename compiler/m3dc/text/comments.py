"""The comments of a text: where they are, and which of them tells what a thing is."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right

from m3d_language.comments import outermost

from . import long_tables
from .span import Span

LONGEST_TITLE = 60  # characters

_FRAME = re.compile(r"^[\s/*=#~_-]+|[\s/*=#~_-]+$")
_SENTENCE_END = re.compile(r"(?<=[.:;])\s")
_DIRECTIVE = re.compile(r"m3d:")


class Comments:
    """The comments of a text in order; one within another is part of it. One that is never closed goes to the end."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self.spans = tuple(_spans(data))
        self._starts = [start for start, _ in self.spans]

    def at(self, offset: int) -> Span | None:
        """The comment that a byte stands in."""
        index = bisect_right(self._starts, offset) - 1
        return self.spans[index] if index >= 0 and offset < self.spans[index][1] else None

    def within(self, span: Span) -> tuple[Span, ...]:
        """The comments that begin in a range."""
        return self.spans[bisect_left(self._starts, span[0]) : bisect_left(self._starts, span[1])]

    def before(self, offset: int) -> int:
        """Where the comments begin that stand right before something, on its line or on lines of their own above it
        without an empty one between; else the offset itself."""
        index = bisect_left(self._starts, offset) - 1
        while index >= 0:
            start, end = self.spans[index]
            between = self._data[end:offset]
            if between.strip() or between.count(b"\n") > 1 or not self._is_first(start, b"\n" in between):
                break
            offset = start
            index -= 1
        return offset

    def _is_first(self, start: int, own_line: bool) -> bool:
        """Whether a comment belongs to what follows it: it begins its line, or shares it with that."""
        line = self._data.rfind(b"\n", 0, start) + 1
        return not own_line or not self._data[line:start].strip()

    def title(self, span: Span, body: int | None = None) -> str | None:
        """What a comment calls the thing at `span`: one between its head and its `body`, one right before it, or one
        after it that ends the line. The first sentence of it, shortened."""
        candidates = list(self.within((span[0], body))) if body is not None else []
        above = self.before(span[0])
        candidates += self.within((above, span[0]))
        after = self._after(span[1])
        if after is not None:
            candidates.append(after)
        titles = (_title(self._data[start:end].decode("utf-8", "replace")) for start, end in candidates)
        return next((title for title in titles if title), None)

    def behind(self, end: int, separators: bytes = b"") -> Span | None:
        """The comment that follows something on its line, perhaps behind a separator."""
        index = bisect_left(self._starts, end)
        if index == len(self.spans):
            return None
        between = self._data[end : self.spans[index][0]]
        return None if between.strip(b" \t" + separators) else self.spans[index]

    def _after(self, end: int) -> Span | None:
        index = bisect_left(self._starts, end)
        if index == len(self.spans):
            return None
        start, stop = self.spans[index]
        line_end = self._data.find(b"\n", stop)
        rest = self._data[stop : line_end if line_end >= 0 else len(self._data)]
        between = self._data[end:start]
        return None if between.strip() or b"\n" in between or rest.strip() else (start, stop)


def _spans(data: bytes) -> list[Span]:
    return [(begin, len(data) if end is None else end) for begin, end in outermost(data, long_tables.outside(data))]


def text_of(comment: str) -> list[str]:
    """The lines of a comment without what frames it, none of them empty; none of a directive."""
    if _DIRECTIVE.search(comment):
        return []
    return [line for line in (_FRAME.sub("", line) for line in comment.splitlines()) if line]


def _title(comment: str) -> str | None:
    """The first sentence of a comment; None of a directive."""
    line = next(iter(text_of(comment)), "")
    if not line:
        return None
    text = " ".join(_SENTENCE_END.split(line, maxsplit=1)[0].split()).rstrip(".:;")
    return text if len(text) <= LONGEST_TITLE else text[: LONGEST_TITLE - 1].rstrip() + "…"
