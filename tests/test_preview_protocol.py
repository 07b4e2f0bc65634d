"""The preview protocol stands in protocol/preview.toml, and the render options that it knows in one list."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from m3d_render.options import PREVIEW, Option, Real, Switch, Whole
from tools import preview_protocol
from tools.preview_protocol import camel

KINDS: dict[type, str] = {Whole: "integer", Real: "number", Switch: "boolean"}
MANIFEST = preview_protocol.ROOT / "vscode-extension/package.json"


@pytest.mark.parametrize("path", preview_protocol.texts(), ids=lambda path: path.name)
def test_what_is_made_of_the_description_is_current(path: Path) -> None:
    assert path.read_text(encoding="utf-8") == preview_protocol.texts()[path], (
        "run `make generate` and commit the result"
    )


def test_every_name_in_the_description_means_something() -> None:
    described = preview_protocol.protocol()
    known = {*described.choices, *described.objects}
    plain = {"string", "whole", "number", "flag", "bytes", "document", "position", "range", "token"}
    fields = [field for _, fields in described.objects.values() for field in fields.values()]
    fields += [field for request in described.requests.values() for field in request.params.values()]
    assert {field.is_.split("[")[0] for field in fields} <= known | plain
    answers = {part for request in described.requests.values() for part in request.answer.split(" | ")}
    assert answers - {"null"} <= known
    assert set(described.notifications.values()) <= known


@pytest.mark.parametrize(("name", "option"), PREVIEW.items())
def test_the_extension_has_a_setting_and_a_task_for_each_option(name: str, option: Option) -> None:
    contributes: dict[str, Any] = json.loads(MANIFEST.read_text(encoding="utf-8"))["contributes"]
    setting = contributes["configuration"]["properties"][f"m3d.preview.{camel(name)}"]
    (task,) = (task for task in contributes["taskDefinitions"] if task["type"] == "m3d-render")
    for property_ in (setting, task["properties"][camel(name)]):
        assert property_["type"] == KINDS[type(option.kind)]
        assert not isinstance(option.kind, Whole) or property_["minimum"] == option.kind.least
    assert setting["default"] == option.default
