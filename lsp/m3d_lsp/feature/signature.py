"""Signature help, `textDocument/signatureHelp`: the arguments of the statement or the row that is being typed, and
which of them is next.

So nobody need remember that REGION is top, left, bottom, right, or what the eight numbers of a COLORS row are.
"""

from __future__ import annotations

from typing import NamedTuple

from lsprotocol import types

from m3d_language.phrases import allowed
from m3d_language.table import LANGUAGE, Argument, Bounds, Statement, Table
from m3dc.analysis import Analysis

from .. import cursor
from ..cursor import Cursor
from ..explain import argument_name
from ..markdown import markup
from ..names import names
from ..registry import request
from ..snapshot import Snapshot

# What goes on with a list of arguments.
_MORE = {"NUMERAL", "LANGLE", "RANGLE", "COMMA"}


class _Parameter(NamedTuple):
    """A number of a list of arguments, and where its name stands in the label."""

    argument: Argument
    start: int
    end: int


@request(
    types.TEXT_DOCUMENT_SIGNATURE_HELP,
    types.SignatureHelpOptions(trigger_characters=[" ", "<", ",", "{"], retrigger_characters=[">"]),
)
def signature(snapshot: Snapshot, params: types.SignatureHelpParams) -> types.SignatureHelp | None:
    """The arguments of what is being typed at the cursor."""
    place = cursor.read(snapshot, snapshot.offset(params.position))
    if not place.prefix.expected & _MORE:
        return None
    if place.slot is not None and place.entry is not None:
        if isinstance(place.entry, Statement):
            (label, parameters), bounds = _statement(place.entry), place.entry.bounds
        else:
            (label, parameters), bounds = _table(place.entry), None
        return _help(snapshot, label, place.entry.says, parameters, place.slot.number, bounds)
    component = _component_of_assigned(snapshot.analysis, place)
    if component is None:
        return None
    label, parameters = _label(f"{place.prefix.member[0].text} =", (LANGUAGE.kinds["point"],), ", ", "")
    return _help(snapshot, label, LANGUAGE.basics["VECTOR"].says, parameters, component, None)


def _component_of_assigned(analysis: Analysis, place: Cursor) -> int | None:
    """Which component of a vector is next that is assigned to a variable; None where no vector is."""
    member = place.prefix.member
    if len(member) < 2 or member[1].terminal != "EQUAL" or place.prefix.opened:
        return None
    if names(analysis).type(member[0].text) != "VECTOR":
        return None
    return min(sum(token.terminal == "COMMA" for token in member), 2)


def _statement(entry: Statement) -> tuple[str, list[_Parameter]]:
    return _label(entry.keyword, entry.arguments, ", ", "")


def _table(entry: Table) -> tuple[str, list[_Parameter]]:
    """`FACETS { facets  first second third  ... }`"""
    label, parameters = _label(f"{entry.keyword} {{", entry.head, " ", "")
    if entry.head:
        label += " "
    return _label(label, entry.row, " ", "  ... }", parameters)


def _label(
    before: str, arguments: tuple[Argument, ...], between: str, after: str, known: list[_Parameter] | None = None
) -> tuple[str, list[_Parameter]]:
    """A label that goes on with arguments, and where in it each number is named."""
    label, parameters = before, [*(known or [])]
    for number, argument in enumerate(arguments):
        label += between if number else " "
        if not argument.components:
            name = argument_name(argument)
            parameters.append(_Parameter(argument, len(label), len(label) + len(name)))
            label += name
            continue
        label += "<"
        for component, name in enumerate(argument.components):
            label += ", " if component else " "
            parameters.append(_Parameter(argument, len(label), len(label) + len(name)))
            label += name
        label += " >"
    return label + after, parameters


def _help(
    snapshot: Snapshot, label: str, says: str, parameters: list[_Parameter], active: int, bounds: Bounds | None
) -> types.SignatureHelp:
    client = snapshot.client
    information = types.SignatureInformation(
        label,
        documentation=markup(says, markdown=client.signature_markdown),
        parameters=[
            types.ParameterInformation(
                (parameter.start, parameter.end) if client.label_offsets else label[parameter.start : parameter.end],
                documentation=markup(
                    " ".join([parameter.argument.says, *([f"{allowed(bounds)}."] if bounds else [])]),
                    markdown=client.signature_markdown,
                ),
            )
            for parameter in parameters
        ],
        active_parameter=active,
    )
    return types.SignatureHelp([information], active_signature=0, active_parameter=active)
