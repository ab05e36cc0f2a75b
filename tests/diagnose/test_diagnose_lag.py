"""A torque behind a low-pass filter is reported as that, and never as friction."""

import math

import numpy as np
import pytest
from scipy.signal import lfilter

from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.result import Diagnosis
from modeler.diagnosis.signals import apply_lag
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.regression import Log
from tests.diagnose.conftest import Case, Torque, on_joint
from tests.rotation import rotating


def late(log: Log, tau: np.ndarray, seconds: float) -> np.ndarray:
    """The torque as it was so many s ago."""
    return np.interp(log.time - seconds, log.time, tau)


def low_passed(log: Log, tau: np.ndarray, seconds: float) -> np.ndarray:
    """The torque behind 1/(T s + 1), by a bilinear filter."""
    ratio = 2.0 * seconds * (len(log.time) - 1) / float(log.time[-1] - log.time[0])
    a = [1.0, (1.0 - ratio) / (1.0 + ratio)]
    b = np.full(2, 1.0 / (1.0 + ratio))
    return np.asarray(lfilter(b, a, tau, zi=[tau[0] * (1.0 - b[0])])[0])


def changed(how: object, joint: int | None, seconds: float) -> Torque:
    """What is added to the torques of one joint, or of all, that are filtered or late."""

    def torque(log: Log) -> np.ndarray:
        moved = np.column_stack([how(log, tau, seconds) for tau in log.tau.T])  # type: ignore[operator]
        more = moved - log.tau
        return more if joint is None else on_joint(log, joint, more[:, joint])

    return torque


LAG2, LAG_ALL = changed(low_passed, 1, 0.02), changed(low_passed, None, 0.015)
DELAY2 = changed(late, 1, 0.02)


def stated_friction(found: Diagnosis) -> list[str]:
    """Ids of friction that is more than possibly missing."""
    friction = {e.id for e in found.search.catalogue if e.family == "friction"}
    every = (*found.effects, *found.refinements)
    return [f.effect for f in every if f.effect in friction and f.status != "possible"]


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize(
    ("torque", "joint", "tau"), [(LAG2, "2", 0.02), *rotating((LAG_ALL, None, 0.015))]
)
def test_a_filtered_torque_is_named_with_its_time(case, torque, joint, tau):
    result = case.found(torque)
    first = result.effects[0]
    assert (first.effect, first.joint, first.status) == ("torque_lag", joint, "confirmed")
    assert first.parameters["tau"] == pytest.approx(tau, rel=0.1)
    assert first.parameters[f"lag{joint or ''}"] == pytest.approx(1.0, abs=0.1)
    assert first.error_after < 0.3 * first.error_before
    assert not stated_friction(result) and not result.addable_findings


@pytest.mark.rotating("diagnoses of simulated runs")
def test_without_held_out_logs_too_and_ruled_out_it_is_no_friction(case: Case) -> None:
    model, train, _ = case.hidden(LAG2)
    result = diagnose(model, case.compiled, [train])
    assert (result.effects[0].effect, result.effects[0].status) == ("torque_lag", "confirmed")
    assert not stated_friction(result)
    result = case.found(LAG2, ("torque_lag",))
    assert all(f.status != "confirmed" for f in result.effects), result.sentences


@pytest.mark.rotating("long tests of diagnose")
def test_a_pure_delay_is_no_filter(case: Case) -> None:
    result = case.found(DELAY2)
    assert all(f.status != "confirmed" for f in result.effects)
    assert not stated_friction(result)
    assert "a pure delay of 2" in result.sentences[0]
    assert "describes it better" in result.sentences[0]


@pytest.mark.rotating("diagnoses of simulated runs")
def test_what_is_a_delay_or_a_filter_takes_no_place(case: Case) -> None:
    """Too short for these data to show: it is reported, and is in no model that judges others."""
    for how in (low_passed, late):
        result = case.found(changed(how, 1, 0.004))
        assert not stated_friction(result) and not result.addable_findings
        assert all(step.candidate.effect.id != "torque_lag" for step in result.search.steps)
        assert any(
            "(torque_lag), joint 2" in line and "describes it as well" in line
            for line in result.sentences
        )


@pytest.mark.rotating("diagnoses of simulated runs")
def test_less_than_half_a_sample_is_no_effect(case: Case) -> None:
    step = float(np.median(np.diff(case.train.time)))
    result = case.found(changed(low_passed, 0, 0.5 * THRESHOLDS.max_logger_delay * step))
    assert not result.effects and result.verdict == "nothing significant"


def test_the_filter_is_exact_for_straight_lines() -> None:
    time = np.arange(200) * 0.01
    for tau in (0.002, 0.03):
        value = apply_lag(time, 0.01, tau)
        assert value == pytest.approx(time - tau * (1.0 - np.exp(-time / tau)), abs=1e-12)
    assert math.isclose(apply_lag(np.ones(5), 0.01, 0.02)[-1], 1.0)
