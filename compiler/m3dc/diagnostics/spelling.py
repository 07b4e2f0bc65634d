"""Words that are nearly right: which known one was probably meant, and whether it certainly was."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Collection, Iterable, Sequence
from difflib import get_close_matches

from m3d_language.table import LANGUAGE

_ALIKE = 0.7  # of difflib's measure
_SHORTEST = 4  # a shorter word is one edit away from too many others

# Among so many names each is compared. Among more only those that stand next to the misspelt one in an alphabet, read
# forwards or backwards: what is written right has its beginning or its end in common with what was meant.
_FEW = 60
_NEIGHBOURS = 8


def nearest(word: str, known: Collection[str]) -> str | None:
    """The known keyword that a word looks most like, if it looks like any: a single one that it is one slip away from,
    or else the most alike."""
    slips = [other for other in known if _is_one_slip(word.upper(), other)] if len(word) >= _SHORTEST else []
    if len(slips) == 1 and word.upper() not in known:
        return slips[0]
    return _most_alike(word.upper(), sorted(known))


def certain(word: str, known: Collection[str]) -> str | None:
    """The keyword that a word can only be, of those known here: it is that in small letters, or is one slip away from
    it, and from no other, and has no meaning of its own elsewhere. None where there is none."""
    upper = word.upper()
    if upper in known:
        return upper
    if len(word) < _SHORTEST or upper in LANGUAGE.keywords:
        return None
    found = [other for other in known if _is_one_slip(upper, other)]
    return found[0] if len(found) == 1 else None


def meant_type(word: str) -> str | None:
    """The type that a word can only be that is none: it is nearly one, or another language's word for it."""
    near = certain(word, LANGUAGE.types)
    elsewhere = LANGUAGE.types_elsewhere.get(word.lower())
    return near or (elsewhere if elsewhere in LANGUAGE.types else None)


def _most_alike(word: str, known: Sequence[str]) -> str | None:
    """The known word that is most like another. One of twice the length of all of them is like none."""
    if len(word) > 2 * max(map(len, known), default=0):
        return None
    return next(iter(get_close_matches(word, known, 1, _ALIKE)), None)


def _is_one_slip(word: str, other: str) -> bool:
    """Whether a letter too many, a letter missing, a wrong letter, or two letters swapped make one word of another."""
    if len(word) > len(other):
        word, other = other, word
    if word == other or len(other) - len(word) > 1:
        return False
    start = next((i for i, (a, b) in enumerate(zip(word, other, strict=False)) if a != b), len(word))
    if len(word) < len(other):
        return word[start:] == other[start + 1 :]
    swapped = word[start + 1 : start + 2] + word[start : start + 1]
    return word[start + 1 :] == other[start + 1 :] or swapped + word[start + 2 :] == other[start:]


class Names:
    """Names that there are, such as those of variables; there may be thousands."""

    def __init__(self, names: Iterable[str]) -> None:
        self._all = list(names)
        self._forwards = sorted(self._all) if len(self._all) > _FEW else []
        self._backwards = sorted(name[::-1] for name in self._all) if len(self._all) > _FEW else []

    def nearest(self, name: str) -> str | None:
        """The name that is most like another, if one is like it at all."""
        candidates = self._all
        if self._forwards:
            candidates = _around(self._forwards, name)
            candidates += [other[::-1] for other in _around(self._backwards, name[::-1])]
        return _most_alike(name, candidates)


def _around(names: list[str], name: str) -> list[str]:
    at = bisect_left(names, name)
    return names[max(at - _NEIGHBOURS, 0) : at + _NEIGHBOURS]
