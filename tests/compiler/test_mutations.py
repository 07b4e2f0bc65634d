"""One token deleted, doubled or swapped with the next, anywhere in the examples: never a crash, and the first
diagnostic stands on the statement that was changed or in its block.

    .venv/bin/python tests/compiler/test_mutations.py [SEED] [COUNT]

prints the share, the worst cases, and the median time of a check.
"""

from __future__ import annotations

import random
import statistics
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from mutations import Mutation, mutations

import m3dc
from m3d_language.comments import blank_comments
from m3d_language.formal import parser

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
NAMES = ("merman", "runway", "wheel", "two-balls", "cylinder-and-cone")
WANTED = 0.9


class Outcome(NamedTuple):
    mutation: Mutation
    result: m3dc.Result
    seconds: float

    @property
    def first(self) -> m3dc.Diagnostic | None:
        """The first error, or else the first warning."""
        errors = [d for d in self.result.diagnostics if d.severity == "error"]
        return next(iter(errors or self.result.diagnostics), None)

    @property
    def near(self) -> bool:
        """Whether the first diagnostic is in the block that was changed, or at its very edge."""
        assert self.first is not None
        start, end = self.mutation.block
        return start <= self.first.span.start <= end + 1


def outcomes(seed: int, count: int) -> Iterator[Outcome]:
    chance = random.Random(seed)
    for name in NAMES:
        text = (EXAMPLES / f"{name}.m3d").read_text(encoding="utf-8")
        assert text.isascii()
        for mutation in mutations(text, chance, count // len(NAMES)):
            begin = time.perf_counter()
            result = m3dc.compile(mutation.text)
            yield Outcome(mutation, result, time.perf_counter() - begin)


def is_sentence(text: str) -> bool:
    from lark.exceptions import UnexpectedInput

    try:
        parser().parse(blank_comments(text))  # pyright: ignore[reportUnknownMemberType]  Lark says too little
    except UnexpectedInput:
        return False
    return True


@pytest.mark.slow
def test_the_first_diagnostic_is_where_the_mistake_is() -> None:
    found = list(outcomes(seed=1993, count=1500))
    for outcome in found:
        if outcome.result.ok:
            assert is_sentence(outcome.mutation.text), "what is no sentence has an error"
    reported = [outcome for outcome in found if not outcome.result.ok]
    assert len(reported) > len(found) / 2
    near = sum(outcome.near for outcome in reported) / len(reported)
    assert near > WANTED, f"{near:.1%}"


def main() -> None:
    seed, count = (int(argument) for argument in [*sys.argv[1:], "1993", "5000"][:2])
    found = list(outcomes(seed, count))
    reported = [outcome for outcome in found if not outcome.result.ok]
    far = [outcome for outcome in reported if not outcome.near]
    print(
        f"seed {seed}: {len(found)} mutations, {len(reported)} with errors, first one near: "
        f"{1 - len(far) / len(reported):.1%}"
    )
    print(f"median check {statistics.median(o.seconds for o in found) * 1e3:.1f} ms")
    print(f"errors a mutation: {Counter(min(len(o.result.diagnostics), 6) for o in reported)}")
    print(Counter((o.mutation.what, o.first.code) for o in far if o.first).most_common(12))
    for outcome in far[:: max(len(far) // 12, 1)]:
        assert outcome.first is not None
        source = outcome.result.source
        at = source.position(outcome.mutation.at)
        where = source.position(outcome.first.span.start)
        print(
            f"{outcome.mutation.what} at {at.line}:{at.column} -> {where.line}:{where.column} {outcome.first.message}"
        )
        print("    " + source.line(at.line).strip()[:100])


if __name__ == "__main__":
    main()
