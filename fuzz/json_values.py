"""What both targets that damage JSON ask of its values."""

from __future__ import annotations

from typing import Any


def is_container(value: Any) -> bool:
    """Whether a value may hold others."""
    return isinstance(value, dict | list)


def keys(container: dict[str, Any] | list[Any]) -> list[Any]:
    """What a container's values are found by: its keys, or their numbers."""
    return list(container) if isinstance(container, dict) else list(range(len(container)))


def values(container: dict[str, Any] | list[Any]) -> list[Any]:
    """What a container holds."""
    return list(container.values()) if isinstance(container, dict) else list(container)
