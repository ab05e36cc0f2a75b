"""What a version promises (docs/reference/versions.md): names stay."""

import inspect
import json
from typing import Any

from docsite.commands import commands
from modeler import api
from modeler.codegen.package import C_INTERFACE
from modeler.core.choices import ABOUT, EFFECTS
from modeler.core.manifest import FORMAT as MANIFEST_FORMAT
from modeler.estimation.model_file import FORMAT as MODEL_FORMAT
from modeler.robot.read import _KEYS
from tests.repository import ROOT

KEPT = ROOT / "tests" / "promised.json"
"""Names that users type or write; `--regenerate` adds new ones and takes none away."""


def offered() -> dict[str, dict[str, list[str]]]:
    """{kind: {name: names in it}} of this version."""
    python = {name: sorted(_parameters(getattr(api, name))) for name in api.__all__}
    typed = {
        name: sorted(option for action in parser._actions for option in action.option_strings)
        for name, parser in commands().items()
    }
    words = {"effects": EFFECTS, "estimators": ABOUT, "keys of a robot file": _KEYS.split()}
    return {
        "python": python,
        "commands": typed,
        "words": {kind: sorted(names) for kind, names in words.items()},
    }


def _parameters(thing: Any) -> list[str]:
    """Of a function its arguments, of a class its public names."""
    if inspect.isclass(thing):
        names = {*dir(thing), *getattr(thing, "__dataclass_fields__", ())}
        return [name for name in names if not name.startswith("_")]
    return list(inspect.signature(thing).parameters) if callable(thing) else []


def _written(names: dict[str, dict[str, list[str]]]) -> str:
    """JSON, a line for each name."""
    parts = [
        f"{json.dumps(kind)}: {{\n"
        + ",\n".join(f" {json.dumps(name)}: {json.dumps(each)}" for name, each in inner.items())
        + "\n}"
        for kind, inner in names.items()
    ]
    return "{" + ",\n".join(parts) + "}\n"


def test_no_name_that_was_promised_is_gone(regenerate: bool) -> None:
    """A name that goes is taken out of `promised.json` by hand, a version after it was replaced."""
    promised, now = json.loads(KEPT.read_text(encoding="utf-8")), offered()
    gone = [
        f"{kind}: {name} {each}"
        for kind, names in promised.items()
        for name, inner in names.items()
        for each in ("", *inner)
        if name not in now[kind] or each not in {"", *now[kind][name]}
    ]
    assert not gone, "\n".join(["promised, and gone:", *gone])
    if regenerate:
        merged = {
            kind: {
                name: sorted({*promised.get(kind, {}).get(name, ()), *inner})
                for name, inner in sorted(names.items())
            }
            for kind, names in now.items()
        }
        KEPT.write_text(_written(merged), encoding="utf-8")
        promised = merged
    new = [
        f"{kind}: {name} {each}"
        for kind, names in now.items()
        for name, inner in names.items()
        for each in inner
        if each not in promised.get(kind, {}).get(name, ())
    ]
    assert not new, "\n".join(["new names are a promise: run `make regenerate`", *new])


def test_the_page_tells_the_numbers_of_this_version() -> None:
    text = (ROOT / "docs" / "reference" / "versions.md").read_text(encoding="utf-8")
    for message, number in (
        ("C interface", C_INTERFACE),
        ("model format", MODEL_FORMAT),
        ("manifest format", MANIFEST_FORMAT),
    ):
        assert f"{message} {number}" in text, message
