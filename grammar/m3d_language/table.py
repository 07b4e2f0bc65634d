"""The language table: every block and statement of the scene language, as language.toml describes them.

`LANGUAGE` is the one description that the checker, the evaluator, the editor features and the generators read. It is
loaded from `language.json`, which `make generate` writes from grammar/language.toml.
"""

import json
import math
import os
from collections.abc import Mapping
from functools import cached_property
from typing import Any, Literal, NamedTuple, cast

Shape = Literal["number", "integer", "vector"]
Policy = Literal["error", "default", "limit", "warn"]
Default = float | bool | tuple[float, ...] | None

TABLE_FILE = os.path.join(os.path.dirname(__file__), "language.json")


class Interval(NamedTuple):
    """The values a number may have: `low` to `high`, each with or without its end; `nonzero` is all but 0."""

    low: float
    high: float
    low_open: bool
    high_open: bool
    nonzero: bool = False

    @classmethod
    def parse(cls, text: str) -> "Interval":
        """From the notation of language.toml: `[0, 1]`, `(0, inf)`, `nonzero`. Raises ValueError on any other."""
        if text == "nonzero":
            return cls(-math.inf, math.inf, False, False, True)
        if len(text) < 5 or text[0] not in "[(" or text[-1] not in "])" or text.count(",") != 1:
            raise ValueError(f"not an interval: {text!r}, expected one such as [0, 1], (0, inf) or nonzero")
        low, high = (float(part) for part in text[1:-1].split(","))
        return cls(low, high, text[0] == "(", text[-1] == ")")

    def __contains__(self, value: object) -> bool:
        if not isinstance(value, (int, float)):
            return False
        if self.nonzero:
            return value != 0
        above = value > self.low if self.low_open else value >= self.low
        below = value < self.high if self.high_open else value <= self.high
        return above and below

    def nearest(self, value: float) -> float:
        """The bound nearest to a value outside."""
        return min(max(value, self.low), self.high)

    def __str__(self) -> str:
        if self.nonzero:
            return "any but 0"
        low = f"{'more than' if self.low_open else 'at least'} {self.low:g}" if self.low > -math.inf else ""
        high = f"{'less than' if self.high_open else 'at most'} {self.high:g}" if self.high < math.inf else ""
        if low and high and not self.low_open and not self.high_open:
            return f"{self.low:g} to {self.high:g}"
        return " and ".join(bound for bound in (low, high) if bound) or "any"


class Bounds(NamedTuple):
    """The values allowed, and what happens to others: `policy` and the `message` for it."""

    interval: Interval
    policy: Policy
    message: str


class Argument(NamedTuple):
    """One argument: its kind (point, angle, color, ...), what a person would call it, and the shape and unit.

    `components` are what the numbers of a vector are called; `often` are values by what they mean.
    """

    kind: str
    name: str
    shape: Shape
    unit: str
    says: str
    bounds: Bounds | None
    components: tuple[str, ...]
    often: Mapping[str, Default]


class Statement(NamedTuple):
    """A statement of a block. Without arguments it is a flag. `often` are values of its argument by what they mean."""

    keyword: str
    arguments: tuple[Argument, ...]
    default: Default
    bounds: Bounds | None
    often: Mapping[str, Default]
    says: str
    thesis: str

    @property
    def is_flag(self) -> bool:
        return not self.arguments


class Table(NamedTuple):
    """A table of a block: numbers in braces. `head` is read once, `row` as often as it comes."""

    keyword: str
    head: tuple[Argument, ...]
    row: tuple[Argument, ...]
    says: str
    thesis: str


class Block(NamedTuple):
    """A block `KEYWORD { ... }` and what may stand in it."""

    keyword: str
    holds: tuple[str, ...]
    statements: Mapping[str, Statement]
    tables: Mapping[str, Table]
    variable: bool
    adds: bool
    once: str | None
    uses: tuple[str, ...]
    usual: tuple[str, ...]
    says: str
    example: str
    thesis: str

    def members(self) -> tuple[str, ...]:
        """Every keyword that may stand in the block."""
        return (*self.statements, *self.tables, *self.holds)


class Basic(NamedTuple):
    """One of the two basic variable types, NUMBER and VECTOR."""

    keyword: str
    default: Default
    says: str
    thesis: str


class Page(NamedTuple):
    """A page of the language reference, for the blocks of a section of the thesis."""

    name: str
    title: str
    thesis: str
    says: str


class Language:
    """The whole table. All mappings keep the order of language.toml."""

    def __init__(self, table: Mapping[str, Any]) -> None:
        self.limits: Mapping[str, int] = {name: int(most) for name, most in table["limit"].items()}
        self.reserved: tuple[str, ...] = tuple(table["reserved"])
        self.elsewhere: Mapping[str, str] = table["elsewhere"]
        self.types_elsewhere: Mapping[str, str] = table["type_elsewhere"]
        self.values_elsewhere: Mapping[str, str] = table["value_elsewhere"]
        self.colours: Mapping[str, str] = table["colour"]
        self.kinds: dict[str, Argument] = {kind: _kind(kind, entry) for kind, entry in table["argument"].items()}
        self.basics: dict[str, Basic] = {
            keyword: Basic(keyword, _default(entry["default"]), entry["says"], entry["thesis"])
            for keyword, entry in table["type"].items()
        }
        self.blocks: dict[str, Block] = {
            keyword: self._block(keyword, entry, table["shared"]) for keyword, entry in table["block"].items()
        }
        self.top: tuple[str, ...] = tuple(table["file"]["holds"])
        self.file_says: str = table["file"]["says"]
        self.variables: Mapping[str, str] = table["variables"]
        self.pages: tuple[Page, ...] = tuple(
            Page(name, entry["title"], entry["thesis"], entry["says"]) for name, entry in table["page"].items()
        )

    @cached_property
    def types(self) -> tuple[str, ...]:
        """The twelve variable types."""
        return (*self.basics, *(b.keyword for b in self.blocks.values() if b.variable))

    @cached_property
    def keywords(self) -> frozenset[str]:
        """Every reserved word (thesis, Appendix A)."""
        words = {*self.reserved, *self.basics, *self.blocks, "VARIABLES"}
        for block in self.blocks.values():
            words.update(block.statements, block.tables)
        return frozenset(words)

    @cached_property
    def parents(self) -> dict[str, tuple[str, ...]]:
        """For every keyword the blocks that it may stand in."""
        found: dict[str, list[str]] = {}
        for block in self.blocks.values():
            for member in block.members():
                found.setdefault(member, []).append(block.keyword)
        return {keyword: tuple(blocks) for keyword, blocks in found.items()}

    def _arguments(self, takes: str | list[str]) -> tuple[Argument, ...]:
        specs = [takes] if isinstance(takes, str) else takes
        arguments: list[Argument] = []
        for spec in specs:
            kind, _, name = spec.partition(" ")
            arguments.append(self.kinds[kind]._replace(name=name or kind))
        return tuple(arguments)

    def _statement(self, keyword: str, entry: Mapping[str, Any]) -> Statement:
        arguments, bounds = self._arguments(entry.get("takes", [])), _bounds(entry)
        often = _often(entry)
        if not often and len(arguments) == 1:
            known = arguments[0].often
            often = {label: value for label, value in known.items() if _within(value, bounds)}
        return Statement(
            keyword,
            arguments,
            _default(entry.get("default")),
            bounds,
            often,
            entry["says"],
            entry["thesis"],
        )

    def _table(self, keyword: str, entry: Mapping[str, Any]) -> Table:
        return Table(
            keyword,
            self._arguments(entry.get("head", [])),
            self._arguments(entry["row"]),
            entry["says"],
            entry["thesis"],
        )

    def _block(self, keyword: str, entry: Mapping[str, Any], shared: Mapping[str, Any]) -> Block:
        group: Mapping[str, Any] = shared[entry["shares"]] if "shares" in entry else {}
        statements: Mapping[str, Any] = {**group.get("statement", {}), **entry.get("statement", {})}
        tables: Mapping[str, Any] = {**group.get("table", {}), **entry.get("table", {})}
        return Block(
            keyword=keyword,
            holds=tuple(entry.get("holds", ())),
            statements={k: self._statement(k, e) for k, e in statements.items()},
            tables={k: self._table(k, e) for k, e in tables.items()},
            variable=entry.get("variable", False),
            adds=entry.get("adds", False),
            once=entry.get("once"),
            uses=tuple(entry.get("uses", ())),
            usual=tuple(entry.get("usual", ())),
            says=entry["says"],
            example=entry["example"],
            thesis=entry["thesis"],
        )


def _default(value: Any) -> Default:
    return tuple(cast(list[float], value)) if isinstance(value, list) else value


def _bounds(entry: Mapping[str, Any]) -> Bounds | None:
    if "range" not in entry:
        return None
    policy, _, message = entry["outside"].partition(": ")
    return Bounds(Interval.parse(entry["range"]), policy, message)


def _often(entry: Mapping[str, Any]) -> dict[str, Default]:
    return {label: _default(value) for label, value in entry.get("often", {}).items()}


def _within(value: Default, bounds: Bounds | None) -> bool:
    return bounds is None or all(part in bounds.interval for part in (value if isinstance(value, tuple) else (value,)))


def _kind(kind: str, entry: Mapping[str, Any]) -> Argument:
    shape: Shape = entry["shape"]
    components = tuple(entry.get("components", ("x", "y", "z") if shape == "vector" else ()))
    unit = entry.get("unit", "")
    return Argument(kind, kind, shape, unit, entry["says"], _bounds(entry), components, _often(entry))


# Not by pathlib, which would make up a twentieth of the compiler's start.
with open(TABLE_FILE, encoding="utf-8") as _file:
    LANGUAGE = Language(json.load(_file))
