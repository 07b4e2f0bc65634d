"""What a user can set, under `m3d` in the settings of the editor. All of it takes effect at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, cast

from m3dc.diagnostics.levels import Levels


@dataclass(frozen=True)
class Diagnostics:
    """Codes such as `M3D0503`, or `all`: hints to show as warnings, warnings to show as errors, and what not to
    show."""

    warn: tuple[str, ...] = ()
    deny: tuple[str, ...] = ()
    allow: tuple[str, ...] = ()

    @property
    def levels(self) -> Levels:
        return Levels(frozenset(self.warn), frozenset(self.deny), frozenset(self.allow))


@dataclass(frozen=True)
class InlayHints:
    """What is shown between the words of a text."""

    vertexIds: bool = True  # the numbers of vertices, as FACETS names them  # noqa: N815
    argumentNames: bool = True  # what bare numbers in a list mean  # noqa: N815
    variableValues: bool = True  # what a variable stands for  # noqa: N815


@dataclass(frozen=True)
class CodeLens:
    enabled: bool = True


@dataclass(frozen=True)
class Format:
    enabled: bool = True


@dataclass(frozen=True)
class Preview:
    """`threads` is how many processors may draw; 0 is all of them."""

    threads: int = 0


@dataclass(frozen=True)
class Settings:
    """All settings, by the names they have in the editor."""

    diagnostics: Diagnostics = field(default_factory=Diagnostics)
    inlayHints: InlayHints = field(default_factory=InlayHints)  # noqa: N815
    codeLens: CodeLens = field(default_factory=CodeLens)  # noqa: N815
    format: Format = field(default_factory=Format)
    preview: Preview = field(default_factory=Preview)


def read_settings(given: object) -> tuple[Settings, list[str]]:
    """Settings from an editor's JSON, and what is wrong with it; what is not given or not right has its default."""
    problems: list[str] = []
    groups = _group(given, "m3d", problems)
    settings = Settings()
    for group in fields(settings):
        default = getattr(settings, group.name)
        name = f"m3d.{group.name}"
        values = _group(groups.get(group.name), name, problems)
        read = {
            entry.name: _value(
                getattr(default, entry.name), values[entry.name], f"m3d.{group.name}.{entry.name}", problems
            )
            for entry in fields(default)
            if values.get(entry.name) is not None
        }
        settings = replace(settings, **{group.name: replace(default, **read)})
    return settings, problems


def _group(given: object, name: str, problems: list[str]) -> Mapping[str, Any]:
    if isinstance(given, Mapping):
        return cast("Mapping[str, Any]", given)
    if given is not None:
        problems.append(f"{name} must be a group of settings, not {given!r}")
    return {}


def _value(default: object, given: object, name: str, problems: list[str]) -> object:
    """A setting's value of the type of its default, which it has where it is given another."""
    if isinstance(default, bool):
        read, wanted = (given if isinstance(given, bool) else None), "true or false"
    elif isinstance(default, tuple):
        read, wanted = _strings(given), "a list of codes"
    else:
        whole = isinstance(given, int) and not isinstance(given, bool) and given >= 0
        read, wanted = (given if whole else None), "a whole number, 0 or more"
    if read is not None:
        return read
    problems.append(f"{name} must be {wanted}, not {given!r}")
    return cast(object, default)


def _strings(given: object) -> tuple[str, ...] | None:
    values = cast("list[object]", given) if isinstance(given, list) else [None]
    strings = tuple(value for value in values if isinstance(value, str))
    return strings if len(strings) == len(values) else None
