"""What goes with something that is cut out of a text: its line, if it stands there alone, or the blanks beside it."""

from __future__ import annotations

import re

from .span import Span

_BLANKS = re.compile(rb"[ \t]*")


def cut(data: bytes, start: int, end: int) -> Span:
    """The range of bytes to delete so that nothing is left of a range, and no needless blank."""
    line = data.rfind(b"\n", 0, start) + 1
    newline = data.find(b"\n", end)
    line_end = newline if newline >= 0 else len(data)
    if not data[end:line_end].strip():
        if not data[line:start].strip():
            return line, min(line_end + 1, len(data))
        return line + len(data[line:start].rstrip()), end
    blanks = _BLANKS.match(data, end)
    return start, blanks.end() if blanks else end
