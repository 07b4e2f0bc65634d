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

from m3d_language.table import LANGUAGE
from m3dc.analysis import Enclosing
from m3dc.meaning import program
from m3dc.meaning.transform import unit
from m3dc.meaning.values import Record, Value
from m3dc.syntax import ast, numerals

from .. import arguments, cursor, explain, resolved, rows
from ..colours import KIND, color_variables
from ..comments import about_variable
from ..entry import Slot, entry_of
from ..markdown import escaped, fenced, markup, shown
from ..names import Role, names
from ..registry import request
from ..snapshot import Snapshot
from ..summary import value_text, vector
from ..text import Span
from ..tree import leaf_at

RULE = "\n\n---\n\n"


@request(types.TEXT_DOCUMENT_HOVER)
def hover(snapshot: Snapshot, params: types.HoverParams) -> types.Hover | None:
    """What is known of the token under the pointer."""
    offset = snapshot.offset(params.position)
    leaf = leaf_at(snapshot.analysis.tree, offset)
    if leaf is None:
        return None
    span = leaf.start_byte, leaf.end_byte
    at = ast.locate(snapshot.analysis.items, span)
    if leaf.type == "numeric_table":
        text, span = _in_table(snapshot, at, offset), numerals.around(snapshot.text.data, offset, span)
    elif leaf.type == "identifier":
        text = _name(snapshot, leaf)
    elif leaf.type in LANGUAGE.keywords:
        text = _keyword(snapshot, leaf, at)
    elif at is not None:
        text, span = _value(snapshot, at, span)
    else:
        return None
    if not text:
        return None
    return types.Hover(markup(text, markdown=snapshot.client.hover_markdown), snapshot.range(span))


# --- keywords -----------------------------------------------------------------------------------------------------


def _keyword(snapshot: Snapshot, leaf: Node, at: ast.Located | None) -> str:
    if at is not None and isinstance(at.node, ast.Keyword):
        block, here = entry_of(at, snapshot.analysis).block, snapshot.analysis.enclosing(at)
    else:
        block, here = cursor.read(snapshot, leaf.start_byte).block, None
    said = explain.keyword(leaf.type, block.keyword if block else None) or ""
    known = "" if at is None or here is None else _resolved(snapshot, at, here)
    return f"{known}{RULE}{said}" if known and said else known or said


def _resolved(snapshot: Snapshot, at: ast.Located, here: Enclosing) -> str:
    """What a keyword of the tree comes to."""
    if here.path.member is None:
        assert isinstance(at.node, ast.Keyword)
        return resolved.facts(snapshot.analysis, here, at.node.text)
    if here.path.in_transform:
        return resolved.transformation(here)
    statement = here.path.member
    if at.parent is None or not isinstance(statement, program.Statement):
        return ""
    for expected, argument in zip(statement.entry.arguments, statement.arguments, strict=True):
        if expected.kind == KIND:
            # What it says, where a later statement has replaced it.
            held = snapshot.analysis.statement_value(at.parent)
            value = held or snapshot.analysis.value(argument, at.span[0])
            return arguments.color(value, images=snapshot.client.images) if isinstance(value, tuple) else ""
    return ""


# --- variables ----------------------------------------------------------------------------------------------------


def _name(snapshot: Snapshot, leaf: Node) -> str:
    known = names(snapshot.analysis)
    name = snapshot.text.part((leaf.start_byte, leaf.end_byte))
    declaration = known.declaration(name)
    if declaration is None:
        return f"`{name}` is not declared in a VARIABLES block"
    value = snapshot.analysis.variable(name, leaf.start_byte)
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


def _value(snapshot: Snapshot, at: ast.Located, leaf: Span) -> tuple[str, Span]:
    """A number or a vector outside of long tables: what is known, and the part of the text that it is known of."""
    vector = at if isinstance(at.node, ast.Vector) else at.parent
    if vector is not None and not isinstance(vector.node, ast.Vector):
        vector = None
    here = snapshot.analysis.enclosing(at)
    entry = entry_of(at, snapshot.analysis)
    value = snapshot.analysis.value_of(at)
    found: list[str] = []
    if entry.member is not None and entry.slot is not None:
        if isinstance(at.node, ast.Number) and isinstance(value, float):
            metres = "MIRAGE" in snapshot.analysis.world.scene.nested
            found.append(arguments.facts(entry.member, entry.slot, value, metres=metres))
        elif vector is not None:
            found.append(arguments.of_vector(entry.member, entry.slot))
    if vector is not None:
        found.append(_vector(snapshot, vector, entry.slot, here))
    if here is not None:
        found.append(rows.facts(here, leaf[0], images=snapshot.client.images))
    span = leaf if isinstance(at.node, ast.Number) or vector is None else vector.span
    return "\n\n".join(part for part in found if part), span


def _vector(snapshot: Snapshot, at: ast.Located, slot: Slot | None, here: Enclosing | None) -> str:
    value = snapshot.analysis.value_of(at)
    if not isinstance(value, tuple):
        return ""
    kind = slot.argument.kind if slot is not None else _kind_of_target(snapshot, at)
    if kind == KIND:
        return arguments.color(value, images=snapshot.client.images)
    if kind == "direction" and any(value):
        return f"As a unit vector: `{vector(unit(np.array(value)))}`"
    return resolved.point(here, value) if kind == "point" and here is not None else ""


def _kind_of_target(snapshot: Snapshot, at: ast.Located) -> str:
    """What a vector that is assigned to a variable is used as."""
    item = at.path[-1]
    name = item.target.text if isinstance(item, ast.Assignment) else ""
    return KIND if name in color_variables(snapshot.analysis) else ""


def _in_table(snapshot: Snapshot, at: ast.Located | None, offset: int) -> str:
    here = None if at is None else snapshot.analysis.enclosing(at)
    if here is None or not isinstance(here.path.member, program.Table):
        return ""
    return rows.facts(here, offset, images=snapshot.client.images) or explain.table(
        here.path.member.entry, LANGUAGE.blocks[here.innermost.block]
    )
