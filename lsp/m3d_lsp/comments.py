"""The comments of a document: where they are, and which of them tells what a thing is."""

from __future__ import annotations

from functools import lru_cache

from m3dc.analysis import Analysis
from m3dc.comments import Comments

__all__ = ["Comments", "comments"]


@lru_cache(maxsize=8)
def comments(analysis: Analysis) -> Comments:
    """The comments of an analysed document."""
    return Comments(analysis.source.data)
