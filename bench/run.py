"""`python -m bench`: measure the rows of the table and print it."""

from __future__ import annotations

import argparse
import os
import platform
import sys
from collections.abc import Callable
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import NamedTuple

from . import atm, cancel, compiler, paths, rendering, server
from .child import RunError
from .result import Aim, Result, notes, table
from .workshop import Workshop, version

Measure = Callable[[Workshop], list[Result]]


class Group(NamedTuple):
    """Rows that are measured together."""

    names: tuple[str, ...]
    measure: Measure


FACETS = "1,000,000 triangles and 100 mirror spheres, 1280 x 800"

GROUPS = (
    Group(("dump-small",), compiler.start),
    Group(("compile-terrain", "compile-terrain-memory"), compiler.terrain),
    Group(("compile-hostile",), compiler.hostile),
    Group(
        ("merman-shadows",),
        partial(
            rendering.straight,
            name="merman",
            shadows=True,
            work="straight picture, merman scene, 1280 x 800, shadows",
            aim=Aim(1.0),
        ),
    ),
    Group(
        ("terrain",),
        partial(rendering.straight, name="terrain", shadows=False, work=f"straight picture, {FACETS}", aim=Aim(0.5)),
    ),
    Group(
        ("terrain-shadows",),
        partial(rendering.straight, name="terrain", shadows=True, work="the same with shadows", aim=Aim(0.5)),
    ),
    Group(("terrain-whole", "terrain-memory"), rendering.whole),
    Group(("terrain-primary",), rendering.primary),
    Group(("threads-terrain",), rendering.threads),
    Group(
        ("mirage-merman-shadows",),
        partial(rendering.mirage, name="merman", shadows=True, work="mirage picture, merman scene, shadows"),
    ),
    Group(
        ("mirage-terrain",),
        partial(rendering.mirage, name="terrain", shadows=False, work="mirage picture, the terrain"),
    ),
    Group(
        ("mirage-terrain-shadows",),
        partial(rendering.mirage, name="terrain", shadows=True, work="mirage picture, the terrain, shadows"),
    ),
    Group(("cancel",), cancel.cancelled),
    Group(("paths",), paths.paths),
    Group(("atm",), atm.picture),
    Group(("server-diagnostics", "server-hover", "server-completion", "server-pull"), server.small),
    Group(("server-50k", "server-terrain"), server.large),
)


def main() -> int:
    """Run the command; returns the exit status."""
    options = _parser().parse_args()
    if options.list:
        print("\n".join(name for group in GROUPS for name in group.names))
        return 0
    wanted: list[str] = options.only or [""]
    chosen = [group for group in GROUPS if any(text in name for text in wanted for name in group.names)]
    if not chosen:
        print(f"bench: no row has {' or '.join(wanted)} in its name; --list shows them", file=sys.stderr)
        return 2
    shop = Workshop(options.folder, options.repeats, fetch=options.with_atm_raytracer)
    results: list[Result] = []
    failures: list[str] = []
    for group in chosen:
        print(f"measuring {', '.join(group.names)} ...", file=sys.stderr, flush=True)
        try:
            results += group.measure(shop)
        except (RunError, OSError, RuntimeError, ValueError) as error:
            failures.append(f"{', '.join(group.names)}: {error}")
            print(f"bench: {failures[-1]}", file=sys.stderr)
    results = [result for result in results if any(text in result.name for text in wanted)]
    print(table(results))
    print()
    print(notes(results))
    if options.write is not None and results:
        options.write.write_text(page(results, failures))
        print(f"\nwritten: {options.write}", file=sys.stderr)
    return 1 if failures else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m bench",
        description="Measure our compiler and renderer beside other programs, in one run, and print the ratios.",
        epilog="Exit status: 0 all rows were measured, 1 some could not be, 2 usage. A missed aim is no failure.",
    )
    parser.add_argument("--only", action="append", metavar="TEXT", help="rows with this in their name; may be repeated")
    parser.add_argument("--list", action="store_true", help="print the names of the rows and end")
    parser.add_argument("--repeats", type=int, default=5, metavar="N", help="samples of each; the median counts (5)")
    parser.add_argument("--write", type=Path, metavar="FILE", help="write the table, machine and date to FILE")
    parser.add_argument(
        "--folder", type=Path, default=Path("out/bench"), help="where scenes and programs are made (out/bench)"
    )
    parser.add_argument(
        "--with-atm-raytracer",
        action="store_true",
        help="fetch atm-raytracer from crates.io, build it in the folder and measure it (some minutes)",
    )
    return parser


def processor() -> str:
    """The processor's name, as the system has it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine())


def machine() -> list[str]:
    """What the figures were taken on, and with."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    povray = version("povray", "--version")
    return [
        f"{processor()}, {os.cpu_count()} processors, {memory:.0f} GiB, {platform.system()}",
        f"Python {platform.python_version()}; {version('cc', '--version') or 'no cc'}; {povray or 'no POV-Ray'}",
        f"load of the machine at the end (1, 5, 15 minutes): {', '.join(f'{load:.2f}' for load in os.getloadavg())}",
    ]


def page(results: list[Result], failures: list[str]) -> str:
    """docs/performance.md."""
    command = " ".join(["python -m bench", *sys.argv[1:]])
    date = datetime.now(UTC).date().isoformat()
    failed = "".join(f"\n- not measured: {failure.splitlines()[0]}" for failure in failures)
    return f"""\
# Performance

Our compiler and renderer beside the programs one would otherwise use, all measured in one run, in turn, on one
machine. Each figure is the median of several samples. This page is written by the run itself:

```
{command}
```

on {date}:

{chr(10).join(f"- {line}" for line in machine())}

{table(results)}

Figures of single rows:

{notes(results)}{failed}

{METHOD}"""


METHOD = """\
## How it is measured

- The scenes are made by `bench/scenes.py`, the same text every time. The merman scene is `examples/merman.m3d` at
  1280 x 800 with shadows; the terrain is 1,000,000 triangles written out as POLYGONS, with 100 mirror spheres.
- POV-Ray renders the same geometry through the same camera, translated by `bench/povray.py` from the compiled scene,
  with one thread and no antialiasing. That it is the same is checked in each run by the two programs' silhouettes.
- Seconds are processor time unless a row says otherwise. POV-Ray's are its own figures for parsing and for tracing;
  ours for a picture are those of the call that renders with one thread, its acceleration structure built before
  (the row `terrain-whole` leaves nothing out on either side). POV-Ray builds its own as it parses.
- Memory is the largest resident memory of the process, as the system gives it at its end.
- The C tracer (`bench/tracer/arcs.c`) follows the same parabolas through the same layers; the run compares where
  every ray ends. Embree (`bench/embree/primary.c`) gets the same camera, triangles and spheres; a sample of either is
  the least of three pictures.
- Curved and straight pictures are measured in eight bands by turns, and the bands' medians added.
- Giving up is timed by the clock, from the moment at which another thread asks for it, half a second into the work.
- The language servers get edits from one client (`bench/lsp_client.py`), each in its turn: a number is replaced in a
  text of 2,000 lines, and the time is taken until its diagnostics are there; then a hover and a completion.
- What is not installed is left out, and its column says so. `apt install povray libembree-dev` brings two.
- Nothing here is a test: no suite fails because a machine was slow.
"""


if __name__ == "__main__":
    sys.exit(main())
