"""The schemas of docs/schema, and whether what commands write for machines is as they say."""

import json
from functools import cache
from typing import Any

from jsonschema import Draft202012Validator
from referencing import Registry, Resource

from tests.repository import ROOT

FOLDER = ROOT / "docs" / "schema"


@cache
def schemas() -> dict[str, dict[str, Any]]:
    """{name of the file: schema}."""
    return {p.stem: json.loads(p.read_text(encoding="utf-8")) for p in FOLDER.glob("*.json")}


@cache
def validator(name: str) -> Draft202012Validator:
    """Of one file; it finds the others by their `$id`."""
    resources = [(each["$id"], Resource.from_contents(each)) for each in schemas().values()]
    registry: Registry[Any] = Registry().with_resources(resources)
    return Draft202012Validator(schemas()[name], registry=registry)


def faults(name: str, content: Any) -> list[str]:
    """Where content is not as the schema says; of alternatives, of each."""
    return [
        f"{name}: {'/'.join(map(str, leaf.absolute_path)) or 'the whole'}: {leaf.message[:200]}"
        for error in validator(name).iter_errors(content)
        for leaf in (error.context or [error])
    ]


def check_schema(name: str, content: Any) -> None:
    """Fails with what is wrong."""
    breaks = faults(name, content)
    assert not breaks, "\n".join(["docs/schema says otherwise", *breaks[:10]])
