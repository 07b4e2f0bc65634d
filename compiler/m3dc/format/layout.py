"""Where a scene's lines break, and how far they are indented: the rules of docs/formatting.md.

`Layout` decides the white space before each atom and after the last, from the tokens and from where their author broke
the lines. It never looks at how far anything was indented, except to see what was lined up.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import accumulate, pairwise

from ..text.span import Span
from .atoms import COMMENT, ROWS, Atom, Item, Layers
from .columns import Cell, Column
from .rows import TAB, Change, Rows, lead_at, moved_comment

WIDTH = 100
INDENT = 4
# A key longer than this is not lined up with its neighbours, nor they with it.
WIDEST_KEY = 32
# No blank stands before these.
STICKING = (",", ";")
# What may differ between lines that are lined up token by token.
VALUES = ("number", "identifier", ROWS)

_POINT = re.compile(b"[.eE]")


class Layout:
    """The white space of one scene. `eol` ends its lines; its text begins at byte `start`, after a byte order mark."""

    def __init__(self, data: bytes, layers: Layers, start: int, eol: bytes) -> None:
        self._data = data
        self._eol = eol
        self._start = start
        self._atoms = atoms = layers.atoms
        # The white space before each atom, and at the end; as it is on one line until decided otherwise.
        self._before = [b"" if atom.kind in STICKING else b" " for atom in atoms]
        self._before.append(b"\n" if atoms else b"")
        self._number_lines()
        self._measure()
        self._rows: dict[int, int] = {}
        if atoms:
            self._before[0] = b""
            self._members(layers.items, -1, len(atoms), 0, apart=False)
            self._line_up_comments()

    # --- what was written -------------------------------------------------------------------------------------------

    def _number_lines(self) -> None:
        """The lines of the source on which each atom begins and ends."""
        self._first_line: list[int] = []
        self._last_line: list[int] = []
        line, done = 0, self._start
        for atom in self._atoms:
            line += self._data.count(b"\n", done, atom.start)
            self._first_line.append(line)
            line += self._data.count(b"\n", atom.start, atom.end)
            self._last_line.append(line)
            done = atom.end

    def _breaks(self, gap: int) -> int:
        """How many line ends there are in the source before an atom."""
        return self._first_line[gap] - self._last_line[gap - 1] if gap else 0

    def _on_one_line(self, first: int, last: int) -> bool:
        """Whether some atoms are written on one line, and are one line each."""
        return self._first_line[first] == self._last_line[last]

    def _measure(self) -> None:
        """Where each atom ends when all stand on one line."""
        self._widths = [self._width(atom) for atom in self._atoms]
        sizes = (len(blank) + width for blank, width in zip(self._before, self._widths, strict=False))
        self._ends = list(accumulate(sizes))

    def _width(self, atom: Atom) -> int:
        size = atom.end - atom.start
        return len(self._text(atom.start, atom.end)) if atom.kind == COMMENT else size

    def _text(self, start: int, end: int) -> str:
        return self._data[start:end].decode("utf-8", "replace")

    def _flat_width(self, first: int, last: int) -> int:
        """How wide some atoms are on one line."""
        return self._ends[last] - self._ends[first] + self._widths[first]

    # --- lines ------------------------------------------------------------------------------------------------------

    def _break(self, gap: int, indent: int, *, blank: bool = False) -> None:
        self._before[gap] = b"\n" * (2 if blank else 1) + b" " * indent

    def _starts_line(self, gap: int) -> bool:
        return gap == 0 or self._before[gap].startswith(b"\n")

    def _column(self, index: int, indent: int) -> int:
        """Where an atom begins: behind the comments before it on its line, which begins at `indent`."""
        column = 0
        while not self._starts_line(index):
            index -= 1
            column += 1
            if self._first_line[index] != self._last_line[index]:
                last = self._data[self._data.rfind(b"\n", 0, self._atoms[index].end) + 1 : self._atoms[index].end]
                return indent + column + len(last.strip().decode("utf-8", "replace"))
            column += self._widths[index]
        return indent + column

    def _members(self, items: tuple[Item, ...], before: int, after: int, indent: int, *, apart: bool) -> None:
        """Lays out items and comments that stand on lines of their own, between the atoms `before` and `after`: a
        broken block's braces, or the ends of the file. `apart`: each item gets its own line."""
        shared = set[int]() if apart else self._shared(items, before, indent)
        at = before
        for item in items:
            if item.first not in shared:
                self._separate(at, item.first, indent)
            at = item.last
        if after < len(self._atoms):
            self._separate(at, after, indent)
            self._break(after, indent - INDENT)
        elif at < after - 1:
            self._separate(at, after - 1, indent)
        self._line_up(items, shared)
        self._line_up_blocks(items, indent)
        for item in items:
            self._item(item, indent)

    def _shared(self, items: tuple[Item, ...], before: int, indent: int) -> set[int]:
        """The first atoms of the statements that go on the line of the one before: written so, and not too wide."""
        shared = set[int]()
        run: list[Item] = []

        def end_run() -> None:
            if len(run) > 1:
                self._separate(start_of_run, run[0].first, indent)
                column = self._column(run[0].first, indent)
                if column + self._flat_width(run[0].first, run[-1].last) <= WIDTH:
                    shared.update(item.first for item in run[1:])
            run.clear()

        start_of_run = at = before
        for item in items:
            statement = item.kind == "statement"
            if not (run and statement and self._on_one_line(run[-1].first, item.last)):
                end_run()
            if statement:
                if not run:
                    start_of_run = at
                run.append(item)
            at = item.last
        end_run()
        return shared

    def _separate(self, before: int, after: int, indent: int) -> None:
        """Puts a line's end between two atoms with nothing but comments between them. Comments keep their lines."""
        opening = before < 0 or self._atoms[before].kind == "{"
        broken = False
        for gap in range(before + 1, after + 1):
            breaks = self._breaks(gap)
            if breaks:
                broken = True
                first = gap - 1 == before and opening
                self._break(gap, indent, blank=breaks > 1 and not first and self._atoms[gap].kind != "}")
        if not broken and before >= 0 and self._atoms[after].kind != COMMENT:
            # A comment without a line of its own belongs to what stands before it, but for a brace.
            self._break(before + 1 if opening else after, indent)

    def _item(self, item: Item, indent: int) -> None:
        if item.kind == "declaration":
            self._declaration(item, indent)
        elif item.open < 0:
            self._inside(item.first, item.last, indent)
        elif not self._stays_flat(item, indent):
            self._broken(item, indent)

    def _stays_flat(self, item: Item, indent: int) -> bool:
        """Whether an item with braces goes on one line: if they are written on one, or empty, and it is not too
        wide. The brace may be written below its keyword, but not where a comment holds the two apart."""
        if not self._on_one_line(item.open, item.close) and item.close > item.open + 1:
            return False
        if self._has_comment(item.first, item.open) and not self._on_one_line(item.first, item.open):
            return False
        return self._column(item.first, indent) + self._flat_width(item.first, item.last) <= WIDTH

    def _has_comment(self, first: int, last: int) -> bool:
        return any(self._atoms[index].kind == COMMENT for index in range(first, last))

    def _broken(self, item: Item, indent: int) -> None:
        self._inside(item.first, item.open - 1, indent)
        for gap in range(item.open, item.first, -1):
            if self._atoms[gap - 1].kind != COMMENT:
                break
            if self._breaks(gap - 1):
                self._break(gap - 1, indent)
        self._break(item.open, indent)
        if item.kind == "table":
            self._table(item, indent)
        else:
            apart = self._on_one_line(item.open, item.close)
            self._members(item.members, item.open, item.close, indent + INDENT, apart=apart)

    def _table(self, item: Item, indent: int) -> None:
        """A table's rows keep their lines."""
        at = item.open
        while self._atoms[at + 1].kind == COMMENT:
            at += 1
        if at + 1 < item.close:
            self._rows[at + 1] = indent + INDENT
            self._break(at + 1, indent + INDENT)
        self._break(item.close, indent)

    def _inside(self, first: int, last: int, indent: int) -> None:
        """A statement is one line, but where a comment in it ends a line or has one of its own."""
        for gap in range(first + 1, last + 1):
            comment = self._atoms[gap].kind == COMMENT or self._atoms[gap - 1].kind == COMMENT
            if comment and self._breaks(gap):
                self._break(gap, indent + INDENT)

    def _declaration(self, item: Item, indent: int) -> None:
        """The names of a declaration keep their lines, are filled into more where they are too wide, and line up."""
        column = margin = indent + self._widths[item.first] + len(self._before[item.first + 1])
        for gap in range(item.first + 1, item.last + 1):
            before, kind = self._atoms[gap - 1].kind, self._atoms[gap].kind
            blank = len(self._before[gap]) if gap > item.first + 1 else 0
            # The comma or semicolon after a name goes with it.
            width = self._widths[gap] + (kind == "identifier")
            wraps = before == "," and kind != COMMENT and column + blank + width > WIDTH
            if wraps or (self._breaks(gap) and (before == "," or COMMENT in (before, kind))):
                self._break(gap, margin)
                column = margin + self._widths[gap]
            else:
                column += blank + self._widths[gap]
            if not self._on_one_line(gap, gap):
                column = WIDTH

    # --- lining up --------------------------------------------------------------------------------------------------

    def _line_up(self, items: tuple[Item, ...], shared: set[int]) -> None:
        """Values of one kind on consecutive lines begin in one column."""
        section: list[Item] = []
        kind = ""
        for item, following in pairwise([*items, None]):
            assert item is not None
            own = self._starts_line(item.first) and not (following and following.first in shared)
            now = self._kind_of_line(item) if own else ""
            if not (now and now == kind and section and self._follows(section[-1], item)):
                self._pad(section)
                section = []
            kind = now
            if now:
                section.append(item)
        self._pad(section)

    def _kind_of_line(self, item: Item) -> str:
        """What an item can be lined up with, if with anything: what it begins with must not be too long."""
        second = self._atoms[item.first + 1].kind if item.last > item.first else COMMENT
        if second == COMMENT or self._widths[item.first] > WIDEST_KEY:
            return ""
        if item.kind == "declaration":
            return item.kind
        if self._has_comment(item.first, item.last):
            return ""
        if item.kind == "assignment" and item.open < 0:
            return item.kind
        return "vector" if item.kind == "statement" and second == "<" else ""

    def _follows(self, item: Item, following: Item) -> bool:
        """Whether an item stands on the line after another's."""
        gaps = range(item.last + 1, following.first)
        return (
            self._before[following.first].count(b"\n") == 1
            and not any(self._starts_line(gap) for gap in gaps)
            and all(self._on_one_line(gap, gap) for gap in gaps)
        )

    def _pad(self, section: list[Item]) -> None:
        widest = max((self._widths[item.first] for item in section), default=0)
        for item in section if len(section) > 1 else ():
            self._before[item.first + 1] = b" " * (widest - self._widths[item.first] + 1)

    def _line_up_blocks(self, items: tuple[Item, ...], indent: int) -> None:
        """The columns of blocks on consecutive lines, one line each, that differ in numbers and names alone."""
        section: list[list[Cell]] = []
        columns: list[Column] = []
        shape: list[str] = []
        before: Item | None = None
        for item in items:
            now = self._shape(item, indent)
            line = self._cells(item, now)
            joined = None
            if now and now == shape and before is not None and self._follows(before, item):
                joined = [column.joined(cell) for column, cell in zip(columns, line, strict=True)]
                padding = sum(column.width - cell.width for column, cell in zip(joined, line, strict=True))
                joined = joined if indent + self._flat_width(item.first, item.last) + padding <= WIDTH else None
            if joined is None:
                self._pad_blocks(section, columns)
                section, joined = [], [Column.of(cell) for cell in line]
            section.append(line)
            before, shape, columns = item, now, joined
        self._pad_blocks(section, columns)

    def _shape(self, item: Item, indent: int) -> list[str]:
        """The kinds of an item's tokens, with one kind for numbers and names; empty if the item has no columns: where
        it has no braces or a comment inside, is a table, or is not on one line that begins with it."""
        if item.open < 0 or item.kind == "table" or not self._starts_line(item.first):
            return []
        atoms = self._atoms[item.first : item.last + 1]
        shape = ["value" if atom.kind in VALUES else atom.kind for atom in atoms]
        return shape if COMMENT not in shape and self._stays_flat(item, indent) else []

    def _cells(self, item: Item, shape: list[str]) -> list[Cell]:
        """The values of an item."""
        found: list[Cell] = []
        for index, kind in enumerate(shape, item.first):
            if kind == "value":
                start, end, kind = self._atoms[index]
                point = _POINT.search(self._data, start, end) if kind == "number" else None
                before = 0 if kind != "number" else end - start if point is None else point.start() - start
                found.append(Cell(index, self._widths[index], before, kind == "number"))
        return found

    def _pad_blocks(self, section: list[list[Cell]], columns: list[Column]) -> None:
        for line in section if len(section) > 1 else ():
            for column, cell in zip(columns, line, strict=True):
                lead, behind = column.blanks(cell)
                following = cell.atom + 1 + (self._atoms[cell.atom + 1].kind in STICKING)
                self._before[cell.atom] += b" " * lead
                self._before[following] += b" " * behind

    def _line_up_comments(self) -> None:
        """Comments that end consecutive lines and were written in one column stay in one."""
        section: list[tuple[int, int]] = []
        last, column = -1, None
        for index in self._trailing_comments():
            start = self._line_start(index)
            width = len(self._output(start, index).expandtabs(TAB))
            now = self._source_column(index)
            next_line = start == last + 1 and self._before[start].count(b"\n") == 1
            if not next_line or now is None or now != column or width > WIDTH:
                self._pad_comments(section)
                section = []
            if width <= WIDTH:
                section.append((index, width))
            last, column = index, now
        self._pad_comments(section)

    def _source_column(self, index: int) -> int | None:
        """The column in which an atom was written, unless that is far to the right."""
        start = self._atoms[index].start
        leftmost = max(start - 4 * WIDTH, self._start)
        line = self._data.rfind(b"\n", leftmost, start) + 1
        if not line and leftmost > self._start:
            return None
        return len(self._text(line or self._start, start).expandtabs(TAB))

    def _trailing_comments(self) -> Iterator[int]:
        for index in range(1, len(self._atoms)):
            if (
                self._atoms[index].kind == COMMENT
                and not self._starts_line(index)
                and self._before[index + 1].startswith(b"\n")
                and self._first_line[index] == self._last_line[index]
                and self._line_start(index) >= 0
            ):
                yield index

    def _line_start(self, index: int) -> int:
        """The first atom of an atom's line, or -1 where the line begins within an atom."""
        while not self._starts_line(index):
            index -= 1
            if self._first_line[index] != self._last_line[index]:
                return -1
        return index

    def _output(self, first: int, last: int) -> str:
        """A line from an atom up to, and without, another and the blank before it."""
        parts = [self._before[first].rpartition(b"\n")[2]]
        for index in range(first, last):
            parts += [self._data[self._atoms[index].start : self._atoms[index].end], self._before[index + 1]]
        return b"".join(parts[:-1]).decode("utf-8", "replace")

    def _pad_comments(self, section: list[tuple[int, int]]) -> None:
        widest = max((width for _, width in section), default=0)
        for index, width in section:
            self._before[index] = b" " * (widest - width + 1)

    # --- what is to be changed --------------------------------------------------------------------------------------

    def changes(self, *, large: bool = False, within: Span | None = None) -> Iterator[Change]:
        """All white space that is to be replaced, in order. `large`: a change may be a whole table's rows. `within`: of
        a table's rows, only those that may touch that range."""
        data, end = self._data, self._start
        margin = b""
        for index, (atom, before) in enumerate(zip(self._atoms, self._before, strict=False)):
            rows = None
            if index in self._rows:
                line = data.rfind(b"\n", end, atom.start)
                rows = Rows(data, atom.start, atom.end, None if line < 0 else lead_at(data, line + 1))
                before += b" " * rows.offset
            yield from self._gap(end, atom.start, before)
            if self._starts_line(index):
                margin = before.rpartition(b"\n")[2]
            if rows is not None:
                indent = self._rows[index]
                yield from rows.moved(indent, self._eol) if large else rows.changes(indent, self._eol, within)
            elif atom.kind == COMMENT and self._first_line[index] != self._last_line[index]:
                old = self._margin_in_source(index)
                yield from moved_comment(data, (atom.start, atom.end), old, margin, self._eol)
            end = atom.end
        yield from self._gap(end, len(data), self._before[-1])

    def _gap(self, start: int, end: int, text: bytes) -> Iterator[Change]:
        text = text.replace(b"\n", self._eol)
        if self._data[start:end] != text:
            yield Change(start, end, text)

    def _margin_in_source(self, index: int) -> bytes | None:
        """The white space that begins an atom's line in the source; None where the line begins within an atom, there
        or as it is laid out."""
        line = max(self._data.rfind(b"\n", 0, self._atoms[index].start) + 1, self._start)
        within = index
        while within and self._atoms[within - 1].end > line:
            within -= 1
        if self._atoms[within].start < line or self._line_start(index) < 0:
            return None
        return lead_at(self._data, line)
