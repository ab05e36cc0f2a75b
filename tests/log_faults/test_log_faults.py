"""A fault of a log is told, and none beside it. The whole suite: `python -m tests.log_faults`."""

import pytest

from tests.log_faults.judge import ask
from tests.log_faults.machines import FAULTS, NONE, make_log
from tests.rotation import ROTATING, rotating

FIRST = 23
"""Seed of the arm for demonstrations."""

DAILY = [("late 40 ms", FIRST), *rotating(*((k, FIRST) for k in FAULTS if k != "late 40 ms"))]
REASONS = {
    "spike tau": "friction that turns makes 433 leaps of a fifth of the spread on that slide: no"
    " spike is told where so many are",
    "clock x 2": "the inertia of a motor on that slide explains as much as another clock",
}
MISSED = {kind: [pytest.mark.xfail(reason=reason)] for kind, reason in REASONS.items()}
LONG = [pytest.param(kind, FIRST + 2, marks=[*ROTATING, *MISSED.get(kind, [])]) for kind in FAULTS]


@pytest.mark.rotating("long tests of log_faults")
@pytest.mark.parametrize(("kind", "seed"), [*DAILY, *LONG])
def test_a_fault_is_told_and_no_other(kind, seed):
    answer = ask(make_log(kind, seed))
    assert answer.told and not answer.false, answer.lines


@pytest.mark.parametrize("seed", [FIRST, *rotating(FIRST - 1, FIRST + 1)])
def test_nothing_is_told_of_a_sound_log(seed):
    answer = ask(make_log(NONE, seed))
    assert answer.false == () and not any("late" in line for line in answer.lines)
