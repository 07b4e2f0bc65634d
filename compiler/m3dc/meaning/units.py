"""Numbers that look like another unit than the language's: angles in radians, temperatures in kelvin, colours from 0 to
255."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ..diagnostics import Findings, catalogue
from ..syntax import ast
from ..text.span import Base, Local
from . import program
from .values import TableValue, spelled

# Common parts of a turn, in radians.
_PARTS = tuple(sorted({n * math.pi / d for d in (6, 4) for n in range(1, 2 * d + 1)}))
# Statements whose small angles mean what they say: a telescope's field of view has a degree or two.
_SMALL = {"FOV"}
_TURNS = {"ROTATE", "ROTX", "ROTY", "ROTZ"}
_LEAST_TURN = 0.1  # of those that are small all over: less is a tilt in any unit

_HOTTEST = 150.0  # degrees Celsius, beyond any air that light is seen through


class Angle(NamedTuple):
    """An angle in a statement, as a number."""

    keyword: str
    value: float
    span: Local


def angles(members: Iterable[program.Member]) -> Iterator[Angle]:
    """The angles that are written in a body as numbers, at any depth."""
    for member in members:
        match member:
            case program.Block():
                yield from angles(member.body)
            case program.Statement():
                for argument, expected in zip(member.arguments, member.entry.arguments, strict=True):
                    if expected.unit == "degrees" and member.entry.keyword not in _SMALL:
                        components = argument.components if isinstance(argument, ast.Vector) else (argument,)
                        for number in components:
                            if isinstance(number, ast.Number) and number.value:
                                yield Angle(member.entry.keyword, number.value, number.span)
            case program.Table():
                pass


def report_radians(items: Iterable[tuple[Base, tuple[Angle, ...]]], findings: Findings) -> None:
    """Report the angles of a scene, given by item with its base, that look like radians: a common part of a turn as one
    rounds it; or any rotation of a scene in which none is greater than a full turn in radians, unless all are whole
    numbers: a tilt of 5 degrees is common, one of 5 radians is not."""
    known = [(base, angle) for base, found in items for angle in found]
    turns = [abs(angle.value) for _, angle in known if angle.keyword in _TURNS]
    all_small = max(turns, default=0.0) <= 2 * math.pi and not all(turn.is_integer() for turn in turns)
    for base, angle in known:
        value = abs(angle.value)
        if (all_small and value >= _LEAST_TURN and angle.keyword in _TURNS) or _is_part(value):
            degrees = round(math.degrees(angle.value), 1)
            detail = f"{spelled(angle.value)} is in degrees; as radians it would be {degrees:g} degrees"
            findings.add_at(catalogue.ANGLE_IN_RADIANS, angle.span.at(base), detail)


def _is_part(value: float) -> bool:
    """Whether a number is a common part of a turn in radians, as one writes it with three digits or more."""
    text = repr(value)
    decimals = len(text.partition(".")[2]) if "e" not in text else 0
    if len(text.strip("0.").replace(".", "")) < 3 or decimals < 2:
        return False
    return any(abs(value - part) <= 0.5 * 10.0**-decimals * 1.01 for part in _PARTS)


def report_kelvin(profile: TableValue, findings: Findings) -> None:
    """Report it if a PROFILE is too hot for degrees Celsius."""
    temperatures = profile.rows[:, 1]
    coolest, hottest = float(temperatures.min()), float(temperatures.max())
    if coolest > _HOTTEST:
        detail = (
            f"{coolest:g} to {hottest:g} are taken as degrees Celsius; kelvin less 273.15 would be "
            f"{coolest - 273.15:.6g} to {hottest - 273.15:.6g}"
        )
        findings.add_at(catalogue.PROFILE_IN_KELVIN, profile.place(0), detail)


def looks_like_bytes(components: Iterable[float]) -> bool:
    """Whether a colour seems to go from 0 to 255: whole numbers, one of which no colour from 0 to 1 comes near."""
    numbers = tuple(components)
    return max(numbers) > 10 and all(number == int(number) and 0 <= number <= 255 for number in numbers)
