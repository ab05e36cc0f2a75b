"""Manifests that are not what they should be."""

import json
import re

import pytest

from modeler.core.contract import FORMAT, module_from_json
from modeler.core.errors import ManifestError
from tests.modules import module


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("{", "x.json: not JSON"),
        ("[]", "x.json: not a manifest"),
        ('{"robot": "wrist"}', "x.json: not a manifest"),
        (
            json.dumps({"format": FORMAT + 1}),
            f"format {FORMAT + 1}, expected {FORMAT}; generate it",
        ),
        (json.dumps({"format": FORMAT, "robot": "wrist"}), "x.json: damaged manifest"),
    ],
)
def test_what_is_no_manifest_is_refused(text, says):
    with pytest.raises(ManifestError, match=re.escape(says)):
        module_from_json(text, "x.json")


def test_any_change_of_the_manifest_changes_its_signature():
    spec = module("wrist").emitted.spec
    raw = json.loads(spec.to_json())
    raw["joints"][1]["unit"] = "m"
    changed = module_from_json(json.dumps(raw), "x.json")
    assert changed.signature() != spec.signature()


def test_nonzeros_are_ordered_row_after_row():
    spec = module("sr400-tree").emitted.spec
    assert list(spec.nonzeros) == sorted(spec.nonzeros)
    for joint, column in spec.nonzeros:
        assert joint in spec.base[column].rows
