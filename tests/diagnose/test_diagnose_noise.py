"""What is said of noise, and the band in which it is looked at."""

import dataclasses

import numpy as np
import pytest

from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.state import analysis_processing, bands_line
from modeler.observation.log import Log
from modeler.observation.settings import Processing
from tests.diagnose.conftest import Case, motion


def test_noise_of_the_positions_is_told_with_what_helps(case: Case) -> None:
    def shaking(log: Log) -> Log:
        q = log.q + np.random.default_rng(6).normal(0.0, 5e-4, log.q.shape)
        return dataclasses.replace(log, q=q, qd=None, qdd=None)

    for log, told in ((shaking(case.train), 1), (case.train, 0)):
        diagnosis = diagnose(case.fitted(log), case.compiled, [log], most=0)
        lines = [line for line in diagnosis.data if "trembles" in line]
        assert len(lines) == told
        assert all("noise of the positions" in x and "--cutoff below" in x for x in lines)


def test_a_parallel_filter_that_was_given_rules_the_diagnosis():
    given = Processing(position_cutoff=30.0, parallel_cutoff=5.0, decimation=3)
    automatic = dataclasses.replace(given, chosen=("position_cutoff", "parallel_cutoff"))
    for fitted, band, lines in ((given, 5.0, 0), (automatic, 24.0, 1)):
        seen = analysis_processing(fitted)
        assert (seen.parallel_cutoff, seen.decimation) == (pytest.approx(band), None)
        said = bands_line(fitted, seen)
        assert len(said) == lines
        assert all("up to 24 Hz" in line and "fit up to 5 Hz" in line for line in said)
    low = dataclasses.replace(automatic, position_cutoff=10.0)
    assert analysis_processing(low).parallel_cutoff == pytest.approx(8.0)


def test_torques_without_any_friction_are_doubted(case: Case) -> None:
    model = case.fitted(case.train)
    kinds = [base.kind for base in case.compiled.spec.base]
    friction = np.where([kind == "friction" for kind in kinds], model.beta, 0.0)

    def smooth(log: Log) -> np.ndarray:
        q, v = motion(log)
        return -case.compiled.inverse_dynamics(q, v, np.zeros_like(q), friction)

    for hidden, told in ((smooth, 1), (lambda log: np.zeros_like(log.tau), 0)):
        fitted, train, _ = case.hidden(hidden)
        lines = diagnose(fitted, case.compiled, [train], most=0).data
        assert sum("no joint rubs" in line for line in lines) == told
