"""Scores and the page of them, from answers made up."""

import json

import pytest

from tests.hidden_effects.__main__ import cases_of, parser
from tests.hidden_effects.effects import EFFECTS
from tests.hidden_effects.held_out_effects import HELD_OUT_EFFECTS
from tests.hidden_effects.score import failed, score_from_json, scored
from tests.hidden_effects.suite import ACCEPTANCE, DEVELOPMENT, pair_cases
from tests.hidden_effects.table import page


def truth(*hidden, visible=1.0, noise="med"):
    named = [{"effect": e, "joint": j, "values": v} for e, j, v in hidden]
    return {"hidden": named, "visible": [visible] * len(named), "noise": noise, "robot": "3R"}


def finding(effect, joint, ties=()):
    tied = [{"effect": e, "joint": j} for e, j in ties]
    errors = {"error_before": 0.10, "error_after": 0.04}
    return {"effect": effect, "joint": joint, "ties": tied, **errors}


def said(*findings):
    verdict = "missing" if findings else "nothing significant"
    return {"effects": list(findings), "verdict": verdict, "seconds": 1.0}


SPRING = ("spring", "2", {})
COUPLED = ("coupled_friction", "2", {"with_joint": "3"})
DELAY = ("time_delay", None, {})

#                    truth, said, first, joint, tied, exact
ANSWERS = {
    "right": ([SPRING], [finding("spring", "2")], 1, 1, 1, 1),
    "other joint": ([SPRING], [finding("spring", "1")], 0, 0, 0, 0),
    "other effect": ([SPRING], [finding("offset", "2")], 0, 1, 0, 0),
    "tied": ([SPRING], [finding("drift", "2", [("spring", "2")])], 0, 1, 1, 0),
    "tied elsewhere": ([SPRING], [finding("drift", "2", [("spring", "3")])], 0, 1, 0, 0),
    "second": ([SPRING], [finding("drift", "1"), finding("spring", "2")], 0, 0, 0, 0),
    "one too many": ([SPRING], [finding("spring", "2"), finding("drift", "1")], 1, 1, 1, 0),
    "silent": ([SPRING], [], 0, 0, 0, 0),
    "either joint": ([COUPLED], [finding("coupled_friction", "3")], 1, 1, 1, 1),
    "its own joint": ([COUPLED], [finding("coupled_friction", "2")], 1, 1, 1, 1),
    "whole robot": ([DELAY], [finding("time_delay", None)], 1, 1, 1, 1),
    "clean": ([], [], 0, 0, 0, 1),
    "false alarm": ([], [finding("spring", "2")], 0, 0, 0, 0),
    "two": ([SPRING, DELAY], [finding("time_delay", None), finding("spring", "2")], 1, 1, 1, 1),
    "one of two": ([SPRING, DELAY], [finding("time_delay", None)], 1, 1, 1, 0),
}


@pytest.mark.parametrize("case", ANSWERS)
def test_an_answer_is_scored(case):
    """And how much it lowers the error, and how well the effect can be seen."""
    hidden, findings, *expected = ANSWERS[case]
    score = scored(case, truth(*hidden), said(*findings))
    assert [score.first, score.joint, score.tied, score.exact] == [bool(x) for x in expected]
    assert score_from_json(json.loads(json.dumps(score.to_json()))) == score
    assert score.fall == (pytest.approx(0.6) if findings else None)
    hard = scored(case, truth(*hidden, visible=0.5, noise="high"), said(*findings))
    assert hard.detectable is not bool(hidden)


def test_an_error_is_no_answer_even_where_nothing_is_hidden():
    score = failed("a", truth(), "DataError: no rows")
    assert not score.exact and "no rows" in page([score])


def test_the_page_counts():
    scores = [
        scored("spring-med-1", truth(SPRING), said(finding("spring", "2"))),
        scored("spring-med-2", truth(SPRING), said(finding("drift", "2", [("spring", "2")]))),
        scored("spring-high-1", truth(SPRING, visible=0.5, noise="high"), said()),
        scored("none-med-1", truth(), said()),
        scored("none-med-2", truth(), said(finding("spring", "2"))),
        scored("pair", truth(SPRING, DELAY), said(finding("spring", "2"), finding("drift", "1"))),
    ]
    text = page(scores)
    assert "| spring | 1/2 | 1/2 | 2/2 | 2/2 | 1/2 | 60 % |" in text
    assert "| **share** | 50.0 % | 50.0 % | 100.0 % | 100.0 % | 50.0 % | 60 % |" in text
    assert "| False alarms | 1/2 | 1/2 |" in text
    assert "| med | 1/1 | 0/1 | 0/1 | 1.00 |" in text
    misses, hard = text.split("## Misses")[1].split("## Undetectable")
    assert misses.count("\n- ") == 3 and "tied with what is hidden" in misses
    assert "- none-med-2" in misses and "- spring-high-1" in hard


HELD_OUT = ("dead_band", "2", {})
VERDICTS = {
    "missing": ([finding("coulomb", "2")], False),
    "closest description": ([finding("coulomb", "2")], True),
    "unexplained": ([], True),
    "nothing significant": ([], True),
}


def of_held_out(verdict, cause=HELD_OUT):
    findings, _ = VERDICTS[verdict]
    return scored(f"{cause[0]}-{verdict}", truth(cause), said(*findings) | {"verdict": verdict})


def test_of_a_cause_outside_the_catalogue_nothing_may_be_stated():
    for verdict, (_, right) in VERDICTS.items():
        score = of_held_out(verdict)
        assert score.held_out and score.right == right
    assert not scored("a", truth(SPRING), said()).held_out
    assert not failed("a", truth(HELD_OUT), "DataError: no rows").right


def test_the_page_has_a_row_for_every_cause_outside_the_catalogue():
    scores = [of_held_out(verdict) for verdict in VERDICTS]
    scores += [of_held_out("unexplained", ("hose_across", "1", {"with_joint": "2"}))]
    text = page(scores)
    assert "| dead_band | 1/4 | 1/4 | 1/4 | 1/4 |" in text
    assert "| hose_across | 0/1 | 0/1 | 1/1 | 0/1 |" in text
    assert "| **all** | 1/5 | 1/5 | 2/5 | 1/5 |" in text
    assert "## One effect" not in text and "## Two effects" not in text
    misses, _ = text.split("## Misses")[1].split("## Undetectable")
    assert misses.count("\n- ") == 1 and "- dead_band-missing" in misses


def cases(*arguments):
    return cases_of(parser().parse_args(arguments))


def test_seeds_are_for_development_or_for_acceptance():
    assert not set(DEVELOPMENT) & set(ACCEPTANCE)
    assert {case.seed for case in cases("--effects", "spring")} <= set(DEVELOPMENT)
    accepted = cases("--effects", "spring", "--acceptance", "--two", "4", "--clean", "5")
    assert {case.seed for case in accepted} <= set(ACCEPTANCE)
    assert len(accepted) == 3 * (3 + 4 + 5)
    names = [case.name for case in cases("--two", "30", "--clean", "30")]
    assert len(names) == len(set(names))
    pairs = [set(case.effects) for case in pair_cases(["med"], [*DEVELOPMENT, *ACCEPTANCE])]
    assert all(len(pair) == 2 and pair != {"elasticity", "backlash"} for pair in pairs)
    held_out = cases("--effects", "none", "--noise", "low,med", "--held-out", "2")
    assert {case.effects for case in held_out} == {(name,) for name in HELD_OUT_EFFECTS}
    assert len(held_out) == 4 * len(HELD_OUT_EFFECTS)
    others = cases("--two", "30", "--clean", "3", "--withheld", "30")
    assert {name for case in others for name in case.effects} <= EFFECTS.keys()
    with pytest.raises(SystemExit, match="or --acceptance"):
        cases("--seeds", "1001")
    with pytest.raises(SystemExit, match="unknown: sprong"):
        cases("--effects", "sprong")
