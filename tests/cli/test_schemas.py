"""The schemas: of every command, of model files and manifests, strict enough."""

import copy
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from docsite.schemas import build_schemas, write_schemas
from modeler.cli import main
from modeler.cli.parser import read_commands
from modeler.core.manifest import FORMAT as MANIFEST_FORMAT
from modeler.estimation.model_file import FORMAT as MODEL_FORMAT
from tests.json_schemas import check_schema, faults
from tests.modules import module
from tests.texts import read_pairs

OTHERS = {"pictures": 1, "manifest": MANIFEST_FORMAT, "model": MODEL_FORMAT}

# What scripts read: names that must not change between versions. A list stands for its entries, {}
# for the entries of an object whose names are the user's.
EFFECT_AT = {"effect": 0, "joint": 0}
FIT = dict(
    robot=0,
    method=0,
    samples=0,
    condition_number=0,
    relative_error=0,
    joints={"": {"relative_error": 0, "rms": 0}},
    parameters=[{"name": 0, "value": 0, "sigma": 0, "relative_sigma_percent": 0, "essential": 0}],
    valid=0,
    warnings=0,
    bands={"noise": 0, "reasons": 0},
)
CONTRACT = {
    "derive": {
        "robot": 0,
        "standard": 0,
        "base": [{"name": 0, "column_of": 0, "terms": [{"coefficient": 0, "parameter": 0}]}],
        "unidentifiable": 0,
        "rank": 0,
        "counts": {"inertial": 0, "rotor_inertia": 0, "friction": 0, "offset": 0},
        "rank_gap": 0,
        "proof": 0,
    },
    "fit": FIT,
    "compare": dict(
        samples=0, relative_error=0, joints={"": {"relative_error": 0, "rms": 0, "max": 0, "r2": 0}}
    ),
    "diagnose": {
        "verdict": 0,
        "effects": [
            read_pairs("""
                effect 0 joint 0 status 0 gain 0 error_before 0 error_after 0 parameters 0 ties 0
                evidence 0 splits 0
            """)
        ],
        "undetectable": [EFFECT_AT],
        "joints": 0,
    },
    "add": {**FIT, "waterfall": [{"effect": 0, "joint": 0, "error": 0}]},
}


@pytest.fixture(scope="module")
def results(axis: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What five commands write of a machine that has a spring its robot file lacks."""
    out = tmp_path_factory.mktemp("schemas")
    a, b, m, n = axis / "a.csv", axis / "b.csv", axis / "m.json", out / "n.json"
    table: dict[str, Any] = {}
    for line in (
        "derive emps",
        f"fit emps {a} --out {out}/m.json",
        f"compare {m} {b}",
        f"diagnose {m} {a} --holdout {b}",
        f"add {m} spring {a} --holdout {b} --out {n}",
    ):
        command, place = line.split()[0], out / "result.json"
        assert main([*line.split(), "--json", str(place)]) == 0
        table[command] = json.loads(place.read_text())
    return table


def without(content: Any, fixed: Any) -> Iterator[tuple[str, Any]]:
    """The content once for each name that is fixed, which is called otherwise there."""
    if isinstance(fixed, list):
        assert content, "nothing to try it on"
        for name, changed in without(content[0], fixed[0]):
            yield name, [changed, *content[1:]]
    elif isinstance(fixed, dict):
        names = {next(iter(content)): fixed[""]} if "" in fixed else fixed
        for name, below in names.items():
            if "" not in fixed:
                yield name, {f"new_{k}" if k == name else k: v for k, v in content.items()}
            for deeper, changed in without(content[name], below):
                yield f"{name}/{deeper}", {**content, name: changed}


@pytest.mark.rotating("long tests of cli")
@pytest.mark.parametrize("command", CONTRACT)
def test_a_renamed_field_is_noticed(results, command: str) -> None:
    content = results[command]
    check_schema(command, {**content, "further": {"entries": "may come"}})
    assert content["schema"] == build_schemas()[command]["$id"]
    assert faults(command, {**content, "schema": f"urn:modeler:schema:{command}:2"})
    tried = 0
    for name, changed in without(copy.deepcopy(content), CONTRACT[command]):
        assert faults(command, changed), f"{command}: {name} may be missing"
        tried += 1
    assert tried >= len(CONTRACT[command])


def test_a_model_file_is_as_its_schema_says(axis: Path) -> None:
    raw = json.loads((axis / "m.json").read_text(encoding="utf-8"))
    check_schema("model", raw)
    for name in ("fit", "covariance", "robot_text", "manifest", "logs", "format"):
        assert faults("model", {k: v for k, v in raw.items() if k != name})


def test_manifests_are_as_their_schema_says() -> None:
    for name in ("wrist", "five-bar", "emps", "two-link"):
        raw = json.loads(module(name).emitted.files["manifest.json"])
        check_schema("manifest", raw)
        assert faults("manifest", {k: v for k, v in raw.items() if k != "base"})


def test_every_command_has_a_schema_and_every_schema_is_one(tmp_path: Path) -> None:
    write_schemas(tmp_path)
    versions = {**dict.fromkeys(read_commands(), 1), **OTHERS}
    assert build_schemas().keys() == versions.keys()
    for name, version in versions.items():
        schema = build_schemas()[name]
        Draft202012Validator.check_schema(schema)
        assert schema["$id"] == f"urn:modeler:schema:{name}:{version}" and schema["title"]
        assert json.loads((tmp_path / f"{name}.json").read_text(encoding="utf-8")) == schema
