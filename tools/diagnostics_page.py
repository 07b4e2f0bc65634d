"""Writes docs/diagnostics.md from the compiler's catalogue: part of `make generate`."""

from __future__ import annotations

from m3dc.diagnostics.catalogue import CATALOGUE

from .generated import ROOT, write

PAGE = ROOT / "docs/diagnostics.md"

INTRODUCTION = """\
# Diagnostics

*Made by `make generate` from compiler/m3dc/diagnostics/catalogue.py.*

What the compiler can say about a scene. Headlines are those of the 1993 program where it had one (thesis, Appendix B).
An *error* stops a scene from being rendered, a *warning* does not, a *hint* is shown only when asked for.

| | |
|---|---|
| `m3dc --explain CODE` | shows an entry of this page |
| `m3dc -W CODE` | warns of a hint |
| `m3dc --deny CODE` | makes a warning an error |
| `m3dc --allow CODE` | keeps a warning back |
| `/* m3d: allow CODE, CODE */` | keeps a warning back: in the whole file from its top, else on this line and the next |

`CODE` is a code, several with commas, or `all`.
"""

LONGEST_EXAMPLE = 160


def page() -> str:
    """The whole page."""
    parts = [INTRODUCTION]
    for code, entry in CATALOGUE.items():
        headline = entry.headline.format("...") if "{}" in entry.headline else entry.headline
        parts += [f"## {code}\n", f"*{entry.severity}*: **{headline}**\n", f"{entry.says}\n"]
        if max(len(entry.wrong), len(entry.right)) <= LONGEST_EXAMPLE and entry.wrong.isprintable():
            parts.append(f"```\n{entry.wrong}\n```\n\nMended:\n\n```\n{entry.right}\n```\n")
    return "\n".join(parts)


if __name__ == "__main__":
    write({PAGE: page()})
