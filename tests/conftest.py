"""What all tests share: where things are, `--rewrite`, which brings written-down expectations up to date, and how long
hypothesis tries: as long as usual, or with `--hypothesis-profile=thorough` fifty times as long.

There is no deadline for a single example: on a busy machine it would fail at random.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile("usual", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("thorough", settings.get_profile("usual"), max_examples=5000)
settings.load_profile("usual")

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
