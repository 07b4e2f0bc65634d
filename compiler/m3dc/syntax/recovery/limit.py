"""How much is read of a text before it is given up."""

from __future__ import annotations

MOST_TOKENS = 400_000
_FEW = 20_000
_TOKENS_PER_BYTE = 4


class GivenUpError(Exception):
    """The text is too broken to be read on; says why."""


class Budget:
    """The number of tokens that may still be made of a text of so many bytes. A broken block may be read several times,
    to find out what it means: without a limit a text of nothing else would take a time that grows with its square."""

    def __init__(self, length: int) -> None:
        self.left = min(_FEW + _TOKENS_PER_BYTE * length, MOST_TOKENS)

    def spend(self, tokens: int) -> None:
        """Count tokens, or work that takes as long."""
        self.left -= tokens
        if self.left < 0:
            raise GivenUpError("so little of the text can be understood that the rest is not looked at")
