"""Runs the checked program: statements in file order, by value, to the records that make up the scene.

An assignment copies. A block changes what is there (`KEY { ... }`), or replaces it by a copy of a variable and then
changes that (`KEY name { ... }`); primitives, textures, waves and colour ranges are added. Most statements only store
their value; those that do more have an entry in `MEANING`, and what must hold of a whole block one in `finish.py`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from functools import partial
from typing import NamedTuple, TypeVar

import numpy as np

from m3d_language import table as language
from m3d_language.table import LANGUAGE, Default

from ..diagnostics import Findings, Fix, ItemFindings, catalogue
from ..diagnostics.catalogue import Entry
from ..syntax import ast
from ..text.span import WHOLE, Local, Placed
from . import program
from .effects import idle
from .finish import FINISH
from .memo import Ledger, Steps
from .reach import check_reach
from .size import Size
from .transform import IDENTITY, STEPS, Transform, cosine_and_sine
from .units import looks_like_bytes
from .values import Parts, Record, TableValue, Value, Vector, spelled

T = TypeVar("T")

INTEGER_LIMIT = 2**31 - 1

# What is reported of a value out of range that is not an error.
_SUBSTITUTED = {"default": catalogue.SET_TO_DEFAULT, "limit": catalogue.SET_TO_LIMIT, "warn": catalogue.UNUSUAL_NUMBER}


TURN = 360.0  # degrees


class Made(NamedTuple):
    """What one item adds to a scene: the value that it gives a variable, or records."""

    value: Value | None
    scene: Record | None
    solids: tuple[Record, ...]
    lights: tuple[Record, ...]


class World(NamedTuple):
    """All that a scene adds up to. The lights are in the order they were made, the sky's sun among them; `made` is what
    each item of the program added, in file order. A scene that is too large has no solids and no lights."""

    scene: Record
    solids: tuple[Record, ...]
    lights: tuple[Record, ...]
    made: tuple[Made, ...]


_NOTHING = Made(None, None, (), ())


def value_at_first(type_: str, span: Placed) -> Value:
    """What a variable declared at `span` holds until it is assigned to."""
    if type_ == "NUMBER":
        return 0.0
    if type_ == "VECTOR":
        return (0.0, 0.0, 0.0)
    return Record(type_, span)


class Evaluator:
    """Holds the variables while the items of one scene are run in order. They may be given what they are at first."""

    def __init__(self, findings: Findings, variables: Mapping[str, Value] | None = None) -> None:
        self._all = findings
        self._findings = ItemFindings(findings, WHOLE)  # of the item being run
        self._variables: Ledger[Value] = Ledger()
        self._variables.update(variables or {})
        self._lights: list[Record] = []  # of the item being run
        self._memory: Steps | None = None

    @np.errstate(all="ignore")  # what is not finite is looked for where a matrix is made, and where things are placed
    def run(self, items: Iterable[program.Item], unfinished: frozenset[int], steps: Steps | None = None) -> World:
        """The scene that the items describe, as far as it goes; what is wrong with their values goes to findings.

        Of the items that start at an `unfinished` byte, which may not be whole, nothing is reported. With the `steps`
        of a run before, an item is run only if it or a variable that it uses has changed, and so is what is in it.
        """
        self._memory = steps
        made: list[Made] = []
        size = Size()
        for item in items:
            content = item.content
            if size.excess is not None and isinstance(content, program.Block) and content.entry.keyword != "SCENE":
                made.append(_NOTHING)  # there is no memory for more
                continue
            before = len(self._all.found)
            step = self._once(item.base, content, partial(self._item, item))
            made.append(step)
            if item.start in unfinished:
                del self._all.found[before:]
            if size.excess is not None:
                continue
            for thing in (*step.solids, *step.lights):
                size = size.plus(thing)
            if size.excess is not None:
                assert isinstance(content, program.Block)
                what, detail = size.excess
                self._all.add_at(catalogue.TOO_MANY, content.span.at(item.base), detail, fill=what)
                made[-1] = _NOTHING
        scene = next((step.scene for step in made if step.scene is not None), None)
        fitting = made if size.excess is None else []
        return World(
            scene or Record("SCENE", Placed(0, 0)),
            tuple(solid for step in fitting for solid in step.solids),
            tuple(light for step in fitting for light in step.lights),
            tuple(made),
        )

    @np.errstate(all="ignore")
    def transform(self, holder: program.Block | program.Assignment) -> Transform | None:
        """The matrix of the record that a block or an assignment makes. None where it can not be undone."""
        record = self._record(holder) if isinstance(holder, program.Block) else self._assign(holder)
        return record.transform if isinstance(record, Record) and "TRANSFORM" not in record.broken else None

    def _once(self, key: Hashable, of: object, work: Callable[[], T]) -> T:
        """The outcome of `work`, not done again where nothing has changed since the run before (`Steps.do`)."""
        if self._memory is None:
            return work()
        return self._memory.do(key, of, work, self._all, self._variables)

    def _item(self, item: program.Item) -> Made:
        self._findings = ItemFindings(self._all, item.base)
        self._lights = []
        match item.content:
            case program.Assignment() as content:
                return Made(self._assign(content), None, (), ())
            case program.Block() as content:
                record = self._whole(content)
                check_reach(record, self._all)
                scene = record if record.block == "SCENE" else None
                solids = (record,) if record.block == "SOLID" else ()
                lights = (record,) if record.block == "LIGHT" else tuple(self._lights)
                return Made(None, scene, solids, lights)
            case declarations:
                for declaration in declarations:
                    span = self._findings.place(declaration.name.span)
                    self._variables[declaration.name.text] = value_at_first(declaration.type, span)
                return Made(None, None, (), ())

    def _assign(self, item: program.Assignment) -> Value:
        name = item.target.text
        value = self._variables[name]
        if isinstance(item.value, ast.Name):
            value = self._variables[item.value.text]
        elif isinstance(item.value, ast.Number):
            value = item.value.value
        elif isinstance(item.value, ast.Vector):
            value = self._components(item.value)
        if isinstance(value, Record):
            value = value.copy(self._findings.place(item.span))
            if item.body is not None:
                value.broken |= item.broken
                self._body(value, item.body)
                FINISH[value.block](value, self._all, whole=False)
        self._variables[name] = value
        return value

    def _whole(self, block: program.Block) -> Record:
        """A new record, up to its closing brace."""
        record = self._record(block)
        FINISH[record.block](record, self._all, whole=True)
        return record

    def _record(self, block: program.Block) -> Record:
        """A new record: of default values, or a copy of a variable; then changed by the body."""
        span = self._findings.place(block.span)
        source = None if block.source is None else self._variables[block.source.text]
        record = source.copy(span) if isinstance(source, Record) else Record(block.entry.keyword, span)
        record.broken |= block.broken
        self._body(record, block.body)
        return record

    def _body(self, record: Record, members: tuple[program.Member, ...]) -> None:
        if record.block == "TRANSFORM":
            self._transform(record, self._steps(record.transform, members))
            return
        added: list[Record] = []  # put to the others at once: a block may have very many
        for member in members:
            match member:
                case program.Statement():
                    self._statement(record, member)
                case program.Table():
                    self._table(record, member)
                case program.Block() if member.entry.adds:
                    added.append(self._once(member.span, member, partial(self._whole, member)))
                case program.Block():
                    self._nested(record, member)
        if added:
            record.parts = Parts(record.parts, tuple(added)) if record.parts else tuple(added)
        record.idle = idle(record, members)

    def _nested(self, record: Record, block: program.Block) -> None:
        keyword = block.entry.keyword
        if keyword == "TRANSFORM" and keyword in record.broken:
            return  # there is no matrix to go on from
        if keyword == "TRANSFORM":
            start = record.transform
            if block.source is not None:
                source = self._variables[block.source.text]
                assert isinstance(source, Record)
                if start is not IDENTITY:
                    detail = f"{block.source.text} replaces the matrix; a block in braces would build on it"
                    self._findings.add(catalogue.TRANSFORM_DISCARDS, block.source.span, detail)
                start = source.transform
                record.broken |= source.broken & {"TRANSFORM"}
            steps = partial(self._steps, start, block.body)
            self._transform(record, self._once(block.span, block, steps) if start is IDENTITY else steps())
        else:
            nested = record.nested.get(keyword)
            if nested is None or block.source is not None:
                # A copy, because a later block of the same kind changes it.
                made = self._once(block.span, block, partial(self._whole, block))
                nested = record.nested[keyword] = made.copy(made.span)
            else:
                nested.broken |= block.broken
                self._body(nested, block.body)
                FINISH[keyword](nested, self._all, whole=True)
            if keyword == "SKY":
                self._lights.append(nested.member("SUN"))

    @staticmethod
    def _transform(record: Record, made: Transform | None) -> None:
        """Give a record its matrix, or note that it has none that can be used."""
        if made is None:
            record.broken |= {"TRANSFORM"}
        else:
            record.transform = made

    def _steps(self, start: Transform, members: tuple[program.Member, ...]) -> Transform | None:
        """What a TRANSFORM block makes of the matrix before it: M = Mc M1 M2 ... (thesis 7.5.5.2). None where that can
        not be undone."""
        depth = 0
        transform: Transform | None = start
        for member in members:
            assert isinstance(member, program.Statement)
            if member.entry.keyword == "IDENTITY":
                if depth:
                    fix = Fix("Remove what stands before it", Local(members[0].span.start, member.span.start), "")
                    detail = "put it first, or leave out what stands before it"
                    self._findings.add(catalogue.IDENTITY_DISCARDS, member.span, detail, fix=fix)
                transform, depth = IDENTITY, 0
                continue
            depth += 1
            if depth > LANGUAGE.limits["transforms"]:
                most = LANGUAGE.limits["transforms"]
                detail = f"at most {most} transformations a block; put the rest into another TRANSFORM block"
                self._findings.add(catalogue.TOO_MANY_TRANSFORMATIONS, member.span, detail)
                break
            values = self._values(member)
            if values is None:
                continue
            numbers = [n for value in values for n in (value if isinstance(value, tuple) else (value,))]
            if transform is None:
                continue
            transform = transform.then(STEPS[member.entry.keyword](*numbers))
            if not transform.is_finite:
                self._findings.add(catalogue.NO_INVERSE, member.span, "its numbers are too large or too small")
                transform = None
        return transform

    # --- statements ---------------------------------------------------------------------------------------------

    def _statement(self, record: Record, item: program.Statement) -> None:
        entry = item.entry
        values = self._values(item)
        if values is None:
            return
        place = self._findings.place(item.span)
        record.places[entry.keyword] = place
        meaning = MEANING.get((record.block, entry.keyword))
        if entry.is_flag:
            value: Default = True
        elif len(values) == 1:
            value = values[0]
        else:
            value = tuple(float(v) for v in values if not isinstance(v, tuple))
        if meaning is None:
            record.values[entry.keyword] = value
        else:
            meaning(record, entry.keyword, value)

    def _values(self, item: program.Statement) -> list[float | Vector] | None:
        """The arguments' values, in range; None where one is not and has no substitute."""
        values: list[float | Vector] = []
        for number, (argument, expected) in enumerate(zip(item.arguments, item.entry.arguments, strict=True)):
            value = self._in_range(argument, expected, item.entry, number)
            if value is None:
                return None
            values.append(value)
        return values

    def _in_range(
        self, argument: ast.Argument, expected: language.Argument, entry: language.Statement, number: int
    ) -> float | Vector | None:
        value = self._value(argument)
        if expected.shape == "integer":
            assert isinstance(value, (int, float))
            if abs(value) > INTEGER_LIMIT:
                self._findings.add(catalogue.NUMBER_TOO_LARGE, argument.span, "a whole number is at most 2147483647")
                return None
            value = float(math.trunc(value))
        bounds = entry.bounds or expected.bounds
        if bounds is None:
            return value
        parts = value if isinstance(value, tuple) else (value,)
        if all(part in bounds.interval for part in parts):
            return value
        shown = ", ".join(f"{part:g}" for part in parts)
        if bounds.policy == "error":
            self._findings.add(
                catalogue.OUT_OF_RANGE,
                argument.span,
                f"{entry.keyword} is {shown}, expected {bounds.interval}",
                fill=bounds.message,
                fix=_turned(argument, value, bounds.interval) if expected.unit == "degrees" else None,
            )
            return None
        fix, found = None, _SUBSTITUTED[bounds.policy]
        if bounds.policy == "default":
            default = entry.default
            substitute = default[number] if isinstance(default, tuple) and len(default) > 1 else default
            assert isinstance(substitute, (int, float))
            if value == substitute:
                return value  # the default may be a value of its own, that of none, and can be written
            value = substitute
            detail = f"{entry.keyword} {shown} is replaced by the default, {value:g}"
            fix = _written(argument, float(value))
        elif bounds.policy == "limit":
            clamped = tuple(bounds.interval.nearest(part) for part in parts)
            value = (clamped[0], clamped[1], clamped[2]) if isinstance(value, tuple) else clamped[0]
            detail = f"{entry.keyword} {shown} is replaced by {', '.join(f'{part:g}' for part in clamped)}"
            fix = _written(argument, value)
            if expected.kind == "color" and looks_like_bytes(parts):
                found, (detail, fraction) = catalogue.COLOR_OF_BYTES, _of_bytes(shown, parts)
                fix = _written(argument, fraction)
        else:
            detail = f"{entry.keyword} is {shown}"
        self._findings.add(found, argument.span, detail, fill=bounds.message, fix=fix)
        return value

    def _value(self, argument: ast.Argument) -> float | Vector:
        match argument:
            case ast.Number():
                return argument.value
            case ast.Vector():
                return self._components(argument)
            case ast.Name():
                value = self._variables[argument.text]
                assert not isinstance(value, Record)
                return value

    def _components(self, vector: ast.Vector) -> Vector:
        x, y, z = (self._value(component) for component in vector.components)
        assert not isinstance(x, tuple)
        assert not isinstance(y, tuple)
        assert not isinstance(z, tuple)
        return float(x), float(y), float(z)

    # --- tables -------------------------------------------------------------------------------------------------

    def _table(self, record: Record, item: program.Table) -> None:
        keyword = item.entry.keyword
        clash = next((k for k in _EXCLUDES.get(keyword, ()) if k in record.tables), None)
        if clash is not None:
            name = "FACETS" if keyword == "SFACETS" else keyword
            self._findings.add(catalogue.TABLE_ALREADY_DEFINED, item.keyword.span, f"by {clash}, earlier", fill=name)
            return
        value = None
        if not item.broken:
            value = self._bulk(item, item.bulk) if item.bulk is not None else self._written_out(item)
        if value is not None:
            value = self._in_bounds(value, item)
        if value is None:
            record.broken |= {keyword}
            return
        if keyword == "COLORS" and "COLORS" in record.tables:
            before = record.tables["COLORS"]
            rows = np.vstack([before.rows, value.rows])
            earlier = before.offsets.astype(np.int64) + (before.span.start - value.span.start)
            value = TableValue((), rows, np.concatenate([earlier, value.offsets]), value.span)
        record.tables[keyword] = value
        record.mesh = None

    def _bulk(self, item: program.Table, data: program.TableData) -> TableValue | None:
        rows = np.asarray(data.rows).reshape(-1, data.width)
        offsets = np.asarray(data.offsets) - np.uint32(item.origin + item.span.start)
        head = self._head(data.head, [item.span] * len(data.head))
        if head is None:
            return None
        return TableValue(head, rows, offsets, self._findings.place(item.span))

    def _written_out(self, item: program.Table) -> TableValue | None:
        """A table with variables in it."""
        head = self._head([self._value(argument) for argument in item.head], [argument.span for argument in item.head])
        if head is None:
            return None
        rows = [
            [n for value in map(self._value, row) for n in (value if isinstance(value, tuple) else (value,))]
            for row in item.rows
        ]
        width = sum(3 if a.shape == "vector" else 1 for a in item.entry.row)
        offsets = np.array([row[0].span.start - item.span.start for row in item.rows], np.uint32)
        return TableValue(head, np.array(rows, float).reshape(-1, width), offsets, self._findings.place(item.span))

    def _head(self, values: Sequence[float | Vector], spans: list[Local]) -> tuple[int, ...] | None:
        head: list[int] = []
        for value, span in zip(values, spans, strict=True):
            assert not isinstance(value, tuple)
            if abs(value) > INTEGER_LIMIT:
                self._findings.add(catalogue.NUMBER_TOO_LARGE, span, "a whole number is at most 2147483647")
                return None
            head.append(math.trunc(value))
        return tuple(head)

    def _in_bounds(self, value: TableValue, item: program.Table) -> TableValue | None:
        """The table with every number within the bounds of its kind: set to a limit that has one, None where not."""
        start = 0
        for argument in item.entry.row:
            columns = slice(start, start + (3 if argument.shape == "vector" else 1))
            start = columns.stop
            part = value.rows[:, columns]
            if not len(part):
                continue
            least, most = float(part.min()), float(part.max())
            if not (math.isfinite(least) and math.isfinite(most)):
                row = int(np.flatnonzero(~np.isfinite(part).all(axis=1))[0])
                self._row_error(catalogue.NUMBER_TOO_LARGE, value, row, "the largest number is about 1.8e308")
                return None
            bounds = argument.bounds
            if bounds is None or (least in bounds.interval and most in bounds.interval):
                continue
            low, high = bounds.interval.low, bounds.interval.high
            below = part <= low if bounds.interval.low_open else part < low
            above = part >= high if bounds.interval.high_open else part > high
            outside = np.flatnonzero((below | above).any(axis=1))
            shown = ", ".join(f"{n:g}" for n in part[outside[0]])
            if bounds.policy == "error":
                self._row_error(catalogue.OUT_OF_RANGE, value, int(outside[0]), f"found {shown}", fill=bounds.message)
                return None
            found, detail = catalogue.SET_TO_LIMIT, f"{shown} is set to the nearest limit"
            if argument.kind == "color" and looks_like_bytes(part[outside[0]].tolist()):
                found, (detail, _) = catalogue.COLOR_OF_BYTES, _of_bytes(shown, part[outside[0]].tolist())
            self._row_error(found, value, int(outside[0]), detail, fill=bounds.message)
            rows = value.rows.copy()
            rows[:, columns] = part.clip(low, high)
            value = value._replace(rows=rows)
        return value

    def _row_error(self, entry: Entry, value: TableValue, row: int, detail: str, *, fill: str = "") -> None:
        self._all.add_at(entry, value.place(row), detail, fill=fill)


def _turned(argument: ast.Argument, value: float | Vector, interval: language.Interval) -> Fix[Local] | None:
    """The fix that writes an angle as the one that whole turns away is in range, where the range is a whole turn: 270
    degrees are -90. There is no other such angle, so that it is certain."""
    if isinstance(value, tuple) or interval.high - interval.low != TURN or not math.isfinite(value):
        return None
    turned = interval.low + (value - interval.low) % TURN
    fix = _written(argument, float(f"{turned:.12g}"))
    return None if fix is None else fix._replace(certain=True)


def _of_bytes(shown: str, components: Sequence[float]) -> tuple[str, Vector]:
    """What to say of a colour that seems to go from 0 to 255, and what it would be from 0 to 1."""
    red, green, blue = (round(component / 255, 3) for component in components)
    detail = (
        f"{shown} is set to the nearest limit; if it is out of 255, divided by that it is {red:g}, {green:g}, {blue:g}"
    )
    return detail, (red, green, blue)


def _written(argument: ast.Argument, value: float | Vector) -> Fix[Local] | None:
    """The fix that writes what takes the place of a number or vector; None of one that is, or has, a variable."""
    match argument:
        case ast.Number() if isinstance(value, float):
            text = spelled(value)
        case ast.Vector() if isinstance(value, tuple) and all(isinstance(c, ast.Number) for c in argument.components):
            text = f"< {', '.join(map(spelled, value))} >"
        case _:
            return None
    return Fix(f"Write {text}", argument.span, text)


# The tables that may not stand beside another, or itself, in one POLYGONS or TERRAIN (thesis 7.5.5.3).
_EXCLUDES = {
    "VERTICES": ("VERTICES",),
    "FACETS": ("FACETS", "SFACETS"),
    "SFACETS": ("FACETS", "SFACETS"),
}


# --- statements that do more than to store their value ------------------------------------------------------------

Meaning = Callable[[Record, str, Default], None]


def _off(flag: str) -> Meaning:
    """A statement that takes back another flag."""

    def meaning(record: Record, _keyword: str, _value: Default) -> None:
        record.values[flag] = False

    return meaning


def _between_points(record: Record, keyword: str, value: Default) -> None:
    """FROM and TO of a light set its direction anew each time (thesis 7.5.5.4)."""
    record.values[keyword] = value
    (fx, fy, fz), (tx, ty, tz) = record.vector("FROM"), record.vector("TO")
    record.values["DIRECTION"] = (tx - fx, ty - fy, tz - fz)
    record.places["DIRECTION"] = record.places[keyword]


def _on_the_sky(record: Record, keyword: str, value: Default) -> None:
    """ZENITH and AZIMUTH of a light set its direction: from where it stands to the origin (thesis 7.5.5.4)."""
    record.values[keyword] = value
    cos_zenith, sin_zenith = cosine_and_sine(record.number("ZENITH"))
    cos_azimuth, sin_azimuth = cosine_and_sine(record.number("AZIMUTH"))
    record.values["DIRECTION"] = (-sin_zenith * cos_azimuth, -sin_zenith * sin_azimuth, -cos_zenith)
    record.places["DIRECTION"] = record.places[keyword]


MEANING: dict[tuple[str, str], Meaning] = {
    ("POLYGONS", "NOPHONG"): _off("PHONG"),
    ("SOURCE", "POINT"): _off("INFINITE"),
    **{(block, keyword): _between_points for block in ("SOURCE", "SUN") for keyword in ("FROM", "TO")},
    **{(block, keyword): _on_the_sky for block in ("SOURCE", "SUN") for keyword in ("ZENITH", "AZIMUTH")},
}
