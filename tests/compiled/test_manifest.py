"""Manifests that are not what they should be."""

import json
import re

import pytest

from modeler.codegen.package import write_emitted
from modeler.core.errors import ManifestError
from modeler.core.manifest import FORMAT, parse_manifest
from modeler.runtime.model import load_folder
from tests.modules import module
from tests.rotation import rotating, with_cases


@with_cases(
    "text, says",
    ("{", "x.json: is not JSON, or cut off"),
    ('{"format": 1' + 10_000 * "0" + "}", "x.json: has a whole number of 10001 digits"),
    (b"\xff\xfe{\x00", "x.json: is UTF-16, UTF-32 or binary"),
    (json.dumps({"format": 1}), f"format 1, expected {FORMAT}; generate it again"),
    (json.dumps({"format": ["x" * 9999]}), "format ['xxxxxx"),
    ("[]", "x.json: not a manifest"),
    ('{"robot": "wrist"}', "x.json: not a manifest"),
    (json.dumps({"format": FORMAT, "robot": "wrist"}), "x.json: damaged manifest"),
)
def test_what_is_no_manifest_is_refused(text, says):
    with pytest.raises(ManifestError, match=re.escape(says)):
        parse_manifest(text, "x.json")


WRONG = {
    "robot": (3, "robot is 3, expected text"),
    "symbols": ({}, "symbols is {}, expected a list"),
    "joints": ([{"name": "1"}], "joints[0].kind is missing"),
    "closure": ([1], "closure is [1], expected an object"),
    "extra": (1, "'extra' is unknown"),
    "unidentifiable": ([1.5], "unidentifiable[0] is 1.5, expected text"),
}


@pytest.mark.parametrize("entry", WRONG)
def test_an_entry_of_another_type_is_named(entry):
    raw = json.loads(module("wrist").emitted.spec.to_json())
    raw[entry], says = WRONG[entry]
    with pytest.raises(ManifestError, match=re.escape(f"x.json: damaged manifest ({says})")):
        parse_manifest(json.dumps(raw), "x.json")
    del raw[entry]
    if entry not in ("closure", "extra"):
        with pytest.raises(ManifestError, match=re.escape(f"({entry} is missing)")):
            parse_manifest(json.dumps(raw), "x.json")


@pytest.mark.parametrize("value", ["3", *rotating(True, None, 10**400)])
def test_every_entry_of_a_manifest_is_checked(value):
    """Whatever stands in the place of any entry, at any depth: read as it was, or refused."""
    text = module("five-bar").emitted.spec.to_json()
    for path in leaves(json.loads(text)):
        raw = json.loads(text)
        inner = raw
        for key in path[:-1]:
            inner = inner[key]
        inner[path[-1]] = value
        try:
            spec = parse_manifest(json.dumps(raw), "x.json")
        except ManifestError as error:
            assert str(error).startswith("x.json: ") and "\n" not in str(error)
            assert len(str(error)) < 300
        else:
            assert (spec.to_json() == text) == (raw == json.loads(text))
            assert parse_manifest(spec.to_json(), "y.json") == spec


@with_cases(
    "name, content, says",
    ("manifest.json", b"", "manifest.json: is empty; generate it again"),
    ("manifest.json", b"PAR1\xff\x00", "manifest.json: is not valid UTF-8"),
    ("manifest.json", b"[" * 100_000, "manifest.json: is nested too deep"),
    ("emps.c", b"\xff\xfe\x00", "emps.c: no text; generate it again"),
    ("emps_regressor.c", None, "emps: the module lacks emps_regressor.c; generate it again"),
)
def test_a_damaged_folder_says_which_file(tmp_path, name, content, says):
    write_emitted(module("emps").emitted, tmp_path)
    (tmp_path / name).unlink()
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(ManifestError, match=re.escape(says)) as error:
        load_folder(tmp_path)
    assert "\n" not in str(error.value)


def leaves(raw, above=()):
    """Paths to all entries, lists and objects included; of long lists the first two entries."""
    keys = raw if isinstance(raw, dict) else range(min(len(raw), 2))
    for key in keys:
        yield (*above, key)
        if isinstance(raw[key], dict | list):
            yield from leaves(raw[key], (*above, key))


def test_any_change_of_the_manifest_changes_its_signature():
    spec = module("wrist").emitted.spec
    raw = json.loads(spec.to_json())
    raw["joints"][1]["unit"] = "m"
    assert parse_manifest(json.dumps(raw), "x.json").compute_signature() != spec.compute_signature()
