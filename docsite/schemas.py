"""JSON schemas of what commands write, model files, manifests and pictures, made from types.

Keys come from the fields of a class, or from its `KEYS`; their types from annotations, their
descriptions from the class's "Attributes:", from comments behind fields, from properties.
"""

import dataclasses
import enum
import inspect
import json
import re
import sys
import types
from collections.abc import Collection, Mapping
from functools import cache, cached_property
from pathlib import Path
from typing import Any, ClassVar, Literal, Union, get_args, get_origin, get_type_hints, is_typeddict

import numpy as np

from modeler import (
    diagnosis,
    estimation,
    formats,
    formulas,
    logs,
    papers,
    regression,
    simulation,
    validation,
)
from modeler.cli.console import SCHEMA
from modeler.cli.documents import StudioAddress
from modeler.cli.parser import import_run, read_commands
from modeler.core.figure import PictureFile
from modeler.core.json import parse_keys
from modeler.core.manifest import FORMAT as MANIFEST_FORMAT, ModuleSpec
from modeler.estimation.model_file import FORMAT as MODEL_FORMAT, ModelFile

Schema = dict[str, Any]

FILES: Mapping[str, tuple[int, type, str]] = {
    "manifest": (MANIFEST_FORMAT, ModuleSpec, "manifest.json of emitted C"),
    "model": (MODEL_FORMAT, ModelFile, "a model file of modeler fit"),
    "pictures": (1, PictureFile, "modeler ... --picture FILE.json"),
}
"""Schemas of files: version, what they hold, title."""

_NAMES = {
    name: getattr(package, name)
    for package, names in (
        (diagnosis, "Diagnosis"),
        (estimation, "Addition FitResult MethodResult"),
        (formats, "Exported"),
        (formulas, "CadRow Explanation KnownAgainstFit RatedSet"),
        (logs, "LogInspection Mark"),
        (papers, "CheckedLine MethodTable"),
        (regression, "Bands"),
        (simulation, "HiddenEffect"),
        (validation, "Comparison Fleet FreeRun ModelErrors"),
    )
    for name in names.split()
} | {"validation": validation}
"""Classes that modules of commands name, and load when they are needed."""

_SIMPLE: Mapping[Any, Schema] = {
    str: {"type": "string"},
    int: {"type": "integer"},
    float: {"type": ["number", "null"]},  # null: not finite, or it means nothing
    bool: {"type": "boolean"},
    type(None): {"type": "null"},
    Any: {},
    object: {},
    np.ndarray: {"type": "array"},
}


@cache
def build_schemas() -> Mapping[str, Schema]:
    """Returns {name: schema} of every command and file."""
    schemas = {
        name: _build_schema(name, version, title, kind)
        for name, (version, kind, title) in FILES.items()
    }
    for name, command in read_commands().items():
        hint = get_type_hints(import_run(command["run"]), localns=_NAMES)["return"]
        hint = StudioAddress if name == "studio" else hint  # it writes before it serves
        schemas[name] = _build_schema(name, SCHEMA, f"modeler {name} --json", hint, is_result=True)
    return schemas


def schema_files() -> dict[str, str]:
    """Returns {"schema/fit.json": text} of every schema."""
    return {
        f"schema/{name}.json": json.dumps(schema, indent=1, ensure_ascii=False) + "\n"
        for name, schema in build_schemas().items()
    }


def write_schemas(folder: Path) -> None:
    """Writes every schema into a folder, as `fit.json`."""
    folder.mkdir(parents=True, exist_ok=True)
    for path, text in schema_files().items():
        (folder / Path(path).name).write_text(text, encoding="utf-8")


def _build_schema(
    name: str, version: int, title: str, hint: Any, is_result: bool = False
) -> Schema:
    identifier = f"urn:modeler:schema:{name}:{version}"
    definitions: dict[str, Schema] = {}
    body = _describe(hint, definitions)
    if is_result:  # an object says which schema it has; a list does not
        stated = {"required": ["schema"], "properties": {"schema": {"const": identifier}}}
        body = {"if": {"type": "object"}, "then": stated, "allOf": [body]}
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": identifier}
    return {**head, "title": title, **body, "$defs": definitions}


def _describe(hint: Any, definitions: dict[str, Schema]) -> Schema:
    """Returns the schema of a type; those of classes go into the definitions."""
    origin, arguments = get_origin(hint), get_args(hint)
    if hint is Any or hint in _SIMPLE:
        return dict(_SIMPLE[hint])
    if origin in (Union, types.UnionType):
        return _merge([_describe(option, definitions) for option in arguments])
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin is tuple and arguments[1:] != (Ellipsis,):
        items = _merge([_describe(argument, definitions) for argument in arguments])
        return {"type": "array", "items": items, **_fix_length(len(arguments))}
    if isinstance(origin, type) and issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": _describe(arguments[1], definitions)}
    if isinstance(origin, type) and issubclass(origin, Collection):
        return {"type": "array", "items": _describe(arguments[0], definitions)}
    if isinstance(hint, type) and issubclass(hint, enum.Enum):
        return {"enum": [member.value for member in hint]}
    return _refer(hint, definitions)


def _fix_length(count: int) -> Schema:
    return {"minItems": count, "maxItems": count}


def _merge(options: list[Schema]) -> Schema:
    """Returns the schema of what is as one of the options says."""
    different = [option for k, option in enumerate(options) if option not in options[:k]]
    if {} in different or not different:
        return {}
    if all(option.keys() == {"type"} for option in different):
        kinds = [np.atleast_1d(option["type"]).tolist() for option in different]
        names = list(dict.fromkeys(name for kind in kinds for name in kind))
        return {"type": names[0] if len(names) == 1 else names}
    return different[0] if len(different) == 1 else {"anyOf": different}


def _refer(kind: type, definitions: dict[str, Schema]) -> Schema:
    if kind.__name__ not in definitions:
        definitions[kind.__name__] = {}  # it may hold itself
        definitions[kind.__name__] = _describe_class(kind, definitions)
    return {"$ref": f"#/$defs/{kind.__name__}"}


def _describe_class(kind: type, definitions: dict[str, Schema]) -> Schema:
    text = (inspect.getdoc(kind) or "").partition("\n")[0]
    keys = parse_keys(getattr(kind, "KEYS", ""))
    if not keys and "to_json" in vars(kind):  # it writes another class, or what nobody declares
        hint = get_type_hints(kind.to_json, localns=_NAMES)["return"]  # type: ignore[attr-defined]
        if hint is not str:
            return {"description": text, **_describe(hint, definitions)}
    members = _list_members(kind)
    properties = {
        key: ({"description": said} if said else {}) | _describe(hint, definitions)
        for key, (hint, said, _) in members.items()
    }
    required = [key for key, (_, _, is_required) in members.items() if is_required]
    return {"type": "object", "description": text, "required": required, "properties": properties}


def _list_members(kind: type) -> dict[str, tuple[Any, str, bool]]:
    """Returns {key: its type, what is said of it, whether it is always there}."""
    said = _read_descriptions(kind)
    keys = parse_keys(getattr(kind, "KEYS", ""))
    if not keys:
        required, hints = _list_required(kind), get_type_hints(kind, localns=_NAMES)
        return {
            name: (hint, said.get(name, ""), name in required)
            for name, hint in hints.items()
            if get_origin(hint) is not ClassVar
        }
    members: dict[str, tuple[Any, str, bool]] = {}
    for key, path in keys.items():
        hint = _find_hint(kind, path)
        if not key.startswith("*"):
            members[key] = (hint, said.get(key) or said.get(path, ""), True)
            continue
        options = get_args(hint) if get_origin(hint) in (Union, types.UnionType) else (hint,)
        for option in options:  # of a mapping nobody says what it holds
            if isinstance(option, type) and option is not type(None):
                inner = _list_members(option)
                always = type(None) not in options
                members |= {k: (h, s, r and always) for k, (h, s, r) in inner.items()}
    return members


def _list_required(kind: type) -> list[str]:
    if is_typeddict(kind):
        return sorted(kind.__required_keys__)  # type: ignore[attr-defined]
    missing, is_partial = dataclasses.MISSING, "to_json" in vars(kind)  # without what is usual
    return [
        field.name
        for field in dataclasses.fields(kind)
        if (field.default is field.default_factory is missing if is_partial
            else field.default is not None)
    ]  # fmt: skip


def _find_hint(kind: Any, path: str) -> Any:
    """Returns the type of `a.b[c]`: None may stand where a part of the path is None."""
    path, _, index = path.partition("[")
    options: set[Any] = set()
    for name in path.split("."):
        given = get_args(kind) if get_origin(kind) in (Union, types.UnionType) else (kind,)
        options |= {type(None)} & set(given)
        (kind,) = (option for option in given if option is not type(None))
        kind = _find_attribute_hint(kind, name)
    if index:
        kind = Mapping[str, get_args(kind)[0]]  # type: ignore[misc]
    return Union[(kind, *options)] if options else kind


def _find_attribute_hint(kind: type, name: str) -> Any:
    member = inspect.getattr_static(kind, name, None)
    reader = getattr(member, "fget", None) or getattr(member, "func", None)
    if isinstance(member, property | cached_property):
        return get_type_hints(reader, localns=_NAMES)["return"]
    return get_type_hints(kind, localns=_NAMES)[name]


def _read_descriptions(kind: type) -> dict[str, str]:
    """Returns {attribute: what its class, the comment behind it or its own docstring says}."""
    described: dict[str, str] = {}
    for base in reversed(kind.__mro__[:-1]):
        block = re.search(r"\nAttributes:\n((?:    .*\n|\n)*)", (inspect.getdoc(base) or "") + "\n")
        entries = re.split(r"\n    (?=\w)", "\n" + block[1]) if block else []
        for names, _, text in (entry.partition(":") for entry in entries):
            words = " ".join(text.split())
            described |= {name.strip(): words for name in names.split(",")}
        if dataclasses.is_dataclass(base):
            comments = re.findall(
                r"^    (\w+): .*?  # (.*)$", inspect.getsource(base), re.MULTILINE
            )
            described |= dict(comments)
        for name, member in vars(base).items():
            if isinstance(member, property | cached_property):
                described[name] = (member.__doc__ or "").partition("\n")[0].removeprefix("Returns ")
    return described


if __name__ == "__main__":
    write_schemas(Path(sys.argv[1]))
