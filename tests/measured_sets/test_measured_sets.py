"""The tool's cases, tables and checks, from answers made up; and a short run on real logs."""

from pathlib import Path

import numpy as np
import pytest

from modeler.robot.read import parse_robot_text
from tests.measured_sets.__main__ import cases_of, main, parser
from tests.measured_sets.answer import Answer
from tests.measured_sets.sanity import driving_fault, gain_faults, level_fault, value_faults
from tests.measured_sets.sets import DATA, SETS, Case
from tests.measured_sets.suite import run
from tests.measured_sets.table import improvement, sanity, stability, stays, wrong


def finding(effect, joint, agrees=True, caveat=""):
    errors = {"error_before": 0.1, "error_after": 0.05, "gain": 0.75}
    looks = [{"label": "cut-offs x 0.7", "leading_effect": None, "agrees": agrees}]
    return {
        "effect": effect,
        "joint": joint,
        "ties": [{"effect": "drift", "joint": joint}],
        "splits": looks,
        "caveat": caveat,
        **errors,
    }


EMPS = Case("emps", "forward")


def answer(*findings, verdict="missing", case=EMPS, **others):
    said = {"verdict": verdict, "effects": list(findings), "refinements": []}
    return Answer(case, said, {"fit": 1.0, "diagnosis": 2.0}, **others)


SPRING, DELAY = finding("spring", "2"), finding("time_delay", None)
FAILED = Answer(Case("emps", "exchanged"), {}, error="DataError: no rows")

#             answers, what is said of the set
STAYS = {
    "the same": (
        [answer(SPRING), answer(SPRING, DELAY)],
        "stays (of 2 stated: spring@2 2; named first: spring@2 2)",
    ),
    "another joint": (
        [answer(SPRING), answer(finding("spring", "3"))],
        "MOVES (of 2 stated: spring@2 1, spring@3 1; named first: spring@2 1, spring@3 1)",
    ),
    "not stated": (
        [
            answer(SPRING),
            answer(DELAY, verdict="closest description"),
            answer(verdict="unexplained"),
        ],
        "stays (of 3 stated: spring@2 1; named first: spring@2 1, time_delay 1)",
    ),
    "failed": (
        [answer(), FAILED],
        "FAILS in 1; stays (of 2 stated: nothing; named first: nothing)",
    ),
}


@pytest.mark.parametrize("case", STAYS)
def test_a_set_stays_or_moves(case):
    answers, said = STAYS[case]
    assert stays(answers) == said


def test_the_tables():
    doubted = finding("spring", "1", caveat="no spring"), finding("drift", "1", agrees=False)
    text = stability([answer(SPRING, DELAY), answer(*doubted), FAILED])
    assert "| emps | forward | 1 | missing | spring@2 10 % -> 5 %; time_delay 10 % -> 5 %" in text
    assert "| 1, 1 |" in text and "1.0 fit + 2.0 diagnosis" in text
    assert "spring@1? 10 % -> 5 %; drift@1? 10 %" in text
    assert "| error | DataError: no rows |" in text
    assert "\n- emps: FAILS in 1; MOVES (of 3 stated: spring@2 1, spring@1 1;" in text

    said = {
        "joints": {"1": [0.05, 0.03], "2": [0.02, 0.021]},
        "whole": 0.63,
        "scatter": 4.25,
        "rises": ["2"],
        "spoilt": False,
        "left_out": ["drift, joint 2 (no)"],
    }
    said["kept"] = [{"effect": "motor_ripple", "joint": "1", "nonlinear_parameters": {"m": 84.0}}]
    text = improvement([Answer(Case("ur10e", "forward"), said, {"add": 2.0}), FAILED])
    assert "| ur10e | forward | 1: 5 -> 3; 2: 2 -> 2.1! | 0.630 | 4.2 | 2.0 add |" in text
    assert "ur10e, forward: kept motor_ripple@1 m=84\n  - left out: drift, joint 2 (no)" in text

    fact = answer(SPRING, faults=("fact: payload: mass -2 kg", "hedged: payload: mass -1 kg"))
    assert "| emps | forward | 1 | fact: payload: mass -2 kg |" in sanity([fact])
    assert sanity([fact]).endswith("- emps: 1 as facts, 1 others in 1 answers")
    assert wrong(fact) and wrong(FAILED)
    assert not wrong(answer(SPRING, faults=("hedged: payload: mass -1 kg",)))


def test_values_that_cannot_be():
    assert list(value_faults({"mass": 2.0, "mu2": 0.1, "Fz1": -1.0})) == []
    assert list(value_faults({"mass": -2.0})) == ["mass -2 kg"]
    assert list(value_faults({"mu2": -0.7})) == ["mu2 = -0.7, more than 0.5"]
    assert list(gain_faults(SPRING)) == []
    assert list(gain_faults(SPRING | {"gain": 0.5})) == ["gain 0.5, and its errors imply 0.75"]


def test_friction_that_cannot_be():
    speed = np.linspace(-1.0, 1.0, 2001)
    brakes = 2.0 * np.sign(speed) + 3.0 * speed
    assert list(level_fault("Fs1", 5.1, brakes)) == []
    (line,) = level_fault("Fs1", -5.5, brakes)
    assert "Fs1 = -5.5, and all friction of its joint is 5 at most" in line
    assert list(driving_fault(brakes, speed)) == []
    (line,) = driving_fault(brakes - 6.0 * np.maximum(speed, 0.0), speed)
    assert "drives with" in line and "at a speed of 0.8" in line
    assert list(driving_fault(-brakes[:100], speed[:100])) == []  # too few to say


def test_cases_of_options():
    def cases(*arguments):
        return cases_of(parser().parse_args(arguments))

    every = cases("stability")
    assert len(every) == len({case.name for case in every}) == 8 * 2 * 3
    assert len(cases("auto")) == 8 * 2
    (one,) = cases("check", "--sets", "emps", "--directions", "exchanged", "--factors", "1.4")
    assert one == Case("emps", "exchanged", 1.4)
    with pytest.raises(SystemExit, match="unknown: emp; expected of emps"):
        cases("stability", "--sets", "emp")


def test_every_set_has_a_robot_and_its_logs_may_change_places():
    for name, item in SETS.items():
        robot = parse_robot_text(item.robot(), name)
        assert {use.effect for use in robot.effects} >= {"viscous", "coulomb"}, name
        training, held_out = item.logs(Path("d"), "forward")
        assert item.logs(Path("d"), "exchanged") == (held_out, training)
    assert training == ["d/dualarm7/excitation_13.parquet", "d/dualarm7/excitation_15.parquet"]


def test_answers_are_remembered_and_errors_asked_again(tmp_path):
    asked = []

    def ask(case, data):
        asked.append(case)
        if case.direction == "exchanged" and len(asked) == 2:
            raise ValueError("not now")
        return answer(SPRING, case=case, faults=("hedged: a",))

    both, memory = [EMPS, Case("emps", "exchanged", 0.7)], tmp_path / "out" / "a.jsonl"
    first = run(both, tmp_path, ask, memory)
    assert first[1].error == "ValueError: not now"
    again = run(both, tmp_path, ask, memory)
    assert asked == [*both, both[1]] and again[0] == first[0] and not again[1].error


def test_absent_logs_are_told(tmp_path, capsys):
    assert main(["stability", "--sets", "emps", "--data", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert out == "" and "NOT CHECKED: emps, no measured logs" in err


@pytest.mark.slow
@pytest.mark.measured
@pytest.mark.skipif(not DATA.is_dir(), reason="NOT CHECKED: no measured logs beside the checkout")
def test_emps_is_asked(tmp_path, capsys):
    asked = ["--sets", "emps", "--directions", "forward", "--out", str(tmp_path)]
    assert main(["stability", *asked, "--factors", "1"]) == 0
    out, _ = capsys.readouterr()
    assert "asymmetric_viscous@1" in out and "- emps: stays" in out
    assert main(["check", *asked, "--factors", "1"]) == 0
    assert capsys.readouterr().err == ""  # stored
    assert main(["auto", *asked]) == 0
    out, _ = capsys.readouterr()
    assert "kept asymmetric_viscous@1" in out
