"""Quick cases of the suite: what is hidden is named, on its joint; nothing is, if nothing is.

The whole suite is a program: `python -m tests.hidden_effects --help`.
"""

import json

import pytest

from tests.hidden_effects.case import Case
from tests.hidden_effects.suite import DEVELOPMENT, run

CASES = {
    "stribeck": Case(("stribeck",), "med", 3, "2R"),
    "load_friction": Case(("load_friction",), "med", 1, "2R"),
    "spring": Case(("spring",), "med", 1, "2R"),
    "payload": Case(("payload",), "med", 1, "2R"),
    "none": Case((), "med", 1, "2R"),
}


@pytest.mark.parametrize("name", CASES)
def test_what_is_hidden_is_found(name, tmp_path, plant_compiler):
    case = CASES[name]
    assert case.seed in DEVELOPMENT
    told = []
    (score,) = run([case], tmp_path, tell=told.append)
    assert not score.error
    assert score.exact and score.first == bool(case.effects), score
    assert score.stated == bool(case.effects), score
    truth = json.loads((tmp_path / "cases" / case.name / "truth.json").read_text())
    assert [hidden["effect"] for hidden in truth["hidden"]] == list(case.effects)
    # Done once, it is not done again.
    assert run([case], tmp_path, tell=told.append) == [score]
    assert told == [score]


@pytest.mark.parametrize("stranger", ["lifting_seal"])
def test_what_is_in_no_catalogue_is_not_stated(stranger, tmp_path, plant_compiler):
    (score,) = run([Case((stranger,), "low", 1, "2R")], tmp_path, tell=lambda score: None)
    assert not score.error
    assert score.verdict in ("closest description", "unexplained"), score
