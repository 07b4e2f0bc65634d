"""What a number, a vector or a colour says where it stands, in Markdown."""

from __future__ import annotations

from m3d_language.phrases import allowed
from m3d_language.table import Argument, Statement, Table

from .entry import Slot
from .explain import argument_name
from .markdown import shown
from .summary import number, vector

KELVIN = 273.15

# What only keeps numbers within what can be reckoned with is not worth a word.
LARGEST = 1e20


def facts(entry: Statement | Table, slot: Slot, value: float, *, metres: bool) -> str:
    """What a number in a list of arguments is: its name, unit, other units, and what is allowed."""
    argument = slot.argument
    name = argument_name(argument) if slot.component is None else argument.components[slot.component]
    unit = "metres" if metres and argument.unit == "scene units" else argument.unit
    said = f"`{entry.keyword}` *{name}*: **{number(value)}** {unit}".rstrip()
    other = _other_units(argument, value)
    parts = [f"{said} ({other})" if other else said, argument.says]
    bounds = (entry.bounds if isinstance(entry, Statement) else None) or argument.bounds
    if bounds is not None and bounds.interval.low > -LARGEST:
        parts.append(allowed(bounds))
    return "\n\n".join(parts)


def of_vector(entry: Statement | Table, slot: Slot) -> str:
    """What a vector in a list of arguments is."""
    return f"`{entry.keyword}` *{argument_name(slot.argument)}*\n\n{slot.argument.says}"


def color(value: tuple[float, ...], *, images: bool) -> str:
    """A colour, as it looks."""
    return f"Colour {shown(value, images=images)} `{vector(value)}`"


def _other_units(argument: Argument, value: float) -> str:
    match argument.unit:
        case "degrees":
            return f"{value * 60:.5g} arcminutes" if 0 < abs(value) < 3 else ""
        case "degrees Celsius":
            return f"{value + KELVIN:.6g} K, {value * 1.8 + 32:.4g} °F"
        case _:
            return ""
