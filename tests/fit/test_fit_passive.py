"""Joints without a motor, and motors whose torque channel is dead."""

import dataclasses

import numpy as np
import pytest
from test_observation_rows import exact_log, some_beta

from modeler.core.errors import DataError
from modeler.derivation.numeric_rank import build_grouping_matrix
from modeler.estimation.identify import identify
from modeler.regression import observe, read_log
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.modules import compiled, module


@pytest.mark.parametrize(
    "name", ["orthoglide-leg-tree", pytest.param("sr400-tree", marks=pytest.mark.slow)]
)
def test_a_simulated_robot_with_passive_joints_comes_back(name, tmp_path):
    """Truth of the simulation, not of the fit: 30 to 50 values, each within its sigmas."""
    symbolic, base, arm = module(name)
    run = simulate(symbolic.robot, SimulationSettings(duration=6.0, seed=1))
    write_log(tmp_path / "run.csv", run)
    fit = identify(observe(compiled(name), [read_log(tmp_path / "run.csv", arm.spec)]))
    chi = np.array([run.truth.parameters[parameter] for parameter in symbolic.names])
    beta = build_grouping_matrix(symbolic, base.parameters) @ chi
    assert fit.status == "ok" and fit.relative_error < 0.01
    sigma = np.array([parameter.sigma for parameter in fit.parameters])
    # Sensor errors in W and y: the share of values beyond 2 sigma is small, none is far off.
    errors = np.abs(fit.beta - beta) / sigma
    assert np.mean(errors > 2.0) < 0.2 and errors.max() < 5.0
    passive = [j for j, spec in zip(fit.joints, arm.spec.joints, strict=True) if not spec.actuated]
    assert passive and all(j.relative_error is None and 0 < j.rms < j.sigma for j in passive)


@pytest.fixture(scope="module")
def arm():
    """A 3R arm, values and log with 1 % noise."""
    robot = compiled("demo-arm")
    beta = some_beta(robot)
    log = exact_log(robot, beta, seconds=20)
    noise = np.random.default_rng(5).normal(size=log.tau.shape)
    return robot, beta, dataclasses.replace(log, tau=log.tau + 0.01 * log.tau.std(axis=0) * noise)


def test_a_dead_channel_leaves_the_other_joints_alone(arm):
    robot, beta, log = arm
    healthy = identify(observe(robot, [log]))
    dead = dataclasses.replace(log, tau=log.tau * [0.0, 1.0, 1.0])
    fit = identify(observe(robot, [dead]))
    assert fit.joints[0].rows == 0 and fit.joints[0].relative_error is None
    assert any(s.startswith("joint 1: its torque is 0 in every row") for s in fit.sentences)
    assert not any("its torque is 0" in s for s in healthy.sentences)
    with pytest.raises(DataError, match="run: the torque of every joint with a motor is 0"):
        identify(observe(robot, [dataclasses.replace(log, tau=0.0 * log.tau)]))
    for j in (1, 2):
        assert fit.joints[j].relative_error < 1.05 * healthy.joints[j].relative_error
    rest = [p.status == "estimated" for p in fit.parameters]
    assert 0 < sum(rest) < len(rest)  # ZZ1, Fv1 ... show in the rows of joint 1 only
    for parameter, true in zip(fit.parameters, beta, strict=True):
        if parameter.sigma is not None and parameter.name[-1] == "3":
            assert abs(parameter.value - true) < 5.0 * parameter.sigma
    # the unit of a torque does not decide the rank: what the motion separates is a matter of W
    weak = dataclasses.replace(log, tau=log.tau * [1e-13, 1.0, 1.0])
    assert identify(observe(robot, [weak])).status == "ok"
