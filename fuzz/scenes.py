"""Scenes as nobody writes them, made of the language table: every block, statement and table in every place where it
may stand, with ordinary and extreme numbers. Most have no error; `broken` makes others of them.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterable

from m3d_language import table as language
from m3d_language.table import LANGUAGE

TOKEN = re.compile(r"/\*.*?\*/|[^\s{}<>,;=]+|\S", re.DOTALL)
EXTREMES = (0.0, -0.0, 1.0, -1.0, 1e-300, 5e-324, 1e-20, 1e20, -1e20, 1e38, 1e150, -1e150, 1e154, 1e300, 1.7e308)
DEEPEST = 6
PIECES = (
    "{", "}", "<", ">", ",", ";", "=", "/*", "*/", "\n", "\r\n", "0", "-1", "1e9", "2.", ".5", "1e999", "x", "é", "🌅",
    "\x00", "\ufeff", "//", "sphere", "SPHERE", "SOLID", "SOLID {", "VARIABLES {", "PROFILE {", "v0", "v1",
)  # fmt: skip


class Scenes:
    """Makes scenes by chance; `extreme` is how often a number is one that nobody uses."""

    def __init__(self, chance: random.Random, extreme: float = 0.15) -> None:
        self.chance = chance
        self.extreme = extreme
        self.variables: dict[str, list[str]] = {}

    def scene(self) -> str:
        """A whole scene."""
        chance = self.chance
        parts: list[str] = []
        types = [chance.choice(LANGUAGE.types) for _ in range(chance.randrange(6))]
        if types:
            parts.append(f"VARIABLES {{ {' '.join(f'{type_} v{n};' for n, type_ in enumerate(types))} }}")
        for number, type_ in enumerate(types):
            parts.append(f"v{number} = {self._value(type_)}")
            self.variables.setdefault(type_, []).append(f"v{number}")
        tops = [top for top in LANGUAGE.top if top in LANGUAGE.blocks and top != "SCENE"]
        blocks = [chance.choice(tops) for _ in range(chance.randint(1, 4))]
        if chance.random() < 0.7:
            blocks.append("SCENE")
        parts += [self._block(keyword, 0) for keyword in blocks]
        return chance.choice((" ", "\n")).join(parts)

    def _value(self, type_: str) -> str:
        if type_ == "NUMBER":
            return spelled(self._any())
        if type_ == "VECTOR":
            return self._vector([self._any() for _ in range(3)])
        known = self.variables.get(type_)
        if known and self.chance.random() < 0.3:
            return self.chance.choice(known)
        return self._body(LANGUAGE.blocks[type_], 1)

    def _block(self, keyword: str, depth: int) -> str:
        known = self.variables.get(keyword)
        if known and self.chance.random() < 0.4:
            name = self.chance.choice(known)
            return (
                f"{keyword} {name}" if self.chance.random() < 0.5 else f"{keyword} {name} {self._again(keyword, depth)}"
            )
        return f"{keyword} {self._body(LANGUAGE.blocks[keyword], depth)}"

    def _again(self, keyword: str, depth: int) -> str:
        return self._body(LANGUAGE.blocks[keyword], depth)

    def _body(self, block: language.Block, depth: int) -> str:
        chance = self.chance
        members: list[str] = []
        once = {keyword for keyword in block.holds if not LANGUAGE.blocks[keyword].adds}
        for _ in range(chance.randrange(5)):
            kind = chance.random()
            if kind < 0.6 and block.statements:
                members.append(self._statement(chance.choice(list(block.statements.values()))))
            elif block.holds and depth < DEEPEST:
                keyword = chance.choice(block.holds)
                if keyword not in once or keyword == "TRANSFORM":
                    members.append(self._block(keyword, depth + 1))
        members += [self._block(k, depth + 1) for k in sorted(once) if k != "TRANSFORM" and chance.random() < 0.4]
        adds = [keyword for keyword in block.holds if LANGUAGE.blocks[keyword].adds]
        if adds and chance.random() < 0.9:
            members.append(self._block(chance.choice(adds), depth + 1))
        chance.shuffle(members)
        return f"{{ {' '.join([*members, *self._tables(block)])} }}"

    # --- tables ---------------------------------------------------------------------------------------------------

    def _tables(self, block: language.Block) -> list[str]:
        """The tables that a block needs, of a kind that is right in itself."""
        chance = self.chance
        if block.keyword == "POLYGONS":
            return self._polygons()
        if block.keyword == "TERRAIN":
            rows, columns = chance.randint(2, 4), chance.randint(2, 4)
            size = self._length()
            points = [self._vector([x * size, y * size, self._any()]) for x in range(rows) for y in range(columns)]
            return [f"VERTICES {{ {rows} {columns} {' '.join(points)} }}"]
        if block.keyword == "MIRAGE":
            heights = sorted(
                {round(chance.uniform(-20, 60), 2) for _ in range(chance.randint(3, 9))} | {0.0, 100.0, -30.0}
            )
            return [f"PROFILE {{ {' '.join(f'{h:g} {spelled(self._near(20, 15))}' for h in heights)} }}"]
        if "COLORS" in block.tables and chance.random() < 0.3:
            return [f"COLORS {{ 0 0.5 {self._color()} {self._color()} 0.5 1 {self._color()} {self._color()} }}"]
        return []

    def _polygons(self) -> list[str]:
        chance = self.chance
        count = chance.randint(3, 7)
        points = [self._vector([self._length() * chance.uniform(-1, 1) for _ in range(3)]) for _ in range(count)]
        facets = [chance.sample(range(count), 3) for _ in range(chance.randint(1, 5))]
        smooth = chance.random() < 0.4
        rows = [
            " ".join(map(str, facet))
            + (
                " " + " ".join(self._vector([chance.uniform(-1, 1) for _ in range(3)]) for _ in range(3))
                if smooth
                else ""
            )
            for facet in facets
        ]
        keyword = "SFACETS" if smooth else "FACETS"
        return [f"VERTICES {{ {count} {' '.join(points)} }}", f"{keyword} {{ {len(rows)} {' '.join(rows)} }}"]

    def _normal(self) -> str:
        return self._vector([self.chance.uniform(-1, 1) for _ in range(3)])

    # --- statements -----------------------------------------------------------------------------------------------

    def _statement(self, statement: language.Statement) -> str:
        if statement.is_flag:
            return statement.keyword
        arguments = [self._argument(argument, statement.bounds) for argument in statement.arguments]
        return f"{statement.keyword} {', '.join(arguments)}"

    def _argument(self, argument: language.Argument, bounds: language.Bounds | None) -> str:
        wanted = "VECTOR" if argument.shape == "vector" else "NUMBER"
        known = self.variables.get(wanted)
        if known and self.chance.random() < 0.1:
            return self.chance.choice(known)
        bounds = bounds or argument.bounds
        if argument.shape == "vector":
            return self._vector([self._within(bounds) for _ in range(3)])
        number = self._within(bounds)
        return str(int(max(-1e9, min(1e9, number)))) if argument.shape == "integer" else spelled(number)

    def _within(self, bounds: language.Bounds | None) -> float:
        """A number that is allowed, mostly."""
        number = self._any()
        if bounds is None or number in bounds.interval:
            return number
        if bounds.interval.nonzero:
            return 1.0
        low, high = max(bounds.interval.low, -1e3), min(bounds.interval.high, 1e3)
        return self.chance.uniform(low, high)

    def _any(self) -> float:
        chance = self.chance
        if chance.random() < self.extreme:
            return chance.choice(EXTREMES) * chance.choice((1.0, 1.0, chance.uniform(0.1, 1.0)))
        return chance.choice((float(chance.randint(-3, 9)), chance.uniform(-10, 10), chance.uniform(0, 1)))

    def _near(self, middle: float, reach: float) -> float:
        return (
            self._any()
            if self.chance.random() < self.extreme / 5
            else self.chance.uniform(middle - reach, middle + reach)
        )

    def _length(self) -> float:
        return abs(self._any()) or 1.0

    def _color(self) -> str:
        return self._vector([self.chance.random() for _ in range(3)])

    def _vector(self, components: Iterable[float]) -> str:
        return f"< {', '.join(map(spelled, components))} >"


def spelled(number: float) -> str:
    """A number as the language has it."""
    text = repr(float(f"{number:.6g}") if abs(number) < 1e308 else number)
    return text.removesuffix(".0")


def broken(text: str, chance: random.Random) -> str:
    """A scene with a few tokens lost, doubled, swapped or replaced, or cut off."""
    tokens = TOKEN.findall(text)
    for _ in range(chance.randint(1, 4)):
        at = chance.randrange(len(tokens)) if tokens else 0
        match chance.randrange(6):
            case 0:
                del tokens[at : at + chance.randint(1, 3)]
            case 1:
                tokens[at:at] = tokens[at : at + chance.choice((1, 1, 1, 20))] * chance.choice((1, 1, 1, 1, 50))
            case 2:
                tokens[at : at + 2] = tokens[at : at + 2][::-1]
            case 3:
                tokens.insert(at, chance.choice(PIECES))
            case 4:
                tokens[at : at + 1] = [chance.choice(PIECES)]
            case _:
                del tokens[at + 1 :]
    return " ".join(tokens)
