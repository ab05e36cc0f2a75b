"""Whether what commands write for machines is as the schemas say that are made of its types."""

from functools import cache
from typing import Any

from jsonschema import Draft202012Validator

from docsite.schemas import build_schemas


@cache
def validator(name: str) -> Draft202012Validator:
    """Of one schema."""
    return Draft202012Validator(build_schemas()[name])


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
    assert not breaks, "\n".join(["its schema says otherwise", *breaks[:10]])
