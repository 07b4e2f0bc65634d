"""Hover, `textDocument/hover`: what stands under the pointer, and what it comes to in this scene.

- a keyword: what it does, its arguments with units, default and range, an example; for a block also what it resolves
  to, its matrix, place and extents; for a transformation the matrix up to there
- a variable: its type, what it is worth there, what comments say of it, where it is declared and assigned to
- a number: which argument it is, its unit and others; a vector: where the point is in the scene, or the colour
- a row of a table: which vertex, facet or colour range; of a PROFILE what the air does to light
"""

from __future__ import annotations

import numpy as np
from lsprotocol import types
from tree_sitter import Node

from m3d_language.table import LANGUAGE, Statement, Table
from m3dc.meaning import program
from m3dc.meaning.transform import unit
from m3dc.meaning.values import Record, Value, Vector

from .. import arguments, cursor, explain, resolved, rows
from ..colours import KIND, color_variables
from ..comments import about_variable
from ..markdown import escaped, fenced, markup, shown
from ..names import Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..standing import Standing, standing
from ..summary import value_text, vector
from ..tree import ancestors, leaf_at

RULE = "\n\n---\n\n"


@request(types.TEXT_DOCUMENT_HOVER)
def hover(snapshot: Snapshot, params: types.HoverParams) -> types.Hover | None:
    """What is known of the token under the pointer."""
    offset = snapshot.offset(params.position)
    leaf = leaf_at(snapshot.analysis.tree, offset)
    if leaf is None:
        return None
    if leaf.type == "numeric_table":
        text, span = _in_table(snapshot, offset), _numeral(snapshot, leaf, offset)
    elif leaf.type == "identifier":
        text, span = _name(snapshot, leaf), (leaf.start_byte, leaf.end_byte)
    elif leaf.type in LANGUAGE.keywords:
        text, span = _keyword(snapshot, leaf), (leaf.start_byte, leaf.end_byte)
    else:
        text, node = _value(snapshot, leaf)
        span = (node.start_byte, node.end_byte)
    if not text:
        return None
    return types.Hover(markup(text, markdown=snapshot.client.hover_markdown), snapshot.range(span))


# --- keywords -----------------------------------------------------------------------------------------------------


def _keyword(snapshot: Snapshot, leaf: Node) -> str:
    block = cursor.read(snapshot, leaf.start_byte).block
    said = explain.keyword(leaf.type, block.keyword if block else None) or ""
    here = standing(snapshot.analysis, leaf.start_byte)
    known = _resolved(snapshot, leaf.type, here) if here is not None else ""
    return f"{known}{RULE}{said}" if known and said else known or said


def _resolved(snapshot: Snapshot, keyword: str, here: Standing) -> str:
    if here.member is None:
        return resolved.facts(here, keyword)
    inner = here.blocks[-1].entry.keyword if here.blocks else here.whole.block
    if inner == "TRANSFORM":
        return resolved.transformation(here)
    if not isinstance(here.member, program.Statement):
        return ""
    value = here.innermost.values.get(keyword)
    if any(a.kind == KIND for a in here.member.entry.arguments) and isinstance(value, tuple):
        return arguments.color(value, images=snapshot.client.images)
    return ""


# --- variables ----------------------------------------------------------------------------------------------------


def _name(snapshot: Snapshot, leaf: Node) -> str:
    known = names(snapshot.analysis)
    name = snapshot.text.part((leaf.start_byte, leaf.end_byte))
    declaration = known.declaration(name)
    if declaration is None:
        return f"`{name}` is not declared in a VARIABLES block"
    value = known.value(name, leaf.start_byte)
    head = f"{declaration.type} {name}"
    parts = [fenced(head if value is None else f"{head} = {value_text(value)}")]
    at = known.at(leaf.start_byte)
    last = known.last_assignment(name, leaf.start_byte)
    assignment = at if at is not None and at.role is Role.ASSIGNMENT else last
    said = about_variable(snapshot.analysis, name, assignment.span if assignment is not None else None)
    parts += [escaped(text) for text in said]
    color = _color_of(snapshot, name, value)
    if color is not None:
        parts.append(f"Colour {shown(color, images=snapshot.client.images)}")
    if isinstance(value, Record) and value.block == "TRANSFORM":
        parts.append(resolved.of_transform(value.transform))
    assigned = [o for o in known.of(name) if o.role is Role.ASSIGNMENT]
    uses = sum(o.role is Role.USE for o in known.of(name))
    facts = [f"declared in {_line(snapshot, declaration.span[0])}"]
    if assigned:
        places = ", ".join(
            f"**{_line(snapshot, o.span[0])}**" if o == last and len(assigned) > 1 else _line(snapshot, o.span[0])
            for o in assigned[:5]
        )
        facts.append(f"assigned to in {places}" + (", ..." if len(assigned) > 5 else ""))
    else:
        facts.append("not assigned to: it has its default value")
    facts.append("used once" if uses == 1 else f"used {uses} times" if uses else "used nowhere")
    parts.append("\n".join(f"- {fact}" for fact in facts))
    return "\n\n".join(parts)


def _color_of(snapshot: Snapshot, name: str, value: Value | None) -> tuple[float, ...] | None:
    """The colour that a variable stands for, if it is used as one."""
    if isinstance(value, tuple) and name in color_variables(snapshot.analysis):
        return value
    color = value.values.get("COLOR") if isinstance(value, Record) and "COLOR" in value.places else None
    return color if isinstance(color, tuple) else None


def _line(snapshot: Snapshot, offset: int) -> str:
    line = snapshot.text.line_of(offset) + 1
    return f"[line {line}]({snapshot.uri}#L{line})" if snapshot.client.hover_markdown else f"line {line}"


# --- values -------------------------------------------------------------------------------------------------------


def _value(snapshot: Snapshot, leaf: Node) -> tuple[str, Node]:
    """A number or a vector outside of long tables: what is known, and the node that it is known of."""
    around = next((node for node in ancestors(leaf) if node.type == "vector"), None)
    found: list[str] = []
    here = standing(snapshot.analysis, leaf.start_byte)
    place = cursor.read(snapshot, leaf.start_byte)
    if leaf.type == "number" and place.slot is not None and place.entry is not None:
        found.append(_number(snapshot, place.entry, place.slot, leaf))
    if around is not None:
        found.append(_vector(snapshot, around, place.slot, here))
        if leaf.type != "number" and place.slot is not None and place.entry is not None:
            found.insert(0, arguments.of_vector(place.entry, place.slot))
    if here is not None:
        found.append(rows.facts(here, leaf.start_byte, images=snapshot.client.images))
    return "\n\n".join(part for part in found if part), leaf if leaf.type == "number" else around or leaf


def _number(snapshot: Snapshot, entry: Statement | Table, slot: cursor.Slot, leaf: Node) -> str:
    try:
        value = float(snapshot.text.part((leaf.start_byte, leaf.end_byte)))
    except ValueError:
        return ""
    metres = "MIRAGE" in snapshot.analysis.world.scene.nested
    return arguments.facts(entry, slot, value, metres=metres)


def _vector(snapshot: Snapshot, node: Node, slot: cursor.Slot | None, here: Standing | None) -> str:
    value = _vector_value(snapshot, node)
    if value is None:
        return ""
    kind = slot.argument.kind if slot is not None else _kind_of_target(snapshot, node)
    if kind == KIND:
        return arguments.color(value, images=snapshot.client.images)
    if kind == "direction" and any(value):
        return f"As a unit vector: `{vector(unit(np.array(value)))}`"
    return resolved.point(here, value) if kind == "point" and here is not None else ""


def _kind_of_target(snapshot: Snapshot, node: Node) -> str:
    """What a vector that is assigned to a variable is used as."""
    target = node.parent.child_by_field_name("target") if node.parent is not None else None
    name = snapshot.text.part((target.start_byte, target.end_byte)) if target is not None else ""
    return KIND if name in color_variables(snapshot.analysis) else ""


def _vector_value(snapshot: Snapshot, node: Node) -> Vector | None:
    """What a vector in the text is worth; None where a component is not known."""
    known = names(snapshot.analysis)
    components: list[float] = []
    for child in node.children_by_field_name("component"):
        text = snapshot.text.part((child.start_byte, child.end_byte))
        value = known.value(text, child.start_byte) if child.type == "identifier" else _float(text)
        if not isinstance(value, (int, float)):
            return None
        components.append(value)
    return (components[0], components[1], components[2]) if len(components) == 3 else None


def _float(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _in_table(snapshot: Snapshot, offset: int) -> str:
    here = standing(snapshot.analysis, offset)
    if here is None or not isinstance(here.member, program.Table):
        return ""
    return rows.facts(here, offset, images=snapshot.client.images) or explain.table(
        here.member.entry, LANGUAGE.blocks[here.innermost.block]
    )


def _numeral(snapshot: Snapshot, leaf: Node, offset: int) -> tuple[int, int]:
    """The numeral of a long table that a byte belongs to."""
    data = snapshot.text.data
    start = end = offset
    while start > leaf.start_byte and data[start - 1] not in b" \t\r\n<>,":
        start -= 1
    while end < leaf.end_byte and data[end] not in b" \t\r\n<>,":
        end += 1
    return start, end
