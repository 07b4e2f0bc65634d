"""Every diagnostic the compiler can give: its code, severity and headline.

The headline is the 1993 program's wording where it had one (thesis, Appendix B). `{}` is filled in by the place that
reports it; a headline that is nothing but `{}` comes with the statement, from the language table.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

Severity = Literal["error", "warning"]


class Entry(NamedTuple):
    severity: Severity
    headline: str


def _error(headline: str) -> Entry:
    return Entry("error", headline)


def _warning(headline: str) -> Entry:
    return Entry("warning", headline)


CATALOGUE: dict[str, Entry] = {
    # What the text is made of
    "M3D0101": _error("Expecting a '{}'"),
    "M3D0102": _error("Expecting a vector constant or variable"),
    "M3D0103": _error("Expecting a numeric constant or variable"),
    "M3D0104": _error("Expecting a digit"),
    "M3D0105": _error("Unbalanced Comment"),
    "M3D0106": _error("Invalid {} statement"),
    "M3D0107": _error("Invalid statement"),
    "M3D0108": _error("Invalid identifier"),
    "M3D0109": _error("Invalid type specification"),
    "M3D0110": _error("Identifier name too long"),
    "M3D0111": _error("Blocks nested too deeply"),
    "M3D0112": _error("Empty data file"),
    "M3D0113": _error("Not a text file"),
    "M3D0114": _error("Number too large"),
    # Names
    "M3D0201": _error("Variable already defined"),
    "M3D0202": _error("Undefined identifier"),
    "M3D0203": _error("Incompatible types"),
    "M3D0204": _error("Can not assign a variable to itself"),
    # What may stand only once, and what must stand
    "M3D0301": _error("{}"),
    "M3D0302": _error("No PROFILE specified"),
    "M3D0303": _error("{} already defined"),
    "M3D0304": _error("No {} defined"),
    "M3D0305": _error("Vertex not defined"),
    "M3D0306": _error("Adding Solid object with no primitives"),
    "M3D0307": _error("Transform stack overflow"),
    # Values
    "M3D0401": _error("{}"),
    "M3D0402": _warning("{}"),
    "M3D0403": _error("Invalid vertices"),
    "M3D0404": _error("Invalid Normal"),
    "M3D0405": _error("Number of {} greater than specified"),
    "M3D0406": _error("Number of {} less than specified"),
    "M3D0407": _error("Argument must be > 2"),
    "M3D0408": _error("Argument too small"),
    "M3D0409": _error("Overlapping terrain cells"),
    "M3D0410": _error("Need at least 3 PROFILE points"),
    "M3D0411": _error("PROFILE elevations must be increasing"),
    "M3D0412": _error("Too many {}"),
    "M3D0413": _error("Second index must be greater than first"),
    "M3D0414": _error("Sun must be above the horizon"),
    "M3D0415": _error("Distance between FROM and TO is too small"),
    "M3D0416": _warning("REGION bottom must be >= top"),
    "M3D0417": _warning("REGION right must be >= left"),
    "M3D0418": _error("Observer position below all temperature layers"),
    "M3D0419": _error("Observer position above all temperature layers"),
    "M3D0420": _error("Direction must not be zero"),
    "M3D0421": _error("Transform can not be inverted"),
}
