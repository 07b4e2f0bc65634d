"""Which word a misspelt one was probably meant to be."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable
from difflib import get_close_matches

# Of 0 to 1, how alike two words are at least.
ALIKE = 0.7

# Among so many words each is compared. Among more only those that stand next to the misspelt one in an alphabet, read
# forwards or backwards: what is written right has its beginning or its end in common with what was meant.
FEW = 60
NEIGHBOURS = 8


class Words:
    """Words that there are."""

    def __init__(self, words: Iterable[str]) -> None:
        self._all = list(words)
        self._forwards = sorted(self._all) if len(self._all) > FEW else []
        self._backwards = sorted(word[::-1] for word in self._all) if len(self._all) > FEW else []

    def nearest(self, word: str) -> str | None:
        """The word that is most like another, if one is like it at all."""
        candidates = self._all
        if self._forwards:
            candidates = _around(self._forwards, word)
            candidates += [other[::-1] for other in _around(self._backwards, word[::-1])]
        return next(iter(get_close_matches(word, candidates, 1, ALIKE)), None)


def _around(words: list[str], word: str) -> list[str]:
    at = bisect_left(words, word)
    return words[max(at - NEIGHBOURS, 0) : at + NEIGHBOURS]
