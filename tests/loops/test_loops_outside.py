"""Closed robots against the oracle of complex steps, and against simulations by multipliers."""

import numpy as np
import pytest

from modeler.robot.read import read_robot
from modeler.simulation import SimulationSettings, simulate
from tests.loops.closed_states import closed
from tests.modules import module, plain
from tests.oracles.complex_step import Oracle
from tests.robots import LOOPED, one_always

ROBOTS = one_always(LOOPED, "five-bar")


@pytest.mark.parametrize("name", ROBOTS)
def test_torques_are_those_of_the_oracle(name):
    c, written, result = plain(name), read_robot(name), Oracle(module(name).model.robot)
    chi = np.random.default_rng(4).normal(size=len(c.spec.standard))
    names = [parameter.name for parameter in c.spec.standard]
    oracle = Oracle(written, dict(zip(names, chi, strict=True)))
    (q, qd, qdd), (u, _, _), _ = closed(name, 6, seed=8)
    known = result.variables(u)
    u = np.stack([known[joint.name] for joint in written.free_joints], axis=1)
    assert np.abs(oracle.errors(u)[0]).max() < 1e-9
    tau = oracle.torques(u, qd, qdd)
    ours = c.inverse_dynamics(q, qd, qdd, c.base_parameters(chi))
    np.testing.assert_allclose(ours, tau, rtol=0, atol=1e-8 * np.abs(tau).max())


@pytest.mark.parametrize("name", ROBOTS)
def test_simulated_torques_are_those_of_the_model(name):
    """The simulator closes whole frames by least squares and solves for multipliers."""
    robot, c = read_robot(name), plain(name)
    settings = SimulationSettings(duration=0.6, rate=1000, torque_noise=0.0)
    truth = simulate(robot, settings).truth
    chi = np.array([truth.parameters[column.name] for column in module(name).base.columns])
    tau = c.inverse_dynamics(truth.q, truth.qd, truth.qdd, c.base_parameters(chi))
    largest = np.abs(truth.tau).max()
    # Dry friction of the simulator has a smooth core: rows where a joint creeps are left out.
    wrong = np.sort(np.max(np.abs(tau - truth.tau), axis=1))
    assert np.median(wrong) < 1e-9 * largest
