"""Nothing that is printed of a machine without a fault is wrong."""

import pytest

from tests.clean_logs.judge import find_wrong_lines, print_all
from tests.clean_logs.machines import PAIRS, Truth, make_machine
from tests.rotation import ROTATING, rotating, with_cases

DAILY = [182, pytest.param(107, marks=ROTATING), *rotating(103)]
"""Sticks and held, with two joints and with more; held and single, what once was said to ring."""

SLOW = [pytest.param(seed, marks=pytest.mark.slow) for seed in range(200, 200 + len(PAIRS))]
"""201: coarse speeds of a held position; 202: 16 rows at the coarse end of a torque."""


@pytest.mark.rotating("long tests of clean_logs")
@pytest.mark.parametrize("seed", [*DAILY, *SLOW])
def test_no_line_is_wrong(seed, tmp_path):
    truth = make_machine(seed, tmp_path)
    lines = print_all(tmp_path)
    assert any(line.startswith("compare: all ") for line in lines), lines
    assert find_wrong_lines(lines, truth) == []
    for channel in truth.held:
        assert any(channel in line and "holds each value" in line for line in lines), channel


@with_cases(
    "line",
    "log: warning: a.parquet: q4: stays at an end of its range: the position is clipped",
    "fit: joint 1 rings at 100 Hz, look at the controller's gains",
    "compare: Joint 3: measured is 0.88 times predicted; the prediction is off by a factor",
    "log: q1  -  -1.2  1.3  6.28e-07  -",
    "fit: Traceback (most recent call last):",
)
def test_the_judge_sees_a_wrong_line(line):
    truth = Truth(("gaps", "held"), steps={"q1": 6.28e-6})
    assert find_wrong_lines([line], truth) == [line]
