"""Scores of answers, the page of them, and which cases there are: from answers made up."""

import json

import pytest

from tests.hidden_effects.__main__ import cases_of, parser
from tests.hidden_effects.effects import EFFECTS
from tests.hidden_effects.held_out_effects import HELD_OUT_EFFECTS
from tests.hidden_effects.score import failed, score_from_json, scored
from tests.hidden_effects.sensor_kinds import FINE, SENSORS
from tests.hidden_effects.suite import ACCEPTANCE, DEVELOPMENT, cases_with
from tests.hidden_effects.table import page


def truth(*hidden, visible=1.0, noise="med", sensor=FINE):
    """Of effects: name, joint and a second joint; a sensor's fault is on joint 2."""
    named = [
        {"effect": e, "joint": j, "values": dict(zip(["with_joint"], more, strict=False))}
        for e, j, *more in hidden
    ]
    of_joint = {"joint": "2"} if SENSORS[sensor].of_joint else {}
    seen, by = [visible] * len(named), {"kind": sensor} | of_joint
    return dict(hidden=named, visible=seen, noise=noise, robot="3R", sensor=by)


def said(*findings, ties=(), data=(), verdict="missing"):
    """Of findings: name, joint and status."""
    tied = [{"effect": e, "joint": j} for e, j in ties]
    errors = {"ties": tied, "error_before": 0.10, "error_after": 0.04}
    effects = [
        {"effect": e, "joint": j, "status": "".join(status) or "likely"} | errors
        for e, j, *status in findings
    ]
    verdict = verdict if findings else "nothing significant"
    return {"effects": effects, "verdict": verdict, "seconds": 1.0, "data_warnings": list(data)}


SPRING, DRIFT, DELAY = ("spring", "2"), ("drift", "2"), ("time_delay", None)
COUPLED = ("coupled_friction", "2", "3")

#                    hidden, said, ties of it, first, joint, tied, exact
ANSWERS = {
    "right": ([SPRING], [SPRING], [], 1, 1, 1, 1),
    "other joint": ([SPRING], [("spring", "1")], [], 0, 0, 0, 0),
    "tied": ([SPRING], [DRIFT], [SPRING], 0, 1, 1, 0),
    "tied elsewhere": ([SPRING], [DRIFT], [("spring", "3")], 0, 1, 0, 0),
    "second": ([SPRING], [("drift", "1"), SPRING], [], 0, 0, 0, 0),
    "one too many": ([SPRING], [SPRING, DRIFT], [], 1, 1, 1, 0),
    "silent": ([SPRING], [], [], 0, 0, 0, 0),
    "either joint": ([COUPLED], [("coupled_friction", "3")], [], 1, 1, 1, 1),
    "clean": ([], [], [], 0, 0, 0, 1),
    "false alarm": ([], [SPRING], [], 0, 0, 0, 0),
    "two": ([SPRING, DELAY], [DELAY, SPRING], [], 1, 1, 1, 1),
    "one of two": ([SPRING, DELAY], [DELAY], [], 1, 1, 1, 0),
    "possible": ([SPRING], [(*SPRING, "possible")], [], 1, 1, 1, 0),
    "possibly of nothing": ([], [(*SPRING, "possible")], [], 0, 0, 0, 1),
}


@pytest.mark.parametrize("case", ANSWERS)
def test_an_answer_is_scored(case):
    """And how much it lowers the error, and how well the effect can be seen."""
    hidden, findings, ties, *expected = ANSWERS[case]
    answer = said(*findings, ties=ties)
    score = scored(case, truth(*hidden), answer)
    assert [score.first, score.joint, score.tied, score.exact] == [bool(x) for x in expected]
    assert score_from_json(json.loads(json.dumps(score.to_json()))) == score
    assert score.fall == (pytest.approx(0.6) if findings else None)
    hard = scored(case, truth(*hidden, visible=0.5, noise="high"), answer)
    assert hard.detectable is not bool(hidden)
    if case in ("tied", "tied elsewhere"):  # a statement that leaves it open is not false
        assert score.false is (case == "tied elsewhere")


LATE_LINE = "joint 2: its position comes 5 ms too late beside the other channels"
#             sensor, said, reported, names that are wrong
FAULTS = {
    "in words": ("late", said(data=[LATE_LINE]), True, 0),
    "of another joint": ("late", said(data=[LATE_LINE.replace("2", "3")]), False, 0),
    "by name": ("late", said((*DELAY, "confirmed")), True, 0),
    "taken for another": ("late", said((*SPRING, "confirmed"), data=[LATE_LINE]), True, 1),
    "gain elsewhere": ("gain", said(("drive_gain", "1", "confirmed")), False, 1),
    "gain of either": ("gain", said(("drive_gain", "1"), ties=[("drive_gain", "2")]), True, 0),
    "friction computed": ("computed", said(("coulomb", "1")), False, 1),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_wrong_log_is_told(name):
    kind, answer, text, wrong = FAULTS[name]
    score = scored(name, truth(sensor=kind), answer)
    assert (score.told, score.spurious) == (text, wrong)
    assert score.right == (text and not wrong)


def test_the_page_counts():
    band, hose = ("dead_band", "2"), ("hose_across", "1", "2")
    verdicts = {"missing": [SPRING], "closest description": [SPRING], "unexplained": []}
    held_out = [
        scored(f"{cause[0]}-{name}", truth(cause), said(*findings) | {"verdict": name})
        for cause in (band, hose)
        for name, findings in verdicts.items()
    ]
    assert [score.right for score in held_out] == 2 * [False, True, True]
    scores = [
        scored("spring-med-1", truth(SPRING), said(SPRING)),
        scored("spring-med-2", truth(SPRING), said(DRIFT, ties=[SPRING])),
        scored("spring-high-1", truth(SPRING, visible=0.5, noise="high"), said()),
        scored("none-med-1", truth(), said()),
        scored("none-med-2", truth(), said(SPRING)),
        scored("pair", truth(SPRING, DELAY), said(SPRING, ("drift", "1"))),
        scored("a", truth(SPRING, sensor="coarse"), said((*SPRING, "confirmed"))),
        scored("b", truth(SPRING, sensor="coarse"), said((*DRIFT, "confirmed"))),
        scored("c", truth(sensor="late"), said(data=[LATE_LINE])),
        failed("none-med-3", truth(), "DataError: no rows"),
        *held_out,
    ]
    text = page(scores)
    for row in (
        "| spring |  | 1/2 |  | 1/2 | 2/2 | 2/2 | 1/2 | 60 % |",
        "| med | 2/3 |",
        "| med | 1/1 | 0/1 | 0/1 | 1.00 |",
        "| 4096 counts a turn, in the loop | 1/2 | 1/2 | 1/2 | 1/2 | 1/2 |  |  |",
        "| one position 5 ms late |  |  |  |  | 0/1 | 0/1 | 1/1 |",
        "| dead_band | 1/3 | 1/3 | 1/3 | 0/3 |",
        "| **all** | 2/6 | 2/6 | 2/6 | 0/6 |",
    ):
        assert row in text, row
    misses, hard = text.split("## Misses")[1].split("## Undetectable")
    assert misses.count("\n- ") == 7 and "tied with what is hidden" in misses
    assert "no rows" in misses and "no fact: drift@2" in misses and "- spring-high-1" in hard


def cases(*arguments):
    return cases_of(parser().parse_args(arguments))


def test_seeds_are_for_development_or_for_acceptance():
    assert not set(DEVELOPMENT) & set(ACCEPTANCE)
    assert {case.seed for case in cases("--effects", "spring")} <= set(DEVELOPMENT)
    accepted = cases("--effects", "spring", "--acceptance", "--two", "4", "--clean", "5")
    assert {case.seed for case in accepted} <= set(ACCEPTANCE)
    assert len(accepted) == 3 * (3 + 4 + 5)
    pool = [*DEVELOPMENT, *ACCEPTANCE]
    pairs = [set(case.effects) for case in cases_with([], ["med"], [], pool, two=len(pool))]
    assert all(len(pair) == 2 and pair != {"elasticity", "backlash"} for pair in pairs)
    held_out = cases("--effects", "none", "--noise", "low,med", "--held-out", "2")
    assert {case.effects for case in held_out} == {(name,) for name in HELD_OUT_EFFECTS}
    assert len(held_out) == 4 * len(HELD_OUT_EFFECTS)
    others = cases("--two", "30", "--clean", "30", "--withheld", "30")
    assert {name for case in others for name in case.effects} <= EFFECTS.keys()
    every = cases("--effects", "none", "--noise", "med", "--clean", "2", "--sensors", "coarse,late")
    names = [f"none-med-{seed}-{kind}" for kind in ("coarse", "late") for seed in (1, 2)]
    assert [case.folder for case in every] == names
    for words, message in (("--seeds 1001", "or --acceptance"), ("--effects sprong", "unknown: s")):
        with pytest.raises(SystemExit, match=message):
            cases(*words.split())
