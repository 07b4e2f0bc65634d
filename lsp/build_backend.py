"""The build backend, by which pip finds the other parts of a checkout beside this one.

uv knows them by the workspace. For pip `m3dc==1.0` is something of a package index; so the metadata in which pip, in a
checkout, reads what else is needed names their folders instead. What is built is what is built elsewhere.

The same file stands in every part that needs another one: `make generate` copies it from suite/.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

if Path("Cargo.toml").exists():
    import maturin as backend
else:
    from setuptools import build_meta as backend


def __getattr__(hook: str) -> Any:
    """Every hook that is not below is the backend's own."""
    return getattr(backend, hook)


def prepare_metadata_for_build_wheel(folder: str, settings: Any = None) -> str:
    """The backend's own, with folders of the checkout as requirements."""
    return _with_folders(folder, backend.prepare_metadata_for_build_wheel(folder, settings))


def prepare_metadata_for_build_editable(folder: str, settings: Any = None) -> str:
    """The backend's own, with folders of the checkout as requirements."""
    return _with_folders(folder, backend.prepare_metadata_for_build_editable(folder, settings))


def build_wheel(folder: str, settings: Any = None, metadata: str | None = None) -> str:
    """The backend's own, which does not see the metadata above."""
    return backend.build_wheel(folder, settings)


def build_editable(folder: str, settings: Any = None, metadata: str | None = None) -> str:
    """The backend's own, which does not see the metadata above."""
    return backend.build_editable(folder, settings)


def _with_folders(folder: str, name: str) -> str:
    metadata = Path(folder, name, "METADATA")
    text = metadata.read_text(encoding="utf-8")
    for part, place in _parts().items():
        required = rf"^(Requires-Dist: {re.escape(part)}(?:\[[^\]]*\])?) ?==[^;\n]*?( ?;.*)?$"
        text = re.sub(required, rf"\1 @ {place.as_uri()} \2", text, flags=re.MULTILINE)
    metadata.write_text(text, encoding="utf-8")
    return name


def _parts() -> dict[str, Path]:
    """The folders of the checkout's distributions, by name; none where this is no checkout."""
    root = Path.cwd().parent
    if not (root / "pyproject.toml").exists():
        return {}
    members = _toml(root).get("tool", {}).get("uv", {}).get("workspace", {}).get("members", [])
    if Path.cwd().name not in members:
        return {}
    return {_toml(root / member)["project"]["name"]: root / member for member in members}


def _toml(folder: Path) -> dict[str, Any]:
    return tomllib.loads((folder / "pyproject.toml").read_text(encoding="utf-8"))
