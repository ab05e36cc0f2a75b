"""Quick cases of the suite: what is hidden is named, on its joint; nothing is, if nothing is.

The whole suite is a program: `python -m tests.hidden_effects --help`.
"""

import json

import pytest

from tests.hidden_effects.case import Case
from tests.hidden_effects.suite import DEVELOPMENT, run

SLOW = pytest.mark.slow
CASES = [
    pytest.param(Case(("stribeck",), "med", 3, "2R"), marks=SLOW),
    pytest.param(Case(("load_friction",), "med", 1, "2R"), marks=SLOW),
    pytest.param(Case(("payload",), "med", 1, "2R"), marks=SLOW),
    Case(("spring",), "med", 1, "2R"),
    pytest.param(Case((), "med", 1, "2R"), marks=pytest.mark.rotating),
]


@pytest.mark.rotating("long tests of hidden_effects")
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_what_is_hidden_is_found(case, tmp_path, plant_compiler):
    assert case.seed in DEVELOPMENT
    lines = []
    (score,) = run([case], tmp_path, tell=lines.append)
    assert not score.error
    assert score.exact and score.first == bool(case.effects), score
    assert score.stated == bool(case.effects), score
    truth = json.loads((tmp_path / "cases" / case.name / "truth.json").read_text())
    assert [hidden["effect"] for hidden in truth["hidden"]] == list(case.effects)
    # Done once, it is not done again.
    assert run([case], tmp_path, tell=lines.append) == [score]
    assert lines == [score]


@SLOW
def test_what_is_in_no_catalogue_is_not_stated(tmp_path, plant_compiler):
    (score,) = run([Case(("lifting_seal",), "low", 1, "2R")], tmp_path, tell=lambda score: None)
    assert not score.error and score.visible >= 1
    assert score.verdict in ("closest description", "unexplained"), score
