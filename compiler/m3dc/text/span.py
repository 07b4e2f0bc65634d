"""A stretch of text."""

from __future__ import annotations

from typing import TypeAlias

Span: TypeAlias = tuple[int, int]
"""A half-open range of bytes: the first, and the end. Where it counts from depends on who holds it: see places.py."""
