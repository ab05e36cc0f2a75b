"""What is said of noise, and the band in which it is looked at."""

import dataclasses

import numpy as np
import pytest

from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.state import analyse_logs, describe_bands
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from tests.diagnose.conftest import Case, motion, nothing


def shaking(log: Log, size: float = 5e-4) -> Log:
    q = log.q + np.random.default_rng(6).normal(0.0, size, log.q.shape)
    return dataclasses.replace(log, q=q, qd=None, qdd=None)


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_band_in_which_the_model_trembles_is_lowered_or_told(case: Case) -> None:
    """Where the user gave the cut-offs, they stay."""
    log, inputs = shaking(case.train), Processing(position_cutoff=60.0, parallel_cutoff=25.0)
    for processing, text in ((inputs, 1), (Processing(), 0)):
        model = case.chain.fit([log], processing)
        result = diagnose(model, case.compiled, [log], most=0)
        lines = [line for line in result.data_warnings if "high-frequency" in line]
        assert len(lines) == text
        assert all("position noise" in x and "--cutoff below" in x for x in lines)
        assert (result.band == 25.0) if text else (result.band < 15.0)


@pytest.mark.rotating("diagnoses of simulated runs")
def test_noise_of_the_positions_is_nothing_systematic(case: Case) -> None:
    """It is in the columns of the model, and so in the residual: no function of the motion."""
    log, holdout = (shaking(items, 1e-3) for items in (case.train, case.holdout))
    result = diagnose(case.fitted(log), case.compiled, [log], [holdout], most=0)
    assert result.verdict == "nothing significant"
    assert not any(joint.is_unexplained for joint in result.joints.values())


def test_positions_that_are_exact_are_looked_at_far_above_the_motion(case: Case) -> None:
    model = case.fitted(case.train)
    seen = analyse_logs(case.compiled, [case.train], model.processing)
    narrow = analyse_logs(case.compiled, [case.train], model.processing, 0.0)
    wide, low = (item.report.processing for item in (seen, narrow))
    assert wide.parallel_cutoff > 1.5 * low.parallel_cutoff
    assert wide.position_cutoff >= 2.0 * wide.parallel_cutoff
    assert len(describe_bands(model.processing, wide)) == 1
    assert describe_bands(wide, wide) == []


def test_torques_without_any_friction_are_doubted(case: Case) -> None:
    model = case.fitted(case.train)
    kinds = [base.kind for base in case.compiled.spec.base]
    friction = np.where([kind == "friction" for kind in kinds], model.beta, 0.0)

    def smooth(log: Log) -> np.ndarray:
        q, v = motion(log)
        return -case.compiled.inverse_dynamics(q, v, np.zeros_like(q), friction)

    fitted, train, _ = case.hidden(smooth)
    smoothly = diagnose(fitted, case.compiled, [train], most=0)
    for result, text in ((smoothly, 1), (case.found(nothing), 0)):
        assert sum("no joint rubs" in line for line in result.data_warnings) == text
        ids = {effect.id for effect in result.search.catalogue}
        assert ("load_friction" not in ids) is bool(text) and "time_delay" in ids
