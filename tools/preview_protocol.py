"""Writes what follows from protocol/preview.toml: part of `make generate`.

That is the protocol's types in Python and TypeScript, and its section in docs/protocol.md. The render options that
previews know are those of m3d_render/options.py that say so.
"""

from __future__ import annotations

import re
import textwrap
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from m3d_render.formats import FORMATS
from m3d_render.options import PREVIEW, Option, Switch, Whole

from .generated import ROOT, write

SOURCE = ROOT / "protocol/preview.toml"
PYTHON = ROOT / "lsp/m3d_lsp/preview/wire.py"
TYPESCRIPT = ROOT / "web/picture/src/protocol.ts"
DOCS = ROOT / "docs/protocol.md"

_MADE = "Made by `make generate` from protocol/preview.toml"
_SECTION = re.compile(r"(?<=<!-- preview -->\n).*?(?=<!-- /preview -->)", re.DOTALL)
_LIST = re.compile(r"(.+)\[(\d*)\]")

Fields: TypeAlias = dict[str, "Field"]


class Field(NamedTuple):
    """A member of an object; `is_` as the head of the TOML file says."""

    is_: str
    says: str
    optional: bool = False
    least: int = 0
    default: bool | int | float | None = None


class Request(NamedTuple):
    """A request, by its method."""

    says: str
    answer: str
    params: Fields


class Protocol(NamedTuple):
    """The whole description: choices and objects by name with what they are, and what is said when."""

    about: str
    notes: str
    choices: dict[str, tuple[str, list[str]]]
    objects: dict[str, tuple[str, Fields]]
    requests: dict[str, Request]
    notifications: dict[str, str]


def protocol() -> Protocol:
    """The description, the render options put in."""
    read: dict[str, Any] = tomllib.loads(SOURCE.read_text(encoding="utf-8"))
    types: dict[str, Any] = read["types"]
    requests = {f"m3d/preview/{name}": _request(given) for name, given in read["requests"].items()}
    return Protocol(
        read["about"].strip(),
        read["notes"].strip(),
        {name: (given["says"], given["one_of"]) for name, given in types.items() if "one_of" in given},
        {name: (given["says"], _fields(given["fields"])) for name, given in types.items() if "fields" in given},
        requests,
        {f"m3d/preview/{name}": given["params"] for name, given in read["notifications"].items()},
    )


def _request(given: dict[str, Any]) -> Request:
    answers = [*([given["answer"]] if "answer" in given else []), *(["null"] if given.get("nullable") else [])]
    options = {camel(name): _option(option) for name, option in PREVIEW.items()} if given.get("options") else {}
    return Request(given["says"], " | ".join(answers), _fields(given["params"]) | options)


def _fields(given: dict[str, Any]) -> Fields:
    return {
        name: Field(
            field["is"], field["says"], field.get("optional", False), field.get("least", 0), field.get("default")
        )
        for name, field in given.items()
    }


def _option(option: Option) -> Field:
    is_ = "whole" if isinstance(option.kind, Whole) else "flag" if isinstance(option.kind, Switch) else "number"
    least = option.kind.least if isinstance(option.kind, Whole) else 0
    return Field(is_, f"{option.help[0].upper()}{option.help[1:]}.", True, least, option.default)


def camel(name: str) -> str:
    """A name as JSON has it."""
    return re.sub(r"_(.)", lambda found: found[1].upper(), name)


def snake(name: str) -> str:
    """A name as Python has it."""
    return re.sub(r"([A-Z])", lambda found: f"_{found[1].lower()}", name)


def _quoted(text: str) -> str:
    return f'"{text}"'


def texts() -> dict[Path, str]:
    """Every file that is made, with what it should be."""
    described = protocol()
    docs = DOCS.read_text(encoding="utf-8")
    return {
        PYTHON: "\n".join(_python(described)),
        TYPESCRIPT: "\n".join(_typescript(described)),
        DOCS: _SECTION.sub(lambda _: "\n".join(_docs(described)), docs),
    }


# --- Python ---------------------------------------------------------------------------------------------------------


def _python(described: Protocol) -> Iterator[str]:
    yield f'"""What is said about previews. {_MADE}.\n'
    yield 'Answers and notifications are dictionaries, as JSON has them.\n"""\n'
    yield "from __future__ import annotations\n"
    yield "from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, TypedDict\n"
    yield "from lsprotocol import types\n\nfrom ..given import Given\n"
    yield "if TYPE_CHECKING:  # the server's process does not load the renderer"
    yield "    from m3d_render import RenderOptions\n"
    for name, (says, values) in described.choices.items():
        yield f"{name}: TypeAlias = Literal[{', '.join(f'{value!r}' for value in values)}]".replace("'", '"')
        yield f'"""{says}"""\n'
    for name, (says, fields) in described.objects.items():
        yield f'\nclass {name}(TypedDict):\n    """{says}"""\n'
        yield from (f"    {key}: {_python_type(field)}" for key, field in fields.items())
        yield ""
    for method, request in described.requests.items():
        yield from _python_params(method, request)
    yield ""
    for method in (*described.requests, *described.notifications):
        yield f'{method.rpartition("/")[2].upper()} = "{method}"'
    yield ""


def _python_params(method: str, request: Request) -> Iterator[str]:
    name = f"{method.rpartition('/')[2].capitalize()}Params"
    own = {key: field for key, field in request.params.items() if snake(key) not in PREVIEW}
    options = {key: field for key, field in request.params.items() if snake(key) in PREVIEW}
    yield f'\nclass {name}(NamedTuple):\n    """The parameters of `{method}`."""\n'
    for key, field in own.items():
        wanted = "str" if field.is_ == "document" else _python_type(field)
        yield f"    {_python_name(key, field)}: {wanted.removesuffix(' | None') if _always(field) else wanted}"
    if options:
        yield "    options: RenderOptions"
    yield f'\n    @classmethod\n    def read(cls, params: Any) -> {name}:\n        """Raises JsonRpcInvalidParams."""'
    yield "        given = Given(params)\n        return cls("
    yield from (f"            {_python_name(key, field)}={_reading(key, field)}," for key, field in own.items())
    if options:
        yield "            options={"
        yield from (f'                "{snake(key)}": {_reading(key, field)},' for key, field in options.items())
        yield "            },"
    yield "        )\n"


def _python_name(key: str, field: Field) -> str:
    return "uri" if field.is_ == "document" else snake(key)


def _always(field: Field) -> bool:
    """Whether a parameter that may be missing has a value then."""
    return field.default is not None or not field.optional


def _reading(key: str, field: Field) -> str:
    match field.is_:
        case "document":
            return "given.uri()"
        case "token":
            return "given.token()"
        case "position":
            return f'given.position("{key}")'
        case "flag" if not _always(field):
            return f'given.flag("{key}") or None'
        case "flag":
            return f'given.flag("{key}")'
        case "number":
            return f'given.number("{key}", {field.default})'
        case "string":
            return f'given.text("{key}")'
        case "whole" if field.default is not None:
            return f'given.whole("{key}", {field.least}, {field.default})'
        case "whole" if field.optional:
            assert field.least > 0
            return f'given.whole("{key}", {field.least}, 0) or None'
        case "whole":
            return f'given.whole("{key}", {field.least})'
        case choice if choice in protocol().choices:
            values = ", ".join(map(_quoted, protocol().choices[choice][1]))
            return f'given.one_of("{key}", ({values}))'
        case _:
            raise TypeError(f"no parameter is read that is a {field.is_}")


def _python_type(field: Field) -> str:
    plain = {
        "string": "str",
        "whole": "int",
        "number": "float | None",
        "flag": "bool",
        "bytes": "str",
        "document": "types.TextDocumentIdentifier",
        "position": "types.Position",
        "range": "dict[str, Any]",
        "token": "types.ProgressToken",
    }

    def of(is_: str) -> str:
        found = _LIST.fullmatch(is_)
        return f"list[{of(found[1])}]" if found else plain.get(is_, is_)

    return f"{of(field.is_)} | None" if field.optional else of(field.is_)


# --- TypeScript -----------------------------------------------------------------------------------------------------


def _typescript(described: Protocol) -> Iterator[str]:
    yield f"/** What is said about previews. {_MADE}. */\n"
    yield "/** As they are, or as base64 where JSON is in between. */\nexport type Bytes = Uint8Array | string;\n"
    yield "export interface Position {\n  line: number;\n  character: number;\n}\n"
    yield "export interface Range {\n  start: Position;\n  end: Position;\n}\n"
    for name, (says, values) in described.choices.items():
        yield from _comment(says)
        yield f"export type {name} = {' | '.join(map(_quoted, values))};\n"
    for name, (says, fields) in described.objects.items():
        yield from _interface(name, says, fields, " | null")
    options = {camel(name): _option(option) for name, option in PREVIEW.items()}
    yield from _interface("RenderOptions", "What may be asked of a picture.", options)
    yield f"export const RENDER_OPTION_NAMES = [{', '.join(map(_quoted, options))}] as const;\n"
    yield "/** What is meant where an option is not given; one that is not here is then as the scene says. */"
    yield "export const RENDER_OPTIONS: RenderOptions = {"
    defaults = {name: field.default for name, field in options.items() if field.default is not None}
    yield from (f"  {name}: {str(default).lower()}," for name, default in defaults.items())
    yield "};\n"
    yield "/** Suffixes of the picture files that can be saved, by what a file dialog calls them. */"
    yield "export const PICTURE_FORMATS: Record<string, string[]> = {"
    for format_ in FORMATS:
        if format_.writer is not None:
            yield f'  "{format_.name}": [{", ".join(_quoted(suffix[1:]) for suffix in format_.suffixes)}],'
    yield "};\n"
    for method, request in described.requests.items():
        own = {key: field for key, field in request.params.items() if key not in options}
        base = " extends RenderOptions" if own != request.params else ""
        yield from _interface(f"{method.rpartition('/')[2].capitalize()}Params{base}", request.says, own)
    yield "/** The requests, by their methods. */\nexport interface Requests {"
    for method, request in described.requests.items():
        params = f"{method.rpartition('/')[2].capitalize()}Params"
        yield f'  "{method}": {{ params: {params}; answer: {request.answer} }};'
    yield "}\n\n/** The notifications, by their methods. */\nexport interface Notifications {"
    yield from (f'  "{method}": {params};' for method, params in described.notifications.items())
    yield "}\n"


def _interface(name: str, says: str, fields: Fields, nothing: str = "") -> Iterator[str]:
    """A type with the fields; one that may be missing may also be `nothing`."""
    yield from _comment(says)
    yield f"export interface {name} {{"
    for key, field in fields.items():
        yield from _comment(field.says, "  ")
        mark, more = ("?", nothing) if field.optional else ("", "")
        yield f"  {key}{mark}: {_typescript_type(field.is_)}{more};"
    yield "}\n"


def _typescript_type(is_: str) -> str:
    found = _LIST.fullmatch(is_)
    if found:
        inner = _typescript_type(found[1])
        return f"[{', '.join([inner] * int(found[2]))}]" if found[2] else f"{inner}[]"
    plain = {
        "whole": "number",
        "flag": "boolean",
        "bytes": "Bytes",
        "document": "{ uri: string }",
        "position": "Position",
        "range": "Range",
        "token": "string | number",
    }
    return plain.get(is_, is_)


def _comment(says: str, indent: str = "") -> Iterator[str]:
    line = f"{indent}/** {says} */"
    if len(line) <= 120:
        yield line
        return
    yield f"{indent}/**"
    yield from textwrap.wrap(says, 120, initial_indent=f"{indent} * ", subsequent_indent=f"{indent} * ")
    yield f"{indent} */"


# --- the page -------------------------------------------------------------------------------------------------------


def _docs(described: Protocol) -> Iterator[str]:
    yield f"\n{described.about}\n"
    yield "| request | parameters | answer |\n|---|---|---|"
    for method, request in described.requests.items():
        answer = " or ".join(_answer(part) for part in request.answer.split(" | "))
        yield f"| `{method}` | {_shape(request.params)} | {answer} |"
    yield "\n| notification | parameters |\n|---|---|"
    yield from (
        f"| `{method}` | [`{params}`](#{params.lower()}) |" for method, params in described.notifications.items()
    )
    yield f"\n{described.notes}\n"
    parameters: Fields = {}
    for request in described.requests.values():
        parameters |= {key: field for key, field in request.params.items() if key not in parameters}
    yield "### Parameters\n"
    yield from _field_rows(parameters)
    for name, (says, fields) in described.objects.items():
        yield f"\n### {name}\n\n{says}\n"
        yield from _field_rows(fields)
    yield "\n### Words\n\n| | one of | |\n|---|---|---|"
    for name, (says, values) in described.choices.items():
        yield f"| {name} | {', '.join(f'`{_quoted(value)}`' for value in values)} | {says} |"
    yield "\n"


def _answer(name: str) -> str:
    return name if name == "null" else f"[`{name}`](#{name.lower()})"


def _shape(fields: Fields) -> str:
    return f"`{{ {', '.join(f'{key}?' if field.optional else key for key, field in fields.items())} }}`"


def _field_rows(fields: Fields) -> Iterator[str]:
    yield "| field | is | |\n|---|---|---|"
    for key, field in fields.items():
        yield f"| `{key}{'?' if field.optional else ''}` | {field.is_} | {field.says} |"


if __name__ == "__main__":
    write(texts())
