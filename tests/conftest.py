"""What all tests share: where things are, and `--rewrite`, which brings written-down expectations up to date."""

from __future__ import annotations

from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parent.parent


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--rewrite", action="store_true", help="write what the programs do now as what is expected; read the difference"
    )


@pytest.fixture
def rewrite(request: pytest.FixtureRequest) -> bool:
    """Whether expectations are to be rewritten instead of checked."""
    return bool(request.config.getoption("--rewrite"))


@pytest.fixture(scope="session")
def examples() -> Path:
    """The folder of example scenes."""
    return REPOSITORY / "examples"
