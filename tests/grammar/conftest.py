"""How long hypothesis tries: as long as usual, or with `--hypothesis-profile=thorough` fifty times as long.

There is no deadline for a single example: on a busy machine it would fail at random.
"""

from __future__ import annotations

from hypothesis import HealthCheck, settings

settings.register_profile("usual", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("thorough", settings.get_profile("usual"), max_examples=5000)
settings.load_profile("usual")
