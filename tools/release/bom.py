"""The software bill of materials of a release, in CycloneDX's form: all that an installation consists of.

Three programs know a part of it each: cyclonedx-py the Python packages of an environment in which the release is
installed, cargo the crates that are compiled into the kernel, npm the packages that are bundled into the extension.
"""

from __future__ import annotations

import json
import os
from operator import itemgetter
from pathlib import Path
from typing import Any

from tools.release.environment import TOOLS, epoch, output, run, tool
from tools.version import DISTRIBUTIONS, ROOT, version

FORMAT = "1.5"
VALIDATION = """
import sys
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
sys.exit(JsonStrictValidator(SchemaVersion.from_version(sys.argv[2])).validate_str(open(sys.argv[1]).read()))
"""
# Of our own packages it is of no interest from which folder they were installed; pip is part of every environment.
LEFT_OUT = {"pip", "setuptools"}

Node = dict[str, Any]


def write(file: Path, installed: Path) -> None:
    """Writes the bill of what is installed in a virtual environment, and of the extension. Raises ReleaseError."""
    bill = python_bill(installed)
    for part in (crates_bill(), npm_bill()):
        bill["components"] += part["components"]
        bill["dependencies"] += part["dependencies"]
    whole = next(each for each in bill["dependencies"] if each["ref"] == bill["metadata"]["component"]["bom-ref"])
    whole["dependsOn"] = sorted({*whole.get("dependsOn", []), "m3d-python", "m3d"})
    bill["components"].sort(key=itemgetter("bom-ref"))
    bill["dependencies"].sort(key=itemgetter("ref"))
    file.write_text(json.dumps(bill, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    run(TOOLS / "bin/python", "-c", VALIDATION, file, FORMAT)


def python_bill(installed: Path) -> Node:
    """What is installed in an environment, but pip, as part of the distribution `mirage3d`."""
    options = ["--pyproject", ROOT / "suite/pyproject.toml", "--spec-version", FORMAT, "--output-reproducible"]
    environment = {**os.environ, "SOURCE_DATE_EPOCH": str(epoch())}
    bill = json.loads(output(tool("cyclonedx-py"), "environment", *options, installed, env=environment))
    left_out = {each["bom-ref"] for each in bill["components"] if each["name"] in LEFT_OUT}
    bill["components"] = [each for each in bill["components"] if each["bom-ref"] not in left_out]
    for component in bill["components"]:
        if component["name"] in DISTRIBUTIONS:
            component.pop("externalReferences", None)
            component["purl"] = f"pkg:pypi/{component['name']}@{component['version']}"
    bill["dependencies"] = [each for each in bill["dependencies"] if each["ref"] not in left_out]
    return bill


def crates_bill() -> Node:
    """The crates that are compiled into the kernel, those for building and testing left out."""
    here = output("rustc", "--print", "host-tuple").strip()
    options = ["--format-version", "1", "--filter-platform", here, "--manifest-path", ROOT / "renderer/Cargo.toml"]
    metadata = json.loads(output("cargo", "metadata", *options))
    packages = {each["id"]: each for each in metadata["packages"]}
    nodes = {each["id"]: each["deps"] for each in metadata["resolve"]["nodes"]}

    def reference(identity: str) -> str:
        package = packages[identity]
        return package["name"] if package["source"] is None else f"{package['name']}@{package['version']}"

    found: dict[str, list[str]] = {}
    waiting = [identity for identity, package in packages.items() if package["name"] == "m3d-python"]
    while waiting:
        identity = waiting.pop()
        if identity not in found:
            compiled_in = [
                each["pkg"] for each in nodes[identity] if any(kind["kind"] is None for kind in each["dep_kinds"])
            ]
            found[identity] = compiled_in
            waiting += compiled_in
    components: list[Node] = [
        {
            "type": "library",
            "bom-ref": reference(identity),
            "name": packages[identity]["name"],
            "version": packages[identity]["version"],
            "purl": f"pkg:cargo/{packages[identity]['name']}@{packages[identity]['version']}",
            "licenses": [{"expression": packages[identity]["license"].replace("/", " OR ")}],
        }
        for identity in found
    ]
    dependencies = [
        {"ref": reference(identity), "dependsOn": sorted({*map(reference, others)})}
        for identity, others in found.items()
    ]
    return {"components": components, "dependencies": dependencies}


def npm_bill() -> Node:
    """What is bundled into the extension for VS Code, and the extension itself, `m3d`."""
    options = ["--omit", "dev", "--package-lock-only", "--sbom-format", "cyclonedx"]
    bill = json.loads(output("npm", "sbom", *options, cwd=ROOT / "vscode-extension"))
    extension: Node = bill["metadata"]["component"]
    names = {extension["bom-ref"]: "m3d"}
    extension["bom-ref"] = "m3d"
    for dependency in bill["dependencies"]:
        dependency["ref"] = names.get(dependency["ref"], dependency["ref"])
    return {"components": [*bill["components"], extension], "dependencies": bill["dependencies"]}


def file_name() -> str:
    """What the bill of this version is called."""
    return f"mirage3d-{version()}.cyclonedx.json"
