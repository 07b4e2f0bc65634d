"""The LALR(1) automaton of m3d.lark, worked out by Lark, as JSON: what says where a text stops being a sentence.

Lark takes half a second to build its parser, this file is read in a few milliseconds.
"""

from __future__ import annotations

import json
from typing import Any, cast

from lark import Lark

# A state is the rule that it reduces by, whatever comes next, as -1 - rule; or two mappings: from a terminal to the
# state it leads to, or to a rule in the same way; and from a nonterminal to the state it leads to.
State = int | tuple[dict[str, int], dict[str, int]]


class _Numbers(dict[Any, int]):
    """Numbers things in the order they are met."""

    def __missing__(self, key: Any) -> int:
        self[key] = len(self)
        return self[key]


def text(grammar: str) -> str:
    """The text of automaton.json: one line a state, numbered as they are reached from the first, state 0."""
    lark = Lark(grammar, parser="lalr", lexer="contextual", maybe_placeholders=False)
    table = cast(Any, lark.parser).parser._parse_table
    rules = _Numbers()
    numbers = _Numbers()
    order = [table.start_states["start"]]
    numbers[order[0]] = 0
    states: list[State] = []
    for found in order:
        terminals: dict[str, int] = {}
        nonterminals: dict[str, int] = {}
        for symbol, (action, argument) in sorted(table.states[found].items()):
            if action.name == "Reduce":
                terminals[symbol] = -1 - rules[argument]
                continue
            if argument not in numbers:
                order.append(argument)
            (terminals if symbol.isupper() else nonterminals)[symbol] = numbers[argument]
        reductions = set(terminals.values())
        only = next(iter(reductions)) if len(reductions) == 1 else 0
        states.append(only if only < 0 and not nonterminals else (terminals, nonterminals))
    shapes = [(str(rule.origin.name), len(rule.expansion)) for rule in rules]
    return "\n".join(
        [
            f'{{"end":{numbers[table.end_states["start"]]},',
            f'"rules":{json.dumps(shapes, separators=(",", ":"))},',
            '"states":[',
            ",\n".join(json.dumps(state, separators=(",", ":")) for state in states),
            "]}\n",
        ]
    )
