"""Statements that have no effect where they stand: which, and what would give them one.

Whether a statement has an effect may depend on others of its block, which a variable may have brought along or a later
block may change. One that had an effect when it was written, and lost it because a copy of its block was changed, is
not spoken of: `shiny { SPECULAR 0 }` is how to say dull.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

from m3d_language.table import Default

from ..diagnostics import Findings, ItemFindings, catalogue
from ..diagnostics.catalogue import Entry
from ..text.span import Placed
from . import program
from .values import Record


class Rule(NamedTuple):
    """Statements that have no effect in a block that is `moot`, each with the value that is not missed there: what the
    block does anyway; None where every value is."""

    keywords: dict[str, Default]
    moot: Callable[[Record], bool]
    diagnostic: Entry
    why: str


def _shines_everywhere(source: Record) -> bool:
    return not source.flag("INFINITE") and source.number("ANGLE") >= 180 and source.number("EXPONENT") <= 0


def _is_infinite(source: Record) -> bool:
    return source.flag("INFINITE")


def _is_matt(surface: Record) -> bool:
    return surface.number("SPECULAR") == 0


# REFINDEX, which needs a METALLIC surface, is not among them: scenes since 1993 give it to every surface.
RULES: dict[str, tuple[Rule, ...]] = {
    "SURFACE": (
        Rule(
            {"HARD": 0.0, "METALLIC": 0.0},
            _is_matt,
            catalogue.IDLE_IN_SURFACE,
            "SPECULAR is 0: nothing is reflected specularly",
        ),
    ),
    "SOURCE": (
        Rule(
            {"ANGLE": 180.0, "EXPONENT": 0.0, "ATTENUATION": 0.0},
            _is_infinite,
            catalogue.IDLE_IN_LIGHT,
            "the light is INFINITE; only a POINT light has it",
        ),
        Rule(
            {"DIRECTION": None, "ZENITH": None, "AZIMUTH": None},
            _shines_everywhere,
            catalogue.IDLE_IN_LIGHT,
            "a POINT light stands at its FROM, and shines in all directions unless ANGLE or EXPONENT narrow it",
        ),
    ),
}


def idle(record: Record, members: Iterable[program.Member]) -> frozenset[str]:
    """The keywords of a record's statements that had no effect when they were last written, now that the members of a
    body have been written."""
    rules = RULES.get(record.block)
    if rules is None:
        return record.idle
    written = {member.entry.keyword for member in members if isinstance(member, program.Statement)}
    return (record.idle - written) | {keyword for keyword, _ in _without_effect(record, rules) if keyword in written}


class Weighed(NamedTuple):
    """A piece of text that one object has: what to say of it if it has no effect in any; None where it has one here."""

    place: Placed
    idle: tuple[Entry, str, str] | None  # the diagnostic, detail, what fills the headline


def weighed(record: Record) -> Iterator[Weighed]:
    """The statements of a finished record that rules are about: those that never had an effect and have none in the
    end, and those that have one."""
    rules = RULES.get(record.block, ())
    without = dict(_without_effect(record, rules))
    for keyword in {keyword for rule in rules for keyword in rule.keywords} & record.places.keys():
        rule = without.get(keyword)
        if rule is None:
            yield Weighed(record.places[keyword], None)
        elif keyword in record.idle:
            yield Weighed(record.places[keyword], (rule.diagnostic, rule.why, keyword))


def report_idle(pieces: Iterable[Weighed], findings: Findings) -> None:
    """Report the pieces of text that have no effect in any of the objects that have them, by a variable or not."""
    pieces = list(pieces)
    live = {piece.place for piece in pieces if piece.idle is None}
    for place, idle in dict.fromkeys(piece for piece in pieces if piece.place not in live):
        assert idle is not None
        entry, detail, fill = idle
        findings.add_at(entry, place, detail, fill=fill)


def _without_effect(record: Record, rules: tuple[Rule, ...]) -> Iterator[tuple[str, Rule]]:
    """The statements of a record that are moot, each with the first rule that says so."""
    seen: set[str] = set()
    for rule in rules:
        if rule.moot(record):
            for keyword, nothing in rule.keywords.items():
                if keyword not in seen and (nothing is None or record.values[keyword] != nothing):
                    seen.add(keyword)
                    yield keyword, rule


def report_unused_of_textures(block: program.Block, findings: ItemFindings) -> None:
    """Report the members of a texture that its kind makes no use of. All textures have all statements (thesis 7.5.5.4);
    which ones count stands in the language table."""
    uses = block.entry.uses
    if not uses:
        return
    ranges = any(isinstance(member, program.Table) for member in block.body)
    for member in block.body:
        keyword = member.entry.keyword
        if keyword not in uses:
            detail = f"{block.entry.keyword} uses {', '.join(uses[:-1])} and {uses[-1]}"
            findings.add(catalogue.IDLE_IN_TEXTURE, member.span, detail, fill=keyword)
        elif keyword == "COLOR" and ranges and "COLORS" in uses:
            findings.add(catalogue.IDLE_IN_TEXTURE, member.span, "COLORS takes its place", fill=keyword)


# What there must be for a texture to show, beside what stands in it: a place in the scene or its object, sources of
# waves, a u and v of the primitive, or heights from the scene's lowest to its highest point.
NEEDS: dict[str, str] = {
    **dict.fromkeys(("CHECKER", "WOOD", "MARBLE", "SPOTTED", "GRANITE", "CLOUDS", "BUMPS"), "place"),
    **dict.fromkeys(("WAVES", "RIPPLES"), "waves"),
    **dict.fromkeys(("UBLEND", "VBLEND"), "uv"),
    **dict.fromkeys(("SNOW", "GRADIENT"), "heights"),
}
