"""What `make generate` writes from the compiler's tables is current."""

from __future__ import annotations

from types import ModuleType

import pytest

from tools import diagnostics_page, ir_crate, m3ir_page


@pytest.mark.parametrize("made", [diagnostics_page, ir_crate, m3ir_page], ids=lambda made: made.PAGE.name)
def test_the_page_is_current(made: ModuleType) -> None:
    assert made.PAGE.read_text(encoding="utf-8") == made.page(), "run `make generate` and commit the result"
